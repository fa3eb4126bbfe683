// SPDX-License-Identifier: MIT
#include "modules/bench/light_error.h"

#include "modules/bench/statistics.h"
#include "servers/core/math_types.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr double NORMAL_95 = 1.96;
constexpr double SEEN_SHARE = 0.9; // of a block's pixels

struct Block {
	glm::dvec3 light{ 0.0 };
	glm::dvec3 truth{ 0.0 };
	glm::dvec3 albedo{ 0.0 };
	glm::dvec3 deviation{ 0.0 }; // of truth, one standard deviation
};

glm::dvec3 rgb(const std::vector<float> &p_values, size_t p_pixel) {
	return { p_values[3 * p_pixel], p_values[3 * p_pixel + 1], p_values[3 * p_pixel + 2] };
}

double mean_of(const glm::dvec3 &p_value) {
	return (p_value.x + p_value.y + p_value.z) / 3.0;
}

std::vector<Block> seen_blocks(const MetricImage &p_light, const TruthImage &p_truth) {
	std::vector<Block> blocks;
	const uint32_t side = p_truth.block_pixels;
	for (uint32_t y0 = 0; y0 + side <= p_truth.height; y0 += side) {
		for (uint32_t x0 = 0; x0 + side <= p_truth.width; x0 += side) {
			Block block;
			double count = 0;
			for (uint32_t i = 0; i < side * side; i++) {
				const size_t pixel = size_t(y0 + i / side) * p_truth.width + x0 + i % side;
				if (p_truth.mask[pixel] == 0) {
					continue;
				}
				block.light += rgb(p_light.values, pixel);
				block.truth += rgb(p_truth.indirect, pixel);
				block.albedo += rgb(p_truth.albedo, pixel);
				block.deviation = glm::sqrt(rgb(p_truth.variance, pixel));
				count++;
			}
			if (count >= SEEN_SHARE * side * side) {
				block.light /= count;
				block.truth /= count;
				block.albedo /= count;
				blocks.push_back(block);
			}
		}
	}
	return blocks;
}

// Channels of a block share their paths: their errors count as fully correlated, those of different blocks as independent.
void add_errors(const std::vector<Block> &p_blocks, LightError &r_error) {
	const double count = double(p_blocks.size());
	double square = 0, square_variance = 0, mean_variance = 0, noise = 0, albedo = 0, flat = 0;
	for (const Block &block : p_blocks) {
		const glm::dvec3 difference = block.light - block.truth;
		square += glm::dot(difference, difference) / 3.0;
		noise += glm::dot(block.deviation, block.deviation) / 3.0;
		square_variance += std::pow(2.0 * glm::dot(glm::abs(difference), block.deviation) / 3.0, 2.0);
		mean_variance += std::pow(mean_of(block.deviation), 2.0);
		r_error.truth_mean += mean_of(block.truth) / count;
		r_error.mean += mean_of(block.light) / count;
		albedo += mean_of(block.albedo) / count;
	}
	for (const Block &block : p_blocks) {
		const glm::dvec3 difference = block.albedo * (r_error.truth_mean / std::max(albedo, 1e-9)) - block.truth;
		flat += glm::dot(difference, difference) / 3.0;
	}
	const double scale = std::max(r_error.truth_mean, 1e-9);
	const double rmse = std::sqrt(square / count);
	const double mean_interval = NORMAL_95 * std::sqrt(mean_variance) / count / scale; // relative
	const double rmse_interval = rmse > 0.0 ? NORMAL_95 * std::sqrt(square_variance) / count / (2.0 * rmse * scale) : 0.0;
	r_error.nrmse = rmse / scale;
	r_error.nrmse_interval = std::hypot(rmse_interval, r_error.nrmse * mean_interval);
	r_error.noise = std::sqrt(noise / count) / scale;
	r_error.flat = std::sqrt(flat / count) / scale;
	r_error.energy = r_error.mean / scale;
	r_error.energy_interval = r_error.energy * mean_interval;
}

void add_relative_errors(const std::vector<Block> &p_blocks, LightError &r_error) {
	std::vector<double> means;
	for (const Block &block : p_blocks) {
		means.push_back(mean_of(block.truth));
	}
	const double bright = percentile(means, 0.95);
	const double epsilon = 0.05 * bright;
	const double floor = std::max(1e-4 * bright, 1e-30);
	double relative = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
	for (const Block &block : p_blocks) {
		for (int c = 0; c < 3; c++) {
			const double difference = block.light[c] - block.truth[c];
			relative += difference * difference / std::max(block.truth[c] * block.truth[c] + epsilon * epsilon, 1e-30);
		}
		const double light = std::log(std::max(mean_of(block.light), floor));
		const double truth = std::log(std::max(mean_of(block.truth), floor));
		a += light;
		b += truth;
		aa += light * light;
		bb += truth * truth;
		ab += light * truth;
	}
	const double count = double(p_blocks.size());
	const double spread = (aa - a * a / count) * (bb - b * b / count);
	r_error.relmse = relative / (3.0 * count);
	r_error.log_correlation = spread > 0.0 ? (ab - a * b / count) / std::sqrt(spread) : 0.0;
}

} // namespace

Result<LightError> measure_light_error(const MetricImage &p_light, const TruthImage &p_truth) {
	if (p_light.width != p_truth.width || p_light.height != p_truth.height) {
		return make_error("the picture is {}x{}, its truth {}x{}", p_light.width, p_light.height, p_truth.width, p_truth.height);
	}
	for (size_t i = 0; i < p_light.values.size(); i++) {
		if (!std::isfinite(p_light.values[i])) {
			return make_error("pixel {},{} of the picture is not finite", i / 3 % p_light.width, i / 3 / p_light.width);
		}
	}
	const std::vector<Block> blocks = seen_blocks(p_light, p_truth);
	if (blocks.empty()) {
		return make_error("no block of the truth counts");
	}
	LightError error;
	error.blocks = blocks.size();
	add_errors(blocks, error);
	error.sealed = error.truth_mean < SEALED_MEAN;
	if (!error.sealed) {
		add_relative_errors(blocks, error);
		return error;
	}
	MetricImage magnitude = p_light;
	for (float &value : magnitude.values) {
		value = std::abs(value);
	}
	const Result<LeakMetrics> leak = measure_leak(magnitude, p_truth.mask);
	if (!leak) {
		return leak.error();
	}
	error.leak = leak.value();
	return error;
}

} // namespace lucent
