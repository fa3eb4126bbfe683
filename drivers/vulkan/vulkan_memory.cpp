// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_memory.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr VkDeviceSize MIB = 1024 * 1024;

bool take_from(MemoryBlock &r_block, VkDeviceSize p_size, VkDeviceSize p_alignment, VkDeviceSize &r_offset) {
	for (auto range = r_block.free_ranges.begin(); range != r_block.free_ranges.end(); ++range) {
		const auto [start, size] = *range;
		const VkDeviceSize offset = (start + p_alignment - 1) / p_alignment * p_alignment;
		if (offset + p_size > start + size) {
			continue;
		}
		r_block.free_ranges.erase(range);
		if (offset > start) {
			r_block.free_ranges[start] = offset - start;
		}
		if (start + size > offset + p_size) {
			r_block.free_ranges[offset + p_size] = start + size - offset - p_size;
		}
		r_offset = offset;
		return true;
	}
	return false;
}

bool is_empty(const MemoryBlock &p_block) {
	return !p_block.dedicated && p_block.free_ranges.size() == 1 && p_block.free_ranges.begin()->second == p_block.size;
}

// Joins the range with its free neighbours. True: the whole block is free now.
bool give_back(MemoryBlock &r_block, const MemoryAllocation &p_allocation) {
	auto range = r_block.free_ranges.emplace(p_allocation.offset, p_allocation.size).first;
	const auto next = std::next(range);
	if (next != r_block.free_ranges.end() && range->first + range->second == next->first) {
		range->second += next->second;
		r_block.free_ranges.erase(next);
	}
	if (range != r_block.free_ranges.begin()) {
		const auto previous = std::prev(range);
		if (previous->first + previous->second == range->first) {
			previous->second += range->second;
			r_block.free_ranges.erase(range);
		}
	}
	return is_empty(r_block);
}

} // namespace

VulkanMemory::~VulkanMemory() {
	for (MemoryBlock &block : blocks) {
		vkFreeMemory(context.device, block.memory, nullptr);
	}
}

MemoryAllocation VulkanMemory::allocate_for(VkBuffer p_buffer, MemoryKind p_kind) {
	const VkBufferMemoryRequirementsInfo2 request = { .sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_REQUIREMENTS_INFO_2, .buffer = p_buffer };
	VkMemoryDedicatedRequirements dedicated = { .sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS };
	VkMemoryRequirements2 needs = { .sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, .pNext = &dedicated };
	vkGetBufferMemoryRequirements2(context.device, &request, &needs);
	const VkMemoryDedicatedAllocateInfo owner = { .sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO, .buffer = p_buffer };
	return allocate(needs.memoryRequirements, p_kind, false, dedicated.requiresDedicatedAllocation ? &owner : nullptr);
}

MemoryAllocation VulkanMemory::allocate_for(VkImage p_image) {
	const VkImageMemoryRequirementsInfo2 request = { .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2, .image = p_image };
	VkMemoryDedicatedRequirements dedicated = { .sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS };
	VkMemoryRequirements2 needs = { .sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, .pNext = &dedicated };
	vkGetImageMemoryRequirements2(context.device, &request, &needs);
	const VkMemoryDedicatedAllocateInfo owner = { .sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO, .image = p_image };
	return allocate(needs.memoryRequirements, MemoryKind::DEVICE, true, dedicated.requiresDedicatedAllocation ? &owner : nullptr);
}

