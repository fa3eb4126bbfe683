// SPDX-License-Identifier: MIT
#pragma once
// Textures on the CPU, level 0.

#include "servers/rendering/render_scene.h"

namespace lucent {

// Linear RGBA at p_uv after p_ref's transform and wrapping. (1, 1, 1, 1) for an empty image.
Vector4 sample_texture(const SceneTexture &p_texture, const TextureRef &p_ref, const Vector2 &p_uv);

// The texels around a point, wrapped, and the weight of the second column and row. The nearest filter: one texel, weight 0.
struct TexelSquare {
	uint32_t x[2];
	uint32_t y[2];
	Vector2 weight;
};
TexelSquare find_texels(uint32_t p_width, uint32_t p_height, const TextureRef &p_ref, const Vector2 &p_uv);

Vector4 decode_texel_8(const std::byte *p_texel, bool p_srgb);
Vector4 decode_texel_float(const std::byte *p_texel);
// (0, 0), (1, 0), (0, 1), (1, 1)
inline Vector4 mix_texels(const Vector4 *p_values, const Vector2 &p_weight) {
	return glm::mix(glm::mix(p_values[0], p_values[1], p_weight.x), glm::mix(p_values[2], p_values[3], p_weight.x), p_weight.y);
}

// One texel, linear.
Vector4 read_texel(const SceneTexture &p_texture, uint32_t p_x, uint32_t p_y);

float select_channel(const Vector4 &p_value, TextureChannel p_channel);

} // namespace lucent
