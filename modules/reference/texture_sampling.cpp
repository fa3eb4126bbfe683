// SPDX-License-Identifier: MIT
#include "modules/reference/texture_sampling.h"

#include <array>
#include <cstring>

namespace lucent {

namespace {

const std::array<float, 256> SRGB_TABLE = [] {
	std::array<float, 256> table{};
	for (size_t i = 0; i < table.size(); i++) {
		table[i] = srgb_to_linear(float(i) / 255.0f);
	}
	return table;
}();

const std::array<float, 256> UNORM_TABLE = [] {
	std::array<float, 256> table{};
	for (size_t i = 0; i < table.size(); i++) {
		table[i] = float(i) / 255.0f;
	}
	return table;
}();

uint32_t wrap_index(int32_t p_index, uint32_t p_size, TextureWrap p_wrap) {
	if (uint32_t(p_index) < p_size) {
		return uint32_t(p_index); // the usual case: a division takes as long as the rest
	}
	const int32_t size = int32_t(p_size);
	switch (p_wrap) {
		case TextureWrap::CLAMP:
			return uint32_t(glm::clamp(p_index, 0, size - 1));
		case TextureWrap::MIRRORED_REPEAT: {
			const int32_t folded = ((p_index % (2 * size)) + 2 * size) % (2 * size);
			return uint32_t(folded < size ? folded : 2 * size - 1 - folded);
		}
		case TextureWrap::REPEAT:
			break;
	}
	return uint32_t(((p_index % size) + size) % size);
}

Vector2 transform_uv(const TextureRef &p_ref, const Vector2 &p_uv) {
	const Vector2 scaled = p_uv * p_ref.uv_scale;
	if (p_ref.uv_rotation == 0.0f) {
		return scaled + p_ref.uv_offset;
	}
	const float c = std::cos(p_ref.uv_rotation);
	const float s = std::sin(p_ref.uv_rotation);
	return Vector2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x) + p_ref.uv_offset;
}

bool is_nearest(TextureFilter p_filter) {
	return p_filter == TextureFilter::NEAREST || p_filter == TextureFilter::NEAREST_MIPMAPS || p_filter == TextureFilter::NEAREST_MIPMAPS_ANISOTROPIC;
}

} // namespace

Vector4 read_texel(const SceneTexture &p_texture, uint32_t p_x, uint32_t p_y) {
	const Image &image = *p_texture.image;
	const std::byte *texel = image.texels.data() + (size_t(p_y) * image.width + p_x) * image.texel_size_bytes();
	if (image.format == ImageFormat::RGBA32F) {
		Vector4 value;
		std::memcpy(&value, texel, sizeof(value));
		return value;
	}
	const auto byte = [texel](size_t p_channel) { return uint8_t(texel[p_channel]); };
	const std::array<float, 256> &table = p_texture.srgb ? SRGB_TABLE : UNORM_TABLE;
	return Vector4(table[byte(0)], table[byte(1)], table[byte(2)], UNORM_TABLE[byte(3)]);
}

Vector4 sample_texture(const SceneTexture &p_texture, const TextureRef &p_ref, const Vector2 &p_uv) {
	if (!p_texture.image || p_texture.image->is_empty()) {
		return Vector4(1.0f);
	}
	const uint32_t width = p_texture.image->width;
	const uint32_t height = p_texture.image->height;
	Vector2 position = transform_uv(p_ref, p_uv) * Vector2(float(width), float(height));
	// Beyond that, floats have no fraction left; NaN goes to 0.
	if (!(std::abs(position.x) < 1e7f && std::abs(position.y) < 1e7f)) {
		position = Vector2(0.0f);
	}
	// The whole part by truncation: floor() is a call where the processor's baseline has no instruction for it.
	const auto floor_of = [](float p_value) { return int32_t(p_value) - (p_value < float(int32_t(p_value)) ? 1 : 0); };
	if (is_nearest(p_ref.filter)) {
		return read_texel(p_texture, wrap_index(floor_of(position.x), width, p_ref.wrap_u), wrap_index(floor_of(position.y), height, p_ref.wrap_v));
	}
	const int32_t x = floor_of(position.x - 0.5f);
	const int32_t y = floor_of(position.y - 0.5f);
	const Vector2 weight = position - 0.5f - Vector2(float(x), float(y));
	const uint32_t x0 = wrap_index(x, width, p_ref.wrap_u), x1 = wrap_index(x + 1, width, p_ref.wrap_u);
	const uint32_t y0 = wrap_index(y, height, p_ref.wrap_v), y1 = wrap_index(y + 1, height, p_ref.wrap_v);
	return glm::mix(glm::mix(read_texel(p_texture, x0, y0), read_texel(p_texture, x1, y0), weight.x), glm::mix(read_texel(p_texture, x0, y1), read_texel(p_texture, x1, y1), weight.x), weight.y);
}

float select_channel(const Vector4 &p_value, TextureChannel p_channel) {
	return p_channel == TextureChannel::GRAYSCALE ? (p_value.x + p_value.y + p_value.z) / 3.0f : p_value[int(p_channel)];
}

} // namespace lucent
