// SPDX-License-Identifier: MIT
#include "servers/rendering/device/staging.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr uint64_t BLOCK_BYTES = 8u << 20;
constexpr uint64_t MAX_KEPT_BYTES = 64u << 20; // per slot
constexpr uint64_t ALIGNMENT_BYTES = 16; // the largest texel

} // namespace

StagingMemory::~StagingMemory() {
	for (const std::vector<Block> &slot : blocks) {
		for (const Block &block : slot) {
			driver.destroy(block.buffer);
		}
	}
}

StagingRange StagingMemory::allocate(uint32_t p_slot, uint64_t p_size_bytes) {
	for (Block &block : blocks[p_slot]) {
		const uint64_t start = (block.used + ALIGNMENT_BYTES - 1) / ALIGNMENT_BYTES * ALIGNMENT_BYTES;
		if (start + p_size_bytes <= block.size) {
			block.used = start + p_size_bytes;
			return { block.buffer, start, block.data + start };
		}
	}
	Block block;
	block.size = std::max(p_size_bytes, BLOCK_BYTES);
	block.used = p_size_bytes;
	uint64_t allocated = 0;
	block.buffer = driver.create_buffer({ block.size, 0, "staging" }, MemoryKind::UPLOAD, allocated);
	if (!block.buffer.is_valid()) {
		return {};
	}
	block.data = driver.mapped(block.buffer);
	blocks[p_slot].push_back(block);
	return { block.buffer, 0, block.data };
}

void StagingMemory::recycle(uint32_t p_slot) {
	// What this turn used is kept for the next, within limits.
	uint64_t kept = 0;
	std::erase_if(blocks[p_slot], [&](Block &r_block) {
		const bool keep = kept == 0 || (r_block.used != 0 && kept + r_block.size <= MAX_KEPT_BYTES);
		if (keep) {
			kept += r_block.size;
			r_block.used = 0;
		} else {
			driver.destroy(r_block.buffer);
		}
		return !keep;
	});
}

uint64_t StagingMemory::in_use_bytes(uint32_t p_slot) const {
	uint64_t bytes = 0;
	for (const Block &block : blocks[p_slot]) {
		bytes += block.used;
	}
	return bytes;
}

} // namespace lucent
