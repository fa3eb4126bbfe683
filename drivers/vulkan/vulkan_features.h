// SPDX-License-Identifier: MIT
#pragma once
// The features that the driver needs, and those that it takes where they are.

#include "drivers/vulkan/vulkan_common.h"

namespace lucent {

// A chain for vkGetPhysicalDeviceFeatures2 and vkCreateDevice.
struct VulkanFeatures {
	VkPhysicalDeviceFeatures2 core = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2 };
	VkPhysicalDeviceVulkan11Features v11 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES };
	VkPhysicalDeviceVulkan12Features v12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES };
	VkPhysicalDeviceVulkan13Features v13 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES };

	VulkanFeatures();
	VulkanFeatures(const VulkanFeatures &) = delete;
	VulkanFeatures &operator=(const VulkanFeatures &) = delete;
	void query(VkPhysicalDevice p_device);
	// Empty: everything needed is there. Else what is missing.
	std::string missing() const;
	// What of these the driver turns on.
	void keep_wanted();
	std::vector<std::string> optional_names() const;
};

} // namespace lucent
