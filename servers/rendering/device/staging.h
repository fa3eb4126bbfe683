// SPDX-License-Identifier: MIT
#pragma once
// Host-visible memory for uploads, recycled when the slot that used it comes round again.

#include "servers/rendering/device/rendering_device_driver.h"

#include <array>

namespace lucent {

struct StagingRange {
	DriverBuffer buffer; // none: out of memory
	uint64_t offset = 0;
	std::byte *data = nullptr;
};

class StagingMemory {
public:
	explicit StagingMemory(RenderingDeviceDriver &p_driver) :
			driver(p_driver) {}
	~StagingMemory();
	StagingMemory(const StagingMemory &) = delete;
	StagingMemory &operator=(const StagingMemory &) = delete;

	StagingRange allocate(uint32_t p_slot, uint64_t p_size_bytes);
	void recycle(uint32_t p_slot); // its commands have finished
	uint64_t in_use_bytes(uint32_t p_slot) const;

private:
	struct Block {
		DriverBuffer buffer;
		uint64_t size = 0;
		uint64_t used = 0;
		std::byte *data = nullptr;
	};
	RenderingDeviceDriver &driver;
	std::array<std::vector<Block>, RenderingDeviceDriver::SLOT_COUNT> blocks;
};

} // namespace lucent
