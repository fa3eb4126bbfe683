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
	if ((p_size & (p_size - 1)) == 0) {
		return uint32_t(p_index) & (p_size - 1);
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

Vector4 decode_texel_8(const std::byte *p_texel, bool p_srgb) {
	const auto byte = [p_texel](size_t p_channel) { return uint8_t(p_texel[p_channel]); };
	const std::array<float, 256> &table = p_srgb ? SRGB_TABLE : UNORM_TABLE;
	return Vector4(table[byte(0)], table[byte(1)], table[byte(2)], UNORM_TABLE[byte(3)]);
}

Vector4 decode_texel_float(const std::byte *p_texel) {
	Vector4 value;
	std::memcpy(&value, p_texel, sizeof(value));
	return value;
}

Vector4 read_texel(const SceneTexture &p_texture, uint32_t p_x, uint32_t p_y) {
	const Image &image = *p_texture.image;
	const std::byte *texel = image.texels.data() + (size_t(p_y) * image.width + p_x) * image.texel_size_bytes();
	return image.format == ImageFormat::RGBA32F ? decode_texel_float(texel) : decode_texel_8(texel, p_texture.srgb);
}

TexelSquare find_texels(uint32_t p_width, uint32_t p_height, const TextureRef &p_ref, const Vector2 &p_uv) {
	Vector2 position = transform_uv(p_ref, p_uv) * Vector2(float(p_width), float(p_height));
	// Beyond that, floats have no fraction left; NaN goes to 0.
	if (!(std::abs(position.x) < 1e7f && std::abs(position.y) < 1e7f)) {
		position = Vector2(0.0f);
	}
	// The whole part by truncation: floor() is a call where the processor's baseline has no instruction for it.
	const auto floor_of = [](float p_value) { return int32_t(p_value) - (p_value < float(int32_t(p_value)) ? 1 : 0); };
	if (is_nearest(p_ref.filter)) {
		const uint32_t x = wrap_index(floor_of(position.x), p_width, p_ref.wrap_u);
		const uint32_t y = wrap_index(floor_of(position.y), p_height, p_ref.wrap_v);
		return { { x, x }, { y, y }, Vector2(0.0f) };
	}
	const int32_t x = floor_of(position.x - 0.5f);
	const int32_t y = floor_of(position.y - 0.5f);
	return { { wrap_index(x, p_width, p_ref.wrap_u), wrap_index(x + 1, p_width, p_ref.wrap_u) },
		{ wrap_index(y, p_height, p_ref.wrap_v), wrap_index(y + 1, p_height, p_ref.wrap_v) },
		position - 0.5f - Vector2(float(x), float(y)) };
}

Vector4 sample_texture(const SceneTexture &p_texture, const TextureRef &p_ref, const Vector2 &p_uv) {
	if (!p_texture.image || p_texture.image->is_empty()) {
		return Vector4(1.0f);
	}
	const TexelSquare square = find_texels(p_texture.image->width, p_texture.image->height, p_ref, p_uv);
	const Vector4 values[4] = { read_texel(p_texture, square.x[0], square.y[0]), read_texel(p_texture, square.x[1], square.y[0]),
		read_texel(p_texture, square.x[0], square.y[1]), read_texel(p_texture, square.x[1], square.y[1]) };
	return mix_texels(values, square.weight);
}

float select_channel(const Vector4 &p_value, TextureChannel p_channel) {
	return p_channel == TextureChannel::GRAYSCALE ? (p_value.x + p_value.y + p_value.z) / 3.0f : p_value[int(p_channel)];
}

} // namespace lucent
