// SPDX-License-Identifier: MIT
#pragma once
// What a driver must do. Drivers know no rendering words, derive no barriers and call nothing above them.
// The device layer's owner fills in this interface; see drivers/vulkan and drivers/null.

#include "servers/rendering/device/resource_types.h"

#include <string>
#include <vector>

namespace lucent {

enum class DeviceType : uint8_t { DISCRETE, INTEGRATED, VIRTUAL, CPU, OTHER };

struct DeviceInfo {
	std::string name;
	std::string driver; // name and version
	std::string api_version;
	DeviceType type = DeviceType::OTHER;
	uint32_t subgroup_size = 1;
	bool timestamps = false;
	bool depth_clamp = false;
	float max_anisotropy = 1.0f;
	uint32_t max_texture_2d_texels = 4096; // per axis
	uint64_t max_storage_buffer_bytes = 1u << 27;
	std::vector<std::string> optional_features; // what `lucent info` lists
};

class RenderingDeviceDriver {
public:
	virtual ~RenderingDeviceDriver() = default;
	virtual const DeviceInfo &info() const = 0;
};

} // namespace lucent
