// SPDX-License-Identifier: MIT
#include "modules/bench/light_error.h"

#include "modules/bench/light_blocks.h"
#include "modules/bench/statistics.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr double NORMAL_95 = 1.96;
std::vector<LightBlock> seen_blocks(const MetricImage &p_light, const TruthImage &p_truth) {
	std::vector<LightBlock> blocks = light_blocks(p_light, p_truth);
	std::erase_if(blocks, [](const LightBlock &p_block) { return !p_block.seen; });
	return blocks;
}

// Error of pixels or blocks that their truth's noise is taken out of: the mean of (x - t1)(x - t2), with t1 and t2 independent and right in the mean.
// With d = x - (t1 + t2) / 2 and V the variance of (t1 + t2) / 2, one product has the variance 4 d^2 V.
class SquareError {
public:
	// Channels share their paths: their errors count as fully correlated, those of different places as independent.
	void add(const glm::dvec3 &p_light, const glm::dvec3 &p_half1, const glm::dvec3 &p_half2, const glm::dvec3 &p_deviation) {
		const glm::dvec3 difference = p_light - 0.5 * (p_half1 + p_half2);
		square += glm::dot(p_light - p_half1, p_light - p_half2) / 3.0;
		square_variance += std::pow(2.0 * glm::dot(glm::abs(difference), p_deviation) / 3.0, 2.0);
		mean_variance += std::pow(mean_of(p_deviation), 2.0);
		noise += glm::dot(p_deviation, p_deviation) / 3.0;
		truth += 0.5 * mean_of(p_half1 + p_half2);
		count++;
	}

	ErrorFigure figure() const {
		const double scale = std::max(truth / count, 1e-9);
		const double mean_interval = NORMAL_95 * std::sqrt(mean_variance) / count / scale; // relative
		const double rmse = std::sqrt(std::max(square / count, 0.0)) / scale;
		const double interval = root_interval(square / count, NORMAL_95 * std::sqrt(square_variance) / count) / scale;
		return { rmse, std::hypot(interval, rmse * mean_interval), std::sqrt(noise / count) / scale };
	}
	double relative_mean_interval() const { return NORMAL_95 * std::sqrt(mean_variance) / std::max(truth, 1e-9 * count); }

private:
	double count = 0;
	double square = 0, square_variance = 0, mean_variance = 0, noise = 0, truth = 0; // sums
};

void add_pixel_errors(const MetricImage &p_light, const TruthImage &p_truth, LightError &r_error) {
	SquareError sum;
	for (size_t i = 0; i < p_truth.pixel_count(); i++) {
		if (p_truth.mask[i] == 0) {
			continue;
		}
		const glm::dvec3 half1 = pixel_of(p_truth.halves[0], i), half2 = pixel_of(p_truth.halves[1], i);
		sum.add(pixel_of(p_light.values, i), half1, half2, 0.5 * glm::abs(half1 - half2));
	}
	r_error.pixels = sum.figure();
}

void add_errors(const std::vector<LightBlock> &p_blocks, LightError &r_error) {
	const double count = double(p_blocks.size());
	SquareError sum;
	double albedo = 0, flat = 0;
	for (const LightBlock &block : p_blocks) {
		sum.add(block.light, block.halves[0], block.halves[1], block.deviation);
		r_error.truth_mean += mean_of(block.truth) / count;
		r_error.mean += mean_of(block.light) / count;
		albedo += mean_of(block.albedo) / count;
	}
	for (const LightBlock &block : p_blocks) {
		const glm::dvec3 constant = block.albedo * (r_error.truth_mean / std::max(albedo, 1e-9));
		flat += glm::dot(constant - block.halves[0], constant - block.halves[1]) / 3.0;
	}
	const double scale = std::max(r_error.truth_mean, 1e-9);
	r_error.blocks = sum.figure();
	r_error.flat = std::sqrt(std::max(flat / count, 0.0)) / scale;
	r_error.energy = r_error.mean / scale;
	r_error.energy_interval = r_error.energy * sum.relative_mean_interval();
}

void add_relative_errors(const std::vector<LightBlock> &p_blocks, LightError &r_error) {
	std::vector<double> means;
	for (const LightBlock &block : p_blocks) {
		means.push_back(mean_of(block.truth));
	}
	const double bright = percentile(means, 0.95);
	const double epsilon = 0.05 * bright;
	const double floor = std::max(1e-4 * bright, 1e-30);
	double relative = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
	for (const LightBlock &block : p_blocks) {
		for (int c = 0; c < 3; c++) {
			relative += (block.light[c] - block.halves[0][c]) * (block.light[c] - block.halves[1][c]) / std::max(block.truth[c] * block.truth[c] + epsilon * epsilon, 1e-30);
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
	r_error.relmse = std::max(relative / (3.0 * count), 0.0);
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
	const std::vector<LightBlock> blocks = seen_blocks(p_light, p_truth);
	if (blocks.empty()) {
		return make_error("no block of the truth counts");
	}
	LightError error;
	error.block_count = blocks.size();
	add_errors(blocks, error);
	error.sealed = error.truth_mean < SEALED_MEAN;
	if (!error.sealed) {
		add_relative_errors(blocks, error);
		add_pixel_errors(p_light, p_truth, error);
		error.mottle = measure_mottle(p_light, p_truth);
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
