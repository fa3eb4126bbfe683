// SPDX-License-Identifier: MIT
#pragma once
// Separable filters over one plane of floats, for the perceptual metrics.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lucent {

struct Plane {
	uint32_t width = 0;
	uint32_t height = 0;
	std::vector<float> values;

	Plane(uint32_t p_width, uint32_t p_height) :
			width(p_width), height(p_height), values(size_t(p_width) * p_height) {}
	float &at(uint32_t p_x, uint32_t p_y) { return values[size_t(p_y) * width + p_x]; }
};

// p_kernel_x along rows, then p_kernel_y along columns: odd sizes, centred, correlated. The rim repeats the outermost value.
Plane filter_separable(const Plane &p_plane, const std::vector<float> &p_kernel_x, const std::vector<float> &p_kernel_y);

} // namespace lucent
