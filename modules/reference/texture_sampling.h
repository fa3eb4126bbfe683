// SPDX-License-Identifier: MIT
#pragma once
// Textures on the CPU, level 0.

#include "servers/rendering/render_scene.h"

namespace lucent {

// Linear RGBA at p_uv after p_ref's transform and wrapping. (1, 1, 1, 1) for an empty image.
Vector4 sample_texture(const SceneTexture &p_texture, const TextureRef &p_ref, const Vector2 &p_uv);

// One texel, linear.
Vector4 read_texel(const SceneTexture &p_texture, uint32_t p_x, uint32_t p_y);

float select_channel(const Vector4 &p_value, TextureChannel p_channel);

} // namespace lucent
