// SPDX-License-Identifier: MIT
#pragma once
// Where the cascades stand. Pure arithmetic, no device.

#include "servers/core/math_types.h"

#include <cstdint>

namespace lucent {

// The lowest cell of a cascade of p_grid_size cells an axis of p_cell_m that surrounds p_camera_m: a multiple of p_step_cells (the
// probe spacing), and kept while the camera stays within one step of the old centre, so that standing at a border doesn't toggle it.
Vector3i cascade_origin_cells(const Vector3 &p_camera_m, const Vector3 &p_cell_m, uint32_t p_grid_size, uint32_t p_step_cells, const Vector3i *p_old_origin_cells);

// One set of gather rays.
struct LightEpoch {
	uint32_t index = 0;
	uint32_t frames = 1; // that it takes
	uint32_t turn = 0; // of them, done before
};

// The set that a frame (since the light was reset) belongs to. Light travels one bounce a set, so the first sets are short: four
// of one frame, two of two, then one of each power of two below p_full_frames, itself a power of two.
LightEpoch light_epoch(uint32_t p_frame, uint32_t p_full_frames);

} // namespace lucent
