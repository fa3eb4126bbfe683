// SPDX-License-Identifier: MIT
#include "modules/reference/image_filter.h"

#include <algorithm>

namespace lucent {

Plane filter_separable(const Plane &p_plane, const std::vector<float> &p_kernel_x, const std::vector<float> &p_kernel_y) {
	const int width = int(p_plane.width), height = int(p_plane.height);
	const int radius_x = int(p_kernel_x.size()) / 2, radius_y = int(p_kernel_y.size()) / 2;
	Plane rows(p_plane.width, p_plane.height);
	for (int y = 0; y < height; y++) {
		const float *source = p_plane.values.data() + size_t(y) * p_plane.width;
		for (int x = 0; x < width; x++) {
			float sum = 0;
			for (int i = -radius_x; i <= radius_x; i++) {
				sum += p_kernel_x[size_t(i + radius_x)] * source[std::clamp(x + i, 0, width - 1)];
			}
			rows.at(uint32_t(x), uint32_t(y)) = sum;
		}
	}
	Plane result(p_plane.width, p_plane.height);
	for (int y = 0; y < height; y++) {
		for (int i = -radius_y; i <= radius_y; i++) {
			const float weight = p_kernel_y[size_t(i + radius_y)];
			const float *source = rows.values.data() + size_t(std::clamp(y + i, 0, height - 1)) * p_plane.width;
			float *target = result.values.data() + size_t(y) * p_plane.width;
			for (int x = 0; x < width; x++) {
				target[x] += weight * source[x];
			}
		}
	}
	return result;
}

} // namespace lucent
