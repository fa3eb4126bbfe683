// SPDX-License-Identifier: MIT
#include "servers/rendering/texture_mips.h"

#include "servers/core/math_types.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cstring>

namespace lucent {

namespace {
constexpr float MAX_HALF = 65504.0f;

const std::array<float, 256> &srgb_table() {
	static const std::array<float, 256> table = [] {
		std::array<float, 256> values;
		for (int i = 0; i < 256; i++) {
			values[i] = srgb_to_linear(float(i) / 255.0f);
		}
		return values;
	}();
	return table;
}

// 16 bits of linear light resolve every 8-bit sRGB code.
uint8_t encode_srgb(float p_linear) {
	static const std::vector<uint8_t> table = [] {
		std::vector<uint8_t> values(65536);
		for (int i = 0; i < 65536; i++) {
			values[i] = uint8_t(linear_to_srgb(float(i) / 65535.0f) * 255.0f + 0.5f);
		}
		return values;
	}();
	return table[size_t(std::clamp(p_linear, 0.0f, 1.0f) * 65535.0f + 0.5f)];
}

std::vector<Vector4> to_linear(const Image &p_image, bool p_srgb) {
	std::vector<Vector4> texels(size_t(p_image.width) * p_image.height);
	if (p_image.format == ImageFormat::RGBA32F) {
		std::memcpy(texels.data(), p_image.texels.data(), texels.size() * sizeof(Vector4));
		return texels;
	}
	const uint8_t *bytes = reinterpret_cast<const uint8_t *>(p_image.texels.data());
	const std::array<float, 256> &decode = srgb_table();
	for (size_t i = 0; i < texels.size(); i++, bytes += 4) {
		for (int k = 0; k < 4; k++) {
			texels[i][k] = p_srgb && k < 3 ? decode[bytes[k]] : float(bytes[k]) * (1.0f / 255.0f);
		}
	}
	return texels;
}

std::vector<std::byte> encode(const std::vector<Vector4> &p_texels, ImageFormat p_format, bool p_srgb) {
	if (p_format == ImageFormat::RGBA32F) {
		std::vector<std::byte> bytes(p_texels.size() * 8);
		for (size_t i = 0; i < p_texels.size(); i++) {
			const uint64_t packed = glm::packHalf4x16(glm::clamp(p_texels[i], -MAX_HALF, MAX_HALF));
			std::memcpy(&bytes[i * 8], &packed, 8);
		}
		return bytes;
	}
	std::vector<std::byte> bytes(p_texels.size() * 4);
	for (size_t i = 0; i < p_texels.size(); i++) {
		for (int k = 0; k < 4; k++) {
			const float value = p_texels[i][k];
			bytes[i * 4 + k] = std::byte(p_srgb && k < 3 ? encode_srgb(value) : uint8_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f));
		}
	}
	return bytes;
}

std::vector<Vector4> halve(const std::vector<Vector4> &p_texels, uint32_t p_width, uint32_t p_height) {
	const uint32_t width = std::max(p_width / 2, 1u);
	const uint32_t height = std::max(p_height / 2, 1u);
	std::vector<Vector4> result(size_t(width) * height);
	for (uint32_t y = 0; y < height; y++) {
		const size_t row0 = size_t(2 * y) * p_width;
		const size_t row1 = size_t(std::min(2 * y + 1, p_height - 1)) * p_width;
		for (uint32_t x = 0; x < width; x++) {
			const uint32_t x1 = std::min(2 * x + 1, p_width - 1);
			result[size_t(y) * width + x] = 0.25f * (p_texels[row0 + 2 * x] + p_texels[row0 + x1] + p_texels[row1 + 2 * x] + p_texels[row1 + x1]);
		}
	}
	return result;
}
} // namespace

std::vector<std::vector<std::byte>> make_mip_chain(const Image &p_image, bool p_srgb) {
	std::vector<std::vector<std::byte>> levels;
	std::vector<Vector4> texels = to_linear(p_image, p_srgb);
	levels.push_back(p_image.format == ImageFormat::RGBA8 ? p_image.texels : encode(texels, p_image.format, p_srgb));
	uint32_t width = p_image.width;
	uint32_t height = p_image.height;
	while (width > 1 || height > 1) {
		texels = halve(texels, width, height);
		width = std::max(width / 2, 1u);
		height = std::max(height / 2, 1u);
		levels.push_back(encode(texels, p_image.format, p_srgb));
	}
	return levels;
}

std::vector<std::byte> make_square_copy(const Image &p_image, bool p_srgb, uint32_t p_size) {
	const std::vector<Vector4> texels = to_linear(p_image, p_srgb);
	std::vector<Vector4> result(size_t(p_size) * p_size);
	for (uint32_t y = 0; y < p_size; y++) {
		const uint32_t y0 = uint32_t(uint64_t(y) * p_image.height / p_size);
		const uint32_t y1 = std::max(uint32_t(uint64_t(y + 1) * p_image.height / p_size), y0 + 1);
		for (uint32_t x = 0; x < p_size; x++) {
			const uint32_t x0 = uint32_t(uint64_t(x) * p_image.width / p_size);
			const uint32_t x1 = std::max(uint32_t(uint64_t(x + 1) * p_image.width / p_size), x0 + 1);
			Vector4 sum(0.0f);
			for (uint32_t v = y0; v < y1; v++) {
				for (uint32_t u = x0; u < x1; u++) {
					sum += texels[size_t(v) * p_image.width + u];
				}
			}
			result[size_t(y) * p_size + x] = sum / float((y1 - y0) * (x1 - x0));
		}
	}
	return encode(result, ImageFormat::RGBA8, true);
}

} // namespace lucent
