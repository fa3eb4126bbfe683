// SPDX-License-Identifier: MIT
#define VOLK_IMPLEMENTATION
#include "drivers/vulkan/vulkan_context.h"

#include "drivers/vulkan/vulkan_features.h"

#include <algorithm>
#include <cstring>

namespace lucent {

namespace {

constexpr const char *VALIDATION_LAYER = "VK_LAYER_KHRONOS_validation";
constexpr const char *NO_DEVICE_HELP = "install a driver; for rendering on the CPU, on Debian: apt-get install mesa-vulkan-drivers";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT p_types, const VkDebugUtilsMessengerCallbackDataEXT *p_data, void *p_state) {
	if ((p_types & VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT) == 0) {
		return VK_FALSE; // the loader's and drivers' own chatter
	}
	ValidationState *state = static_cast<ValidationState *>(p_state);
	state->messages++;
	log_error("Vulkan validation: {}", p_data->pMessage);
	if (state->abort_at_first) {
		std::abort();
	}
	return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationState *p_state) {
	return {
		.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
		.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
		.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT,
		.pfnUserCallback = on_message,
		.pUserData = p_state,
	};
}

bool has_layer(const char *p_name) {
	uint32_t count = 0;
	vkEnumerateInstanceLayerProperties(&count, nullptr);
	std::vector<VkLayerProperties> layers(count);
	vkEnumerateInstanceLayerProperties(&count, layers.data());
	return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties &p_layer) { return std::strcmp(p_layer.layerName, p_name) == 0; });
}

bool has_instance_extension(const char *p_name) {
	uint32_t count = 0;
	vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
	std::vector<VkExtensionProperties> extensions(count);
	vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
	return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties &p_extension) { return std::strcmp(p_extension.extensionName, p_name) == 0; });
}

DeviceType device_type(VkPhysicalDeviceType p_type) {
	switch (p_type) {
		case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
			return DeviceType::DISCRETE;
		case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
			return DeviceType::INTEGRATED;
		case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
			return DeviceType::VIRTUAL;
		case VK_PHYSICAL_DEVICE_TYPE_CPU:
			return DeviceType::CPU;
		default:
			return DeviceType::OTHER;
	}
}

DeviceInfo describe(VkPhysicalDevice p_device, const VulkanFeatures &p_features, uint32_t p_timestamp_bits) {
	VkPhysicalDeviceVulkan12Properties v12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES };
	VkPhysicalDeviceVulkan11Properties v11 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES, .pNext = &v12 };
	VkPhysicalDeviceProperties2 properties = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &v11 };
	vkGetPhysicalDeviceProperties2(p_device, &properties);
	const VkPhysicalDeviceProperties &core = properties.properties;
	DeviceInfo info;
	info.name = core.deviceName;
	info.driver = fmt::format("{} {}", v12.driverName, v12.driverInfo);
	info.api_version = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(core.apiVersion), VK_API_VERSION_MINOR(core.apiVersion), VK_API_VERSION_PATCH(core.apiVersion));
	info.type = device_type(core.deviceType);
	info.subgroup_size = v11.subgroupSize;
	info.timestamps = p_timestamp_bits != 0 && core.limits.timestampPeriod > 0.0f;
	info.depth_clamp = p_features.core.features.depthClamp;
	// llvmpipe visits every texel in the box of a pixel's footprint: near a horizon, and in the lanes outside a triangle, that is the
	// whole texture or far more, and a frame takes minutes.
	const bool anisotropic = p_features.core.features.samplerAnisotropy && v12.driverID != VK_DRIVER_ID_MESA_LLVMPIPE;
	info.max_anisotropy = anisotropic ? core.limits.maxSamplerAnisotropy : 1.0f;
	info.max_texture_2d_texels = core.limits.maxImageDimension2D;
	info.max_storage_buffer_bytes = core.limits.maxStorageBufferRange;
	info.optional_features = p_features.optional_names();
	if (info.timestamps) {
		info.optional_features.push_back("timestamps");
	}
	return info;
}

std::string lower(std::string p_text) {
	std::transform(p_text.begin(), p_text.end(), p_text.begin(), [](unsigned char p_char) { return char(std::tolower(p_char)); });
	return p_text;
}

