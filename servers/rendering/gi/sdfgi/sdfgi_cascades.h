// SPDX-License-Identifier: MIT
#pragma once
// Where the cascades stand. Pure arithmetic, no device.

#include "servers/core/math_types.h"

#include <cstdint>

namespace lucent {

// The lowest cell of a cascade of p_grid_size cells an axis of p_cell_m that surrounds p_camera_m: a multiple of p_step_cells (the
// probe spacing), and kept while the camera stays within one step of the old centre, so that standing at a border doesn't toggle it.
Vector3i cascade_origin_cells(const Vector3 &p_camera_m, const Vector3 &p_cell_m, uint32_t p_grid_size, uint32_t p_step_cells, const Vector3i *p_old_origin_cells);

} // namespace lucent
