// SPDX-License-Identifier: MIT
#include "servers/rendering/device/gpu_profiler.h"

#include <algorithm>

namespace lucent {

void GpuProfiler::begin_frame(uint32_t p_slot) {
	Frame &frame = frames[p_slot];
	frame.names.clear();
	frame.open = driver.info().timestamps;
	if (frame.open) {
		driver.cmd_timestamp(0);
	}
}

void GpuProfiler::end_pass(uint32_t p_slot, const std::string &p_name) {
	Frame &frame = frames[p_slot];
	if (frame.open && frame.names.size() + 1 < RenderingDeviceDriver::MAX_TIMESTAMPS) {
		frame.names.push_back(p_name);
		driver.cmd_timestamp(uint32_t(frame.names.size()));
	}
}

void GpuProfiler::collect(uint32_t p_slot) {
	Frame &frame = frames[p_slot];
	if (!frame.open) {
		return;
	}
	frame.open = false;
	scratch_ms.resize(frame.names.size() + 1);
	if (!driver.read_timestamps(p_slot, scratch_ms)) {
		return;
	}
	finished.resize(frame.names.size());
	for (size_t i = 0; i < finished.size(); i++) {
		finished[i].name = std::move(frame.names[i]);
		finished[i].gpu_ms = std::max(0.0, scratch_ms[i + 1] - scratch_ms[i]);
	}
}

} // namespace lucent
