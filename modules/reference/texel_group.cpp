// SPDX-License-Identifier: MIT
#include "modules/reference/texel_group.h"

#include <cstring>

namespace lucent {

namespace {

constexpr uint32_t BLOCK_TEXELS = 16;

// Bits 0 and 1 go to bits 0 and 2.
uint32_t spread_bits(uint32_t p_value) {
	return (p_value & 1) | (p_value & 2) << 1;
}

// The same texels, whatever the channel.
bool reads_alike(const TextureRef &p_a, const TextureRef &p_b) {
	return p_a.uv_set == p_b.uv_set && p_a.wrap_u == p_b.wrap_u && p_a.wrap_v == p_b.wrap_v && p_a.filter == p_b.filter && p_a.uv_offset == p_b.uv_offset && p_a.uv_scale == p_b.uv_scale && p_a.uv_rotation == p_b.uv_rotation;
}

bool is_same(const SceneTexture &p_a, const SceneTexture &p_b) {
	return p_a.image == p_b.image && p_a.srgb == p_b.srgb;
}

} // namespace

bool TexelGroup::add(const SceneTexture &p_texture, const TextureRef &p_ref, uint32_t &r_member) {
	const Image &image = *p_texture.image;
	const bool texture_is_float = image.format == ImageFormat::RGBA32F;
	if (is_empty()) {
		ref = p_ref;
		width = image.width;
		height = image.height;
		is_float = texture_is_float;
	} else if (!reads_alike(ref, p_ref)) {
		return false;
	}
	for (r_member = 0; r_member < member_count; r_member++) {
		if (is_same(members[r_member], p_texture)) {
			return true;
		}
	}
	const bool fits = member_count < (is_float ? 1 : MAX_MEMBERS) && is_float == texture_is_float && width == image.width && height == image.height;
	if (fits) {
		members[member_count++] = p_texture;
		stride_bytes = image.texel_size_bytes() * (member_count == 3 ? 4 : member_count);
		block_row_bytes = size_t((width + 3) / 4) * BLOCK_TEXELS * stride_bytes;
	}
	return fits;
}

bool TexelGroup::holds_same_texels(const TexelGroup &p_other) const {
	bool same = member_count == p_other.member_count;
	for (uint32_t i = 0; same && i < member_count; i++) {
		same = members[i].image == p_other.members[i].image;
	}
	return same;
}

void TexelGroup::build(HugeArena &r_arena) {
	std::byte *const memory = r_arena.allocate(block_row_bytes * ((height + 3) / 4));
	texels = memory;
	for (uint32_t i = 0; i < member_count; i++) {
		const Image &image = *members[i].image;
		const uint32_t size = image.texel_size_bytes();
		const std::byte *from = image.texels.data();
		for (uint32_t y = 0; y < height; y++) {
			for (uint32_t x = 0; x < width; x++, from += size) {
				std::memcpy(memory + (address(x, y) - texels) + size_t(i) * size, from, size);
			}
		}
	}
}

const std::byte *TexelGroup::address(uint32_t p_x, uint32_t p_y) const {
	const size_t in_row = size_t((p_x & ~3u) * 4 + spread_bits(p_x) + 2 * spread_bits(p_y)) * stride_bytes;
	return texels + (p_y / 4) * block_row_bytes + in_row;
}

TexelFootprint TexelGroup::footprint(const Vector2 &p_uv) const {
	const TexelSquare square = find_texels(width, height, ref, p_uv);
	TexelFootprint result;
	for (uint32_t i = 0; i < 4; i++) {
		result.texels[i] = address(square.x[i & 1], square.y[i >> 1]);
		__builtin_prefetch(result.texels[i]);
	}
	result.weight = square.weight;
	return result;
}

Vector4 TexelGroup::read(const TexelFootprint &p_footprint, uint32_t p_member) const {
	Vector4 values[4];
	for (uint32_t i = 0; i < 4; i++) {
		values[i] = is_float ? decode_texel_float(p_footprint.texels[i]) : decode_texel_8(p_footprint.texels[i] + 4 * p_member, members[p_member].srgb);
	}
	return mix_texels(values, p_footprint.weight);
}

} // namespace lucent
