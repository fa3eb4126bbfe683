// SPDX-License-Identifier: MIT
#pragma once
// Instance, device, queue, and what they can do.

#include "drivers/vulkan/vulkan_common.h"
#include "drivers/vulkan/vulkan_driver.h"

#include <atomic>

namespace lucent {

struct ValidationState {
	std::atomic<uint64_t> messages = 0;
	bool abort_at_first = false;
};

class VulkanContext {
public:
	VulkanContext() = default;
	VulkanContext(const VulkanContext &) = delete;
	VulkanContext &operator=(const VulkanContext &) = delete;
	~VulkanContext();

	Status create_instance(bool p_validation);
	// Usable devices, best first.
	Result<std::vector<DeviceInfo>> list_devices();
	Status create_device(const std::string &p_filter);

	void set_name(VkObjectType p_type, uint64_t p_object, const std::string &p_name) const;

	VkInstance instance = VK_NULL_HANDLE;
	VkPhysicalDevice physical_device = VK_NULL_HANDLE;
	VkDevice device = VK_NULL_HANDLE;
	VkQueue queue = VK_NULL_HANDLE;
	uint32_t queue_family = 0;
	uint32_t timestamp_bits = 0;
	bool debug_utils = false;
	VkPhysicalDeviceProperties properties{};
	VkPhysicalDeviceFeatures features{};
	VkPhysicalDeviceMemoryProperties memory_properties{};
	DeviceInfo info;
	ValidationState validation;

private:
	struct Candidate {
		VkPhysicalDevice device = VK_NULL_HANDLE;
		uint32_t queue_family = 0;
		uint32_t timestamp_bits = 0;
		DeviceInfo info;
	};
	Result<std::vector<Candidate>> candidates();
	VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
};

} // namespace lucent