std::vector<uint32_t> VulkanMemory::types_for(uint32_t p_allowed, MemoryKind p_kind) const {
	const VkPhysicalDeviceMemoryProperties &memory = context.memory_properties;
	std::vector<std::pair<int, uint32_t>> rated;
	for (uint32_t i = 0; i < memory.memoryTypeCount; i++) {
		const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
		constexpr VkMemoryPropertyFlags HOST = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
		const bool special = (flags & (VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT | VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD)) != 0;
		if ((p_allowed & (1u << i)) == 0 || special || (p_kind != MemoryKind::DEVICE && (flags & HOST) != HOST)) {
			continue;
		}
		const bool local = (flags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
		const bool cached = (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT) != 0;
		const bool visible = (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
		int rating = 0;
		if (p_kind == MemoryKind::DEVICE) {
			rating = (local ? 2 : 0) + (visible ? 0 : 1);
		} else if (p_kind == MemoryKind::UPLOAD) {
			rating = (local ? 0 : 2) + (cached ? 0 : 1);
		} else {
			rating = (cached ? 2 : 0) + (local ? 0 : 1);
		}
		rated.push_back({ -rating, i });
	}
	std::sort(rated.begin(), rated.end());
	std::vector<uint32_t> types;
	for (const auto &[rating, type] : rated) {
		types.push_back(type);
	}
	return types;
}

MemoryAllocation VulkanMemory::allocate(const VkMemoryRequirements &p_needs, MemoryKind p_kind, bool p_for_images, const VkMemoryDedicatedAllocateInfo *p_dedicated) {
	for (uint32_t type : types_for(p_needs.memoryTypeBits, p_kind)) {
		const MemoryAllocation allocation = allocate_of_type(p_needs, type, p_kind != MemoryKind::DEVICE, p_for_images, p_dedicated);
		if (allocation.is_valid()) {
			return allocation;
		}
	}
	return {};
}

MemoryAllocation VulkanMemory::allocate_of_type(const VkMemoryRequirements &p_needs, uint32_t p_type, bool p_map, bool p_for_images, const VkMemoryDedicatedAllocateInfo *p_dedicated) {
	const VkDeviceSize heap = context.memory_properties.memoryHeaps[context.memory_properties.memoryTypes[p_type].heapIndex].size;
	const VkDeviceSize block_size = heap >= 2048 * MIB ? 64 * MIB : 16 * MIB;
	MemoryAllocation allocation = { nullptr, 0, p_needs.size };
	if (p_dedicated != nullptr || p_needs.size > block_size / 4) {
		allocation.block = make_block(p_needs.size, p_type, p_map, p_for_images, p_dedicated);
		if (allocation.block != nullptr) {
			allocation.block->dedicated = true;
		}
		return allocation;
	}
	for (MemoryBlock &block : blocks) {
		// A mapped block and an unmapped one of the same type serve different kinds.
		if (!block.dedicated && block.type == p_type && block.for_images == p_for_images && (block.mapped != nullptr) == p_map && take_from(block, p_needs.size, p_needs.alignment, allocation.offset)) {
			allocation.block = &block;
			return allocation;
		}
	}
	allocation.block = make_block(block_size, p_type, p_map, p_for_images, nullptr);
	if (allocation.block != nullptr) {
		allocation.block->free_ranges[0] = block_size;
		take_from(*allocation.block, p_needs.size, p_needs.alignment, allocation.offset);
	}
	return allocation;
}

MemoryBlock *VulkanMemory::make_block(VkDeviceSize p_size, uint32_t p_type, bool p_map, bool p_for_images, const VkMemoryDedicatedAllocateInfo *p_dedicated) {
	const VkMemoryAllocateInfo allocate_info = {
		.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
		.pNext = p_dedicated,
		.allocationSize = p_size,
		.memoryTypeIndex = p_type,
	};
	MemoryBlock block;
	block.size = p_size;
	block.type = p_type;
	block.for_images = p_for_images;
	if (vkAllocateMemory(context.device, &allocate_info, nullptr, &block.memory) != VK_SUCCESS) {
		return nullptr;
	}
	if (p_map) {
		void *mapped = nullptr;
		if (vkMapMemory(context.device, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped) != VK_SUCCESS) {
			vkFreeMemory(context.device, block.memory, nullptr);
			return nullptr;
		}
		block.mapped = static_cast<std::byte *>(mapped);
	}
	return &blocks.emplace_back(std::move(block));
}

// One empty block of each sort stays: making a block takes milliseconds on some drivers.
bool VulkanMemory::has_other_empty(const MemoryBlock &p_block) const {
	return std::any_of(blocks.begin(), blocks.end(), [&](const MemoryBlock &p_other) {
		const bool same_sort = p_other.type == p_block.type && p_other.for_images == p_block.for_images && (p_other.mapped != nullptr) == (p_block.mapped != nullptr);
		return &p_other != &p_block && same_sort && is_empty(p_other);
	});
}

void VulkanMemory::free(MemoryAllocation &r_allocation) {
	MemoryBlock *block = r_allocation.block;
	if (block == nullptr) {
		return;
	}
	const bool release = block->dedicated || (give_back(*block, r_allocation) && has_other_empty(*block));
	if (release) {
		vkFreeMemory(context.device, block->memory, nullptr);
		blocks.remove_if([&](const MemoryBlock &p_block) { return &p_block == block; });
	}
	r_allocation = {};
}

} // namespace lucent
