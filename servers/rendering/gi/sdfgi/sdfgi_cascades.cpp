// SPDX-License-Identifier: MIT
#include "servers/rendering/gi/sdfgi/sdfgi_cascades.h"

#include <algorithm>

namespace lucent {

Vector3i cascade_origin_cells(const Vector3 &p_camera_m, const Vector3 &p_cell_m, uint32_t p_grid_size, uint32_t p_step_cells, const Vector3i *p_old_origin_cells) {
	Vector3i origin;
	for (int axis = 0; axis < 3; axis++) {
		const float camera_steps = p_camera_m[axis] / p_cell_m[axis] / float(p_step_cells);
		const int half_steps = int(p_grid_size / p_step_cells / 2);
		int center_steps = int(std::floor(camera_steps + 0.5f));
		if (p_old_origin_cells != nullptr) {
			const int old_center_steps = (*p_old_origin_cells)[axis] / int(p_step_cells) + half_steps;
			if (std::abs(camera_steps - float(old_center_steps)) < 1.0f) {
				center_steps = old_center_steps;
			}
		}
		origin[axis] = (center_steps - half_steps) * int(p_step_cells);
	}
	return origin;
}

} // namespace lucent
