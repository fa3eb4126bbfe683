// SPDX-License-Identifier: MIT
#pragma once
// The Vulkan 1.3 driver. Needs dynamic rendering, synchronization2 and scalarBlockLayout; the rest is optional.

#include "servers/core/error.h"
#include "servers/rendering/device/rendering_device_driver.h"

#include <memory>

namespace lucent {

struct VulkanDriverOptions {
	// An index into list_vulkan_devices() or a part of a device's name (any case). Empty: the environment's LUCENT_DEVICE,
	// else the first of discrete, integrated, virtual, CPU.
	std::string device_filter;
	// Core and synchronization validation. Every message is logged as an error and counted. Also by LUCENT_VALIDATION=1;
	// LUCENT_VALIDATION_ABORT=1 aborts at the first one.
	bool validation = false;
};

// Fails where there is no loader, no usable device, or no validation layer though it was asked for; says what to install.
Result<std::unique_ptr<RenderingDeviceDriver>> create_vulkan_driver(const VulkanDriverOptions &p_options);

// The usable devices, best first.
Result<std::vector<DeviceInfo>> list_vulkan_devices();

} // namespace lucent
