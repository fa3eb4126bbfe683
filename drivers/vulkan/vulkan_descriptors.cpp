// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_driver_impl.h"

namespace lucent {

namespace {

constexpr uint32_t SETS_PER_POOL = 256;

} // namespace

DriverSetLayout VulkanDriver::set_layout(std::span<const DescriptorKind> p_kinds) {
	std::vector<DescriptorKind> kinds(p_kinds.begin(), p_kinds.end());
	std::unique_ptr<VulkanSetLayout> &entry = set_layouts[kinds];
	if (entry == nullptr) {
		std::vector<VkDescriptorSetLayoutBinding> bindings;
		for (uint32_t i = 0; i < kinds.size(); i++) {
			if (kinds[i] != DescriptorKind::NONE) {
				bindings.push_back({ .binding = i, .descriptorType = to_vk(kinds[i]), .descriptorCount = 1, .stageFlags = ALL_STAGES });
			}
		}
		const VkDescriptorSetLayoutCreateInfo create_info = {
			.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
			.bindingCount = uint32_t(bindings.size()),
			.pBindings = bindings.data(),
		};
		entry = std::make_unique<VulkanSetLayout>();
		entry->kinds = std::move(kinds);
		VK_CHECK(vkCreateDescriptorSetLayout(context.device, &create_info, nullptr, &entry->layout));
	}
	return make_id<DriverSetLayout>(entry.get());
}

VkDescriptorPool VulkanDriver::make_descriptor_pool(bool p_free_sets) {
	const VkDescriptorPoolSize sizes[] = {
		{ VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, SETS_PER_POOL * 4 },
		{ VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, SETS_PER_POOL * 4 },
		{ VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, SETS_PER_POOL * 6 },
		{ VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, SETS_PER_POOL * 2 },
		{ VK_DESCRIPTOR_TYPE_SAMPLER, SETS_PER_POOL * 2 },
		{ VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, SETS_PER_POOL * 8 },
	};
	const VkDescriptorPoolCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
		.flags = p_free_sets ? VkDescriptorPoolCreateFlags(VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT) : 0,
		.maxSets = SETS_PER_POOL,
		.poolSizeCount = uint32_t(std::size(sizes)),
		.pPoolSizes = sizes,
	};
	VkDescriptorPool pool = VK_NULL_HANDLE;
	VK_CHECK(vkCreateDescriptorPool(context.device, &create_info, nullptr, &pool));
	return pool;
}

VkDescriptorSet VulkanDriver::allocate_transient(VkDescriptorSetLayout p_layout) {
	VulkanSlot &slot = slots[slot_in_use];
	while (true) {
		const bool fresh = slot.descriptor_pool_in_use == slot.descriptor_pools.size();
		if (fresh) {
			slot.descriptor_pools.push_back(make_descriptor_pool(false));
		}
		const VkDescriptorSetAllocateInfo allocate_info = {
			.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
			.descriptorPool = slot.descriptor_pools[slot.descriptor_pool_in_use],
			.descriptorSetCount = 1,
			.pSetLayouts = &p_layout,
		};
		VkDescriptorSet set = VK_NULL_HANDLE;
		const VkResult result = vkAllocateDescriptorSets(context.device, &allocate_info, &set);
		if (result == VK_SUCCESS) {
			return set;
		}
		INVARIANT(!fresh, "a fresh pool refuses one set: {}", result_name(result));
		slot.descriptor_pool_in_use++;
	}
}

void VulkanDriver::write_set(VkDescriptorSet p_set, std::span<const DriverBinding> p_bindings) {
	scratch_writes.clear();
	scratch_images.clear();
	scratch_buffers.clear();
	scratch_images.reserve(p_bindings.size()); // the writes point into these two
	scratch_buffers.reserve(p_bindings.size());
	for (const DriverBinding &binding : p_bindings) {
		VkWriteDescriptorSet write = {
			.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
			.dstSet = p_set,
			.dstBinding = binding.binding,
			.descriptorCount = 1,
			.descriptorType = to_vk(binding.kind),
		};
		if (binding.kind == DescriptorKind::STORAGE_BUFFER || binding.kind == DescriptorKind::UNIFORM_BUFFER) {
			write.pBufferInfo = &scratch_buffers.emplace_back(VkDescriptorBufferInfo{ get<VulkanBuffer>(binding.buffer).buffer, 0, VK_WHOLE_SIZE });
		} else {
			VkDescriptorImageInfo &image = scratch_images.emplace_back();
			image.sampler = VkSampler(binding.sampler.value);
			if (binding.texture.is_valid()) {
				image.imageView = view_of(get<VulkanTexture>(binding.texture), binding.range, binding.shape);
				image.imageLayout = to_vk(binding.layout);
			}
			write.pImageInfo = &image;
		}
		scratch_writes.push_back(write);
	}
	vkUpdateDescriptorSets(context.device, uint32_t(scratch_writes.size()), scratch_writes.data(), 0, nullptr);
}

DriverSet VulkanDriver::create_set(DriverSetLayout p_layout, std::span<const DriverBinding> p_bindings, const std::string &p_name) {
	VulkanSet set;
	VkDescriptorSetAllocateInfo allocate_info = {
		.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
		.descriptorSetCount = 1,
		.pSetLayouts = &get<VulkanSetLayout>(p_layout).layout,
	};
	// The newest pool is the likeliest to have room; older ones may have had sets freed.
	for (auto pool = set_pools.rbegin(); pool != set_pools.rend() && set.set == VK_NULL_HANDLE; ++pool) {
		allocate_info.descriptorPool = set.pool = *pool;
		if (vkAllocateDescriptorSets(context.device, &allocate_info, &set.set) != VK_SUCCESS) {
			set.set = VK_NULL_HANDLE;
		}
	}
	if (set.set == VK_NULL_HANDLE) {
		set_pools.push_back(make_descriptor_pool(true));
		allocate_info.descriptorPool = set.pool = set_pools.back();
		VK_CHECK(vkAllocateDescriptorSets(context.device, &allocate_info, &set.set));
	}
	context.set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET, uint64_t(set.set), p_name);
	write_set(set.set, p_bindings);
	return make_id<DriverSet>(new VulkanSet(set));
}

void VulkanDriver::destroy(DriverSet p_set) {
	if (p_set.is_valid()) {
		VulkanSet &set = get<VulkanSet>(p_set);
		vkFreeDescriptorSets(context.device, set.pool, 1, &set.set);
		delete &set;
	}
}

void VulkanDriver::cmd_bind_transient(DriverSetLayout p_layout, std::span<const DriverBinding> p_bindings) {
	const VkDescriptorSet set = allocate_transient(get<VulkanSetLayout>(p_layout).layout);
	write_set(set, p_bindings);
	vkCmdBindDescriptorSets(commands(), bound_pipeline->bind_point, bound_pipeline->layout, 0, 1, &set, 0, nullptr);
}

void VulkanDriver::cmd_bind_set(DriverSet p_set) {
	vkCmdBindDescriptorSets(commands(), bound_pipeline->bind_point, bound_pipeline->layout, 1, 1, &get<VulkanSet>(p_set).set, 0, nullptr);
}

} // namespace lucent
