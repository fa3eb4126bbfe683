// SPDX-License-Identifier: MIT
#pragma once
// Images as the GPU takes them: mip chains and small copies, averaged in linear light.

#include "servers/core/image.h"

#include <cstddef>
#include <vector>

namespace lucent {

// Every level down to 1x1, level 0 first, tightly packed. RGBA8 stays RGBA8 (encoded as p_srgb says), RGBA32F becomes half floats.
std::vector<std::vector<std::byte>> make_mip_chain(const Image &p_image, bool p_srgb);

// sRGB-encoded RGBA8 of p_size x p_size, each texel the average of what it covers. Values above 1 are clamped.
std::vector<std::byte> make_square_copy(const Image &p_image, bool p_srgb, uint32_t p_size);

} // namespace lucent
