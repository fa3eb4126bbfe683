// SPDX-License-Identifier: MIT
#pragma once
// Textures that a material reads at the same place, their texels side by side: one hit touches a few cache lines, however many textures.

#include "modules/reference/huge_arena.h"
#include "modules/reference/texture_sampling.h"

#include <vector>

namespace lucent {

struct TexelFootprint {
	const std::byte *texels[4]; // (0, 0), (1, 0), (0, 1), (1, 1)
	Vector2 weight; // of the second column and row
};

class TexelGroup {
public:
	static constexpr uint32_t MAX_MEMBERS = 4;

	bool is_empty() const { return member_count == 0; }
	// Joins; false where p_texture isn't read at the same texels as the members, or the group is full. r_member: for read().
	bool add(const SceneTexture &p_texture, const TextureRef &p_ref, uint32_t &r_member);
	// After the last add(): copies the texels. Blocks of 4 x 4 texels in Morton order, which cache lines cut into squares.
	void build(HugeArena &r_arena);
	bool holds_same_texels(const TexelGroup &p_other) const;
	void share(const TexelGroup &p_other) { texels = p_other.texels; }

	uint8_t uv_set() const { return ref.uv_set; }
	// Also fetches the texels into the cache.
	TexelFootprint footprint(const Vector2 &p_uv) const;
	Vector4 read(const TexelFootprint &p_footprint, uint32_t p_member) const;

private:
	const std::byte *address(uint32_t p_x, uint32_t p_y) const;

	const std::byte *texels = nullptr;
	uint32_t width = 0;
	uint32_t height = 0;
	size_t block_row_bytes = 0;
	uint32_t stride_bytes = 0;
	bool is_float = false;
	uint32_t member_count = 0;
	TextureRef ref;
	SceneTexture members[MAX_MEMBERS];
};

} // namespace lucent
