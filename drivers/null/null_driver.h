// SPDX-License-Identifier: MIT
#pragma once
// A driver without a GPU: every call becomes a line of text. Read-backs are zeros.

#include "servers/rendering/device/rendering_device_driver.h"

#include <memory>

namespace lucent {

class NullDriver : public RenderingDeviceDriver {
public:
	// One call a line, in order: "dispatch 4 1 1". Ids count from 1 for each kind of object.
	virtual const std::vector<std::string> &log() const = 0;
	virtual void clear_log() = 0;
	virtual void set_logging(bool p_enabled) = 0; // on at first
};

std::unique_ptr<NullDriver> create_null_driver();

} // namespace lucent
