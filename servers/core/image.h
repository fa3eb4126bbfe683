// SPDX-License-Identifier: MIT
#pragma once
// A CPU image: plain texels, no GPU. Rows from the top, tightly packed.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lucent {

enum class ImageFormat : uint8_t {
	RGBA8, // 4 bytes; colour or data, see Texture::srgb
	RGBA32F, // 16 bytes; linear
};

struct Image {
	ImageFormat format = ImageFormat::RGBA8;
	uint32_t width = 0;
	uint32_t height = 0;
	std::vector<std::byte> texels; // width * height * texel_size_bytes(); mip levels are made on upload

	uint32_t texel_size_bytes() const { return format == ImageFormat::RGBA8 ? 4 : 16; }
	bool is_empty() const { return width == 0 || height == 0; }
};

} // namespace lucent
