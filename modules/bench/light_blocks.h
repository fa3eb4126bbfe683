// SPDX-License-Identifier: MIT
#pragma once
// A picture and both halves of its truth, averaged over the truth's blocks.

#include "modules/bench/truth_image.h"
#include "servers/core/math_types.h"

namespace lucent {

inline constexpr double SEEN_SHARE = 0.9; // of a block's pixels that must count, for the block to count

struct LightBlock {
	bool seen = false; // the rest is 0 otherwise
	glm::dvec3 light{ 0.0 };
	glm::dvec3 truth{ 0.0 };
	glm::dvec3 halves[2]{ glm::dvec3(0.0), glm::dvec3(0.0) };
	glm::dvec3 albedo{ 0.0 };
	glm::dvec3 deviation{ 0.0 }; // of truth, one standard deviation
};

inline double mean_of(const glm::dvec3 &p_value) {
	return (p_value.x + p_value.y + p_value.z) / 3.0;
}

inline glm::dvec3 pixel_of(const std::vector<float> &p_values, size_t p_pixel) {
	return { p_values[3 * p_pixel], p_values[3 * p_pixel + 1], p_values[3 * p_pixel + 2] };
}

// width / block_pixels in a row, whole blocks only; rows from the top.
std::vector<LightBlock> light_blocks(const MetricImage &p_light, const TruthImage &p_truth);

// Half of the width of the interval of the root of p_square, which is known within +-p_interval; a square below 0 counts as 0.
double root_interval(double p_square, double p_interval);

} // namespace lucent
