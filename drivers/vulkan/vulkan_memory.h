// SPDX-License-Identifier: MIT
#pragma once
// Sub-allocation of device memory: blocks per memory type, first fit; large or dedicated requests get a block of their own.
// Buffers and images never share a block, so bufferImageGranularity needs no care.

#include "drivers/vulkan/vulkan_context.h"

#include <list>
#include <map>

namespace lucent {

struct MemoryBlock {
	VkDeviceMemory memory = VK_NULL_HANDLE;
	VkDeviceSize size = 0;
	uint32_t type = 0;
	bool for_images = false;
	bool dedicated = false;
	std::byte *mapped = nullptr;
	std::map<VkDeviceSize, VkDeviceSize> free_ranges; // offset -> size
};

struct MemoryAllocation {
	MemoryBlock *block = nullptr;
	VkDeviceSize offset = 0;
	VkDeviceSize size = 0;
	bool is_valid() const { return block != nullptr; }
	std::byte *mapped() const { return block->mapped != nullptr ? block->mapped + offset : nullptr; }
};

class VulkanMemory {
public:
	explicit VulkanMemory(const VulkanContext &p_context) :
			context(p_context) {}
	VulkanMemory(const VulkanMemory &) = delete;
	VulkanMemory &operator=(const VulkanMemory &) = delete;
	~VulkanMemory();

	// Binds nothing. Invalid: out of memory.
	MemoryAllocation allocate_for(VkBuffer p_buffer, MemoryKind p_kind);
	MemoryAllocation allocate_for(VkImage p_image);
	void free(MemoryAllocation &r_allocation);

private:
	MemoryAllocation allocate(const VkMemoryRequirements &p_needs, MemoryKind p_kind, bool p_for_images, const VkMemoryDedicatedAllocateInfo *p_dedicated);
	MemoryAllocation allocate_of_type(const VkMemoryRequirements &p_needs, uint32_t p_type, bool p_map, bool p_for_images, const VkMemoryDedicatedAllocateInfo *p_dedicated);
	std::vector<uint32_t> types_for(uint32_t p_allowed, MemoryKind p_kind) const; // best first
	MemoryBlock *make_block(VkDeviceSize p_size, uint32_t p_type, bool p_map, bool p_for_images, const VkMemoryDedicatedAllocateInfo *p_dedicated);
	bool has_other_empty(const MemoryBlock &p_block) const;
	const VulkanContext &context;
	std::list<MemoryBlock> blocks;
};

} // namespace lucent
