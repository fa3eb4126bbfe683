// SPDX-License-Identifier: MIT
#pragma once
// VkPipelineCache kept in $XDG_CACHE_HOME/lucent (or ~/.cache/lucent), one file a device and driver. A file that is corrupt
// or foreign counts as none; a folder that can't be written to is no error.

#include "drivers/vulkan/vulkan_context.h"

namespace lucent {

class VulkanPipelineCache {
public:
	void load(const VulkanContext &p_context);
	// Writes the file if pipelines were added since it was loaded, and destroys the cache.
	void save_and_destroy(const VulkanContext &p_context);
	VkPipelineCache handle() const { return cache; }

private:
	std::string path;
	uint64_t loaded_hash = 0;
	VkPipelineCache cache = VK_NULL_HANDLE;
};

} // namespace lucent
