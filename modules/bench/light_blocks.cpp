// SPDX-License-Identifier: MIT
#include "modules/bench/light_blocks.h"

#include <algorithm>
#include <cmath>

namespace lucent {

static LightBlock light_block(const MetricImage &p_light, const TruthImage &p_truth, uint32_t p_x0, uint32_t p_y0) {
	const uint32_t side = p_truth.block_pixels;
	LightBlock block;
	double count = 0;
	for (uint32_t i = 0; i < side * side; i++) {
		const size_t pixel = size_t(p_y0 + i / side) * p_truth.width + p_x0 + i % side;
		if (p_truth.mask[pixel] == 0) {
			continue;
		}
		block.light += pixel_of(p_light.values, pixel);
		block.halves[0] += pixel_of(p_truth.halves[0], pixel);
		block.halves[1] += pixel_of(p_truth.halves[1], pixel);
		block.albedo += pixel_of(p_truth.albedo, pixel);
		block.deviation = glm::sqrt(pixel_of(p_truth.variance, pixel));
		count++;
	}
	if (count < SEEN_SHARE * side * side) {
		return {};
	}
	block.seen = true;
	for (glm::dvec3 *sum : { &block.light, &block.halves[0], &block.halves[1], &block.albedo }) {
		*sum /= count;
	}
	block.truth = 0.5 * (block.halves[0] + block.halves[1]);
	return block;
}

std::vector<LightBlock> light_blocks(const MetricImage &p_light, const TruthImage &p_truth) {
	const uint32_t side = p_truth.block_pixels;
	std::vector<LightBlock> blocks;
	for (uint32_t y = 0; y + side <= p_truth.height; y += side) {
		for (uint32_t x = 0; x + side <= p_truth.width; x += side) {
			blocks.push_back(light_block(p_light, p_truth, x, y));
		}
	}
	return blocks;
}

double root_interval(double p_square, double p_interval) {
	return 0.5 * (std::sqrt(std::max(p_square + p_interval, 0.0)) - std::sqrt(std::max(p_square - p_interval, 0.0)));
}

} // namespace lucent
