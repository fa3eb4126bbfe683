// SPDX-License-Identifier: MIT
#include "servers/rendering/device/staging.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr uint64_t BLOCK_BYTES = 8u << 20;
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
	std::vector<Block> &slot = blocks[p_slot];
	// One ordinary block stays for the uploads of the frames to come.
	bool kept = false;
	std::erase_if(slot, [&](Block &r_block) {
		if (!kept && r_block.size == BLOCK_BYTES) {
			kept = true;
			r_block.used = 0;
			return false;
		}
		driver.destroy(r_block.buffer);
		return true;
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