bool is_index(const std::string &p_text) {
	return !p_text.empty() && p_text.size() < 6 && std::all_of(p_text.begin(), p_text.end(), [](unsigned char p_char) { return std::isdigit(p_char); });
}

} // namespace

VulkanContext::~VulkanContext() {
	if (device != VK_NULL_HANDLE) {
		vkDestroyDevice(device, nullptr);
	}
	if (messenger != VK_NULL_HANDLE) {
		vkDestroyDebugUtilsMessengerEXT(instance, messenger, nullptr);
	}
	if (instance != VK_NULL_HANDLE) {
		vkDestroyInstance(instance, nullptr);
	}
}

Status VulkanContext::create_instance(bool p_validation) {
	if (volkInitialize() != VK_SUCCESS) {
		return make_error("no Vulkan loader (libvulkan.so.1): {}", NO_DEVICE_HELP);
	}
	if (volkGetInstanceVersion() < VK_API_VERSION_1_3) {
		return make_error("the Vulkan loader is older than 1.3: update libvulkan1");
	}
	debug_utils = has_instance_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
	std::vector<const char *> extensions, layers;
	if (debug_utils || p_validation) {
		extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME); // the validation layer has it too
	}
	VkDebugUtilsMessengerCreateInfoEXT messages = messenger_info(&validation);
	const VkValidationFeatureEnableEXT enabled[] = { VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT };
	const VkValidationFeaturesEXT validation_features = {
		.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
		.pNext = &messages,
		.enabledValidationFeatureCount = uint32_t(std::size(enabled)),
		.pEnabledValidationFeatures = enabled,
	};
	if (p_validation) {
		if (!has_layer(VALIDATION_LAYER)) {
			return make_error("{} is not installed; on Debian: apt-get install vulkan-validationlayers", VALIDATION_LAYER);
		}
		const char *abort_setting = std::getenv("LUCENT_VALIDATION_ABORT");
		validation.abort_at_first = abort_setting != nullptr && std::strcmp(abort_setting, "1") == 0;
		layers.push_back(VALIDATION_LAYER);
		extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
		debug_utils = true;
	}
	const VkApplicationInfo application = {
		.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
		.pApplicationName = "lucent",
		.pEngineName = "lucent",
		.apiVersion = VK_API_VERSION_1_3,
	};
	const VkInstanceCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
		.pNext = p_validation ? &validation_features : nullptr,
		.pApplicationInfo = &application,
		.enabledLayerCount = uint32_t(layers.size()),
		.ppEnabledLayerNames = layers.data(),
		.enabledExtensionCount = uint32_t(extensions.size()),
		.ppEnabledExtensionNames = extensions.data(),
	};
	const VkResult result = vkCreateInstance(&create_info, nullptr, &instance);
	if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
		return make_error("no Vulkan driver: {}", NO_DEVICE_HELP);
	}
	if (result != VK_SUCCESS) {
		return make_error("no Vulkan instance: {}", result_name(result));
	}
	volkLoadInstance(instance);
	if (p_validation) {
		VK_CHECK(vkCreateDebugUtilsMessengerEXT(instance, &messages, nullptr, &messenger));
	}
	return Ok();
}

