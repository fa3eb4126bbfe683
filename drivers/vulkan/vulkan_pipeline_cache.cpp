// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_pipeline_cache.h"

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace lucent {

namespace {

// Before the driver's own data: drivers trust what they are given, so a torn file must be caught here.
struct FileHeader {
	char magic[8] = { 'L', 'U', 'C', 'P', 'I', 'P', 'E', '1' };
	uint64_t size_bytes = 0;
	uint64_t hash = 0;
	uint8_t cache_uuid[VK_UUID_SIZE] = {};
	uint8_t driver_uuid[VK_UUID_SIZE] = {};
};

uint64_t fnv1a(std::span<const char> p_data) {
	uint64_t hash = 14695981039346656037ull;
	for (char byte : p_data) {
		hash = (hash ^ uint8_t(byte)) * 1099511628211ull;
	}
	return hash;
}

FileHeader header_for(const VulkanContext &p_context, std::span<const char> p_data) {
	VkPhysicalDeviceIDProperties ids = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES };
	VkPhysicalDeviceProperties2 properties = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &ids };
	vkGetPhysicalDeviceProperties2(p_context.physical_device, &properties);
	FileHeader header;
	header.size_bytes = p_data.size();
	header.hash = fnv1a(p_data);
	std::memcpy(header.cache_uuid, properties.properties.pipelineCacheUUID, VK_UUID_SIZE);
	std::memcpy(header.driver_uuid, ids.driverUUID, VK_UUID_SIZE);
	return header;
}

std::string cache_path(const FileHeader &p_header) {
	std::filesystem::path folder;
	if (const char *xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && xdg[0] == '/') {
		folder = xdg;
	} else if (const char *home = std::getenv("HOME"); home != nullptr && home[0] == '/') {
		folder = std::filesystem::path(home) / ".cache";
	} else {
		return {};
	}
	std::string name = "pipelines-";
	for (uint8_t byte : p_header.cache_uuid) {
		name += fmt::format("{:02x}", byte);
	}
	const uint64_t driver = fnv1a({ reinterpret_cast<const char *>(p_header.driver_uuid), VK_UUID_SIZE });
	return (folder / "lucent" / fmt::format("{}-{:016x}.bin", name, driver)).string();
}

// The driver's data of a whole and matching file, else nothing.
std::vector<char> read_cache(const VulkanContext &p_context, const std::string &p_path) {
	std::ifstream file(p_path, std::ios::binary);
	std::vector<char> data((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
	FileHeader header;
	if (data.size() < sizeof(header)) {
		return {};
	}
	std::memcpy(&header, data.data(), sizeof(header));
	data.erase(data.begin(), data.begin() + sizeof(header));
	const FileHeader expected = header_for(p_context, data);
	return std::memcmp(&header, &expected, sizeof(header)) == 0 ? data : std::vector<char>();
}

} // namespace

void VulkanPipelineCache::load(const VulkanContext &p_context) {
	path = cache_path(header_for(p_context, {}));
	const std::vector<char> data = path.empty() ? std::vector<char>() : read_cache(p_context, path);
	loaded_hash = fnv1a(data);
	VkPipelineCacheCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
		.initialDataSize = data.size(),
		.pInitialData = data.data(),
	};
	if (vkCreatePipelineCache(p_context.device, &create_info, nullptr, &cache) != VK_SUCCESS) {
		create_info.initialDataSize = 0;
		VK_CHECK(vkCreatePipelineCache(p_context.device, &create_info, nullptr, &cache));
	}
}

void VulkanPipelineCache::save_and_destroy(const VulkanContext &p_context) {
	size_t size = 0;
	vkGetPipelineCacheData(p_context.device, cache, &size, nullptr);
	std::vector<char> data(size);
	const bool complete = vkGetPipelineCacheData(p_context.device, cache, &size, data.data()) == VK_SUCCESS;
	data.resize(size);
	vkDestroyPipelineCache(p_context.device, cache, nullptr);
	cache = VK_NULL_HANDLE;
	const FileHeader header = header_for(p_context, data);
	if (!complete || path.empty() || header.hash == loaded_hash) {
		return;
	}
	std::error_code error;
	std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
	const std::string temporary = fmt::format("{}.{}", path, getpid());
	std::ofstream file(temporary, std::ios::binary);
	file.write(reinterpret_cast<const char *>(&header), sizeof(header));
	file.write(data.data(), std::streamsize(data.size()));
	file.close();
	if (file) {
		std::filesystem::rename(temporary, path, error); // atomic: a reader sees the old file or the new one
	}
	if (!file || error) {
		std::filesystem::remove(temporary, error);
	}
}

} // namespace lucent
