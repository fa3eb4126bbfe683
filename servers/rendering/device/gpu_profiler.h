// SPDX-License-Identifier: MIT
#pragma once
// GPU milliseconds per pass: one timestamp at the frame's start and one after each pass, so the passes' times add up to the frame's.

#include "servers/rendering/device/rendering_device_driver.h"

#include <array>

namespace lucent {

struct PassTiming {
	std::string name;
	double gpu_ms = 0.0;
};

class GpuProfiler {
public:
	explicit GpuProfiler(RenderingDeviceDriver &p_driver) :
			driver(p_driver) {}
	void begin_frame(uint32_t p_slot);
	void end_pass(uint32_t p_slot, const std::string &p_name);
	// The slot's commands have finished.
	void collect(uint32_t p_slot);
	const std::vector<PassTiming> &timings() const { return finished; }

private:
	RenderingDeviceDriver &driver;
	struct Frame {
		bool open = false; // has timestamps that were not collected
		std::vector<std::string> names;
	};
	std::array<Frame, RenderingDeviceDriver::SLOT_COUNT> frames;
	std::vector<PassTiming> finished;
	std::vector<double> scratch_ms;
};

} // namespace lucent