Result<std::vector<VulkanContext::Candidate>> VulkanContext::candidates() {
	uint32_t count = 0;
	vkEnumeratePhysicalDevices(instance, &count, nullptr);
	std::vector<VkPhysicalDevice> devices(count);
	vkEnumeratePhysicalDevices(instance, &count, devices.data());
	std::vector<Candidate> usable;
	std::string refused;
	for (VkPhysicalDevice physical : devices) {
		VkPhysicalDeviceProperties device_properties;
		vkGetPhysicalDeviceProperties(physical, &device_properties);
		if (device_properties.apiVersion < VK_API_VERSION_1_3) {
			refused += fmt::format("; '{}' is older than Vulkan 1.3", device_properties.deviceName);
			continue;
		}
		VulkanFeatures device_features;
		device_features.query(physical);
		if (const std::string missing = device_features.missing(); !missing.empty()) {
			refused += fmt::format("; '{}' lacks {}", device_properties.deviceName, missing);
			continue;
		}
		uint32_t family_count = 0;
		vkGetPhysicalDeviceQueueFamilyProperties(physical, &family_count, nullptr);
		std::vector<VkQueueFamilyProperties> families(family_count);
		vkGetPhysicalDeviceQueueFamilyProperties(physical, &family_count, families.data());
		constexpr VkQueueFlags WANTED = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
		const auto family = std::find_if(families.begin(), families.end(), [](const VkQueueFamilyProperties &p_family) { return (p_family.queueFlags & WANTED) == WANTED; });
		if (family == families.end()) {
			refused += fmt::format("; '{}' has no queue for graphics and compute", device_properties.deviceName);
			continue;
		}
		usable.push_back({ physical, uint32_t(family - families.begin()), family->timestampValidBits, describe(physical, device_features, family->timestampValidBits) });
	}
	if (usable.empty()) {
		return make_error("no usable Vulkan device{}: {}", refused, NO_DEVICE_HELP);
	}
	std::stable_sort(usable.begin(), usable.end(), [](const Candidate &a, const Candidate &b) { return a.info.type < b.info.type; });
	return usable;
}

Result<std::vector<DeviceInfo>> VulkanContext::list_devices() {
	Result<std::vector<Candidate>> found = candidates();
	if (!found) {
		return found.error();
	}
	std::vector<DeviceInfo> infos;
	for (const Candidate &candidate : found.value()) {
		infos.push_back(candidate.info);
	}
	return infos;
}

Status VulkanContext::create_device(const std::string &p_filter) {
	Result<std::vector<Candidate>> found = candidates();
	if (!found) {
		return found.error();
	}
	const std::vector<Candidate> &list = found.value();
	size_t chosen = 0;
	if (is_index(p_filter)) {
		chosen = size_t(std::stoul(p_filter));
	} else if (!p_filter.empty()) {
		chosen = size_t(std::find_if(list.begin(), list.end(), [&](const Candidate &p_candidate) { return lower(p_candidate.info.name).find(lower(p_filter)) != std::string::npos; }) - list.begin());
	}
	if (chosen >= list.size()) {
		std::string names;
		for (size_t i = 0; i < list.size(); i++) {
			names += fmt::format("{}{}: {}", i == 0 ? "" : ", ", i, list[i].info.name);
		}
		return make_error("no Vulkan device '{}'; there are {}", p_filter, names);
	}
	const Candidate &candidate = list[chosen];
	physical_device = candidate.device;
	queue_family = candidate.queue_family;
	timestamp_bits = candidate.timestamp_bits;
	info = candidate.info;
	vkGetPhysicalDeviceProperties(physical_device, &properties);
	vkGetPhysicalDeviceMemoryProperties(physical_device, &memory_properties);
	VulkanFeatures enabled;
	enabled.query(physical_device);
	enabled.keep_wanted();
	features = enabled.core.features;
	const float priority = 1.0f;
	const VkDeviceQueueCreateInfo queue_info = {
		.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
		.queueFamilyIndex = queue_family,
		.queueCount = 1,
		.pQueuePriorities = &priority,
	};
	const VkDeviceCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
		.pNext = &enabled.core,
		.queueCreateInfoCount = 1,
		.pQueueCreateInfos = &queue_info,
	};
	if (const VkResult result = vkCreateDevice(physical_device, &create_info, nullptr, &device); result != VK_SUCCESS) {
		return make_error("'{}' can't be opened: {}", info.name, result_name(result));
	}
	vkGetDeviceQueue(device, queue_family, 0, &queue);
	return Ok();
}

void VulkanContext::set_name(VkObjectType p_type, uint64_t p_object, const std::string &p_name) const {
	if (!debug_utils || vkSetDebugUtilsObjectNameEXT == nullptr) {
		return;
	}
	const VkDebugUtilsObjectNameInfoEXT name_info = {
		.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
		.objectType = p_type,
		.objectHandle = p_object,
		.pObjectName = p_name.c_str(),
	};
	vkSetDebugUtilsObjectNameEXT(device, &name_info);
}

} // namespace lucent
