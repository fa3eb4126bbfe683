// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_driver_impl.h"

#include <cstring>

namespace lucent {

namespace {

std::string environment(const char *p_name) {
	const char *value = std::getenv(p_name);
	return value != nullptr ? value : "";
}

} // namespace

Result<std::unique_ptr<RenderingDeviceDriver>> create_vulkan_driver(const VulkanDriverOptions &p_options) {
	return VulkanDriver::create(p_options);
}

Result<std::vector<DeviceInfo>> list_vulkan_devices() {
	VulkanContext context;
	if (Status status = context.create_instance(false); !status) {
		return status.error();
	}
	return context.list_devices();
}

Result<std::unique_ptr<RenderingDeviceDriver>> VulkanDriver::create(const VulkanDriverOptions &p_options) {
	std::unique_ptr<VulkanDriver> driver(new VulkanDriver());
	const bool validation = p_options.validation || environment("LUCENT_VALIDATION") == "1";
	if (Status status = driver->context.create_instance(validation); !status) {
		return status.error();
	}
	const std::string filter = p_options.device_filter.empty() ? environment("LUCENT_DEVICE") : p_options.device_filter;
	if (Status status = driver->context.create_device(filter); !status) {
		return status.error();
	}
	driver->memory = std::make_unique<VulkanMemory>(driver->context);
	driver->pipeline_cache.load(driver->context);
	driver->create_slots();
	return std::unique_ptr<RenderingDeviceDriver>(std::move(driver));
}

void VulkanDriver::create_slots() {
	for (VulkanSlot &slot : slots) {
		const VkCommandPoolCreateInfo pool_info = {
			.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
			.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
			.queueFamilyIndex = context.queue_family,
		};
		VK_CHECK(vkCreateCommandPool(context.device, &pool_info, nullptr, &slot.command_pool));
		const VkCommandBufferAllocateInfo buffer_info = {
			.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
			.commandPool = slot.command_pool,
			.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
			.commandBufferCount = 1,
		};
		VK_CHECK(vkAllocateCommandBuffers(context.device, &buffer_info, &slot.commands));
		const VkFenceCreateInfo fence_info = { .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO };
		VK_CHECK(vkCreateFence(context.device, &fence_info, nullptr, &slot.fence));
		if (context.info.timestamps) {
			const VkQueryPoolCreateInfo query_info = {
				.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
				.queryType = VK_QUERY_TYPE_TIMESTAMP,
				.queryCount = MAX_TIMESTAMPS,
			};
			VK_CHECK(vkCreateQueryPool(context.device, &query_info, nullptr, &slot.timestamps));
		}
	}
}

VulkanDriver::~VulkanDriver() {
	if (memory == nullptr) {
		return; // create() failed before there was anything
	}
	vkDeviceWaitIdle(context.device);
	pipeline_cache.save_and_destroy(context);
	for (VulkanSlot &slot : slots) {
		vkDestroyCommandPool(context.device, slot.command_pool, nullptr);
		vkDestroyFence(context.device, slot.fence, nullptr);
		vkDestroyQueryPool(context.device, slot.timestamps, nullptr);
		for (VkDescriptorPool pool : slot.descriptor_pools) {
			vkDestroyDescriptorPool(context.device, pool, nullptr);
		}
	}
	for (VkDescriptorPool pool : set_pools) {
		vkDestroyDescriptorPool(context.device, pool, nullptr);
	}
	for (const auto &[key, layout] : pipeline_layouts) {
		vkDestroyPipelineLayout(context.device, layout, nullptr);
	}
	for (const auto &[key, layout] : set_layouts) {
		vkDestroyDescriptorSetLayout(context.device, layout->layout, nullptr);
	}
	memory.reset();
}

void VulkanDriver::begin_commands(uint32_t p_slot) {
	slot_in_use = p_slot;
	VulkanSlot &slot = slots[p_slot];
	if (slot.submitted) {
		VK_CHECK(vkWaitForFences(context.device, 1, &slot.fence, VK_TRUE, UINT64_MAX));
		VK_CHECK(vkResetFences(context.device, 1, &slot.fence));
		slot.submitted = false;
	}
	VK_CHECK(vkResetCommandPool(context.device, slot.command_pool, 0));
	for (VkDescriptorPool pool : slot.descriptor_pools) {
		VK_CHECK(vkResetDescriptorPool(context.device, pool, 0));
	}
	slot.descriptor_pool_in_use = 0;
	bound_pipeline = nullptr;
	const VkCommandBufferBeginInfo begin_info = {
		.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
		.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
	};
	VK_CHECK(vkBeginCommandBuffer(slot.commands, &begin_info));
	if (slot.timestamps != VK_NULL_HANDLE) {
		vkCmdResetQueryPool(slot.commands, slot.timestamps, 0, MAX_TIMESTAMPS);
	}
}

void VulkanDriver::submit_commands() {
	VulkanSlot &slot = slots[slot_in_use];
	VK_CHECK(vkEndCommandBuffer(slot.commands));
	const VkCommandBufferSubmitInfo commands_info = {
		.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
		.commandBuffer = slot.commands,
	};
	const VkSubmitInfo2 submit = {
		.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
		.commandBufferInfoCount = 1,
		.pCommandBufferInfos = &commands_info,
	};
	VK_CHECK(vkQueueSubmit2(context.queue, 1, &submit, slot.fence));
	slot.submitted = true;
}

void VulkanDriver::wait_idle() {
	for (VulkanSlot &slot : slots) {
		if (slot.submitted) {
			VK_CHECK(vkWaitForFences(context.device, 1, &slot.fence, VK_TRUE, UINT64_MAX));
		}
	}
}

bool VulkanDriver::read_timestamps(uint32_t p_slot, std::span<double> r_ms) {
	VulkanSlot &slot = slots[p_slot];
	if (slot.timestamps == VK_NULL_HANDLE || r_ms.empty()) {
		return false;
	}
	std::vector<uint64_t> ticks(r_ms.size());
	const VkResult result = vkGetQueryPoolResults(context.device, slot.timestamps, 0, uint32_t(ticks.size()), ticks.size() * sizeof(uint64_t), ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
	if (result != VK_SUCCESS) {
		return false;
	}
	const uint64_t mask = context.timestamp_bits >= 64 ? UINT64_MAX : (uint64_t(1) << context.timestamp_bits) - 1;
	for (size_t i = 0; i < ticks.size(); i++) {
		r_ms[i] = double((ticks[i] - ticks[0]) & mask) * context.properties.limits.timestampPeriod * 1e-6;
	}
	return true;
}

} // namespace lucent
