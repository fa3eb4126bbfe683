// SPDX-License-Identifier: MIT
#include "modules/bench/mottle.h"

#include "modules/bench/light_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lucent {

namespace {

constexpr double NORMAL_95 = 1.96;
constexpr uint32_t SIDE = MOTTLE_WINDOW_BLOCKS;
constexpr uint32_t COUNT = SIDE * SIDE;
using Window = std::array<double, COUNT>; // rows of SIDE

// Less its least-squares plane. On a grid the three terms are orthogonal.
Window plane_residual(const Window &p_values) {
	double mean = 0, slope_x = 0, slope_y = 0, square = 0;
	const auto offset = [](uint32_t p_index) { return double(p_index) - 0.5 * (SIDE - 1); };
	for (uint32_t i = 0; i < COUNT; i++) {
		mean += p_values[i] / COUNT;
		slope_x += p_values[i] * offset(i % SIDE);
		slope_y += p_values[i] * offset(i / SIDE);
		square += offset(i % SIDE) * offset(i % SIDE);
	}
	Window residual;
	for (uint32_t i = 0; i < COUNT; i++) {
		residual[i] = p_values[i] - mean - (slope_x * offset(i % SIDE) + slope_y * offset(i / SIDE)) / square;
	}
	return residual;
}

Window centered(const Window &p_values) {
	double mean = 0;
	for (const double value : p_values) {
		mean += value / COUNT;
	}
	Window result = p_values;
	for (double &value : result) {
		value -= mean;
	}
	return result;
}

// The noise of both is independent, so that it falls out.
double mean_product(const Window &p_a, const Window &p_b) {
	double sum = 0;
	for (uint32_t i = 0; i < COUNT; i++) {
		sum += p_a[i] * p_b[i] / COUNT;
	}
	return sum;
}

double log2_ratio(double p_light, double p_truth) {
	return p_light > 0.0 ? std::clamp(std::log2(p_light / p_truth), -MOTTLE_LIMIT, MOTTLE_LIMIT) : -MOTTLE_LIMIT;
}

class MottleSum {
public:
	MottleSum(const std::vector<LightBlock> &p_blocks, uint32_t p_row) :
			blocks(p_blocks), row(p_row), weights(p_blocks.size()) {
		double mean = 0, count = 0;
		for (const LightBlock &block : blocks) {
			mean += mean_of(block.truth);
			count += block.seen ? 1.0 : 0.0;
		}
		darkest = MOTTLE_DARKEST * mean / std::max(count, 1.0);
	}

	void add(uint32_t p_x, uint32_t p_y) {
		std::array<Window, 2> truth, ratio;
		for (uint32_t i = 0; i < COUNT; i++) {
			const LightBlock &block = blocks[index(p_x, p_y, i)];
			for (uint32_t half = 0; half < 2; half++) {
				const double value = mean_of(block.halves[half]);
				if (!block.seen || !(value > darkest)) {
					return;
				}
				truth[half][i] = std::log2(value);
				ratio[half][i] = log2_ratio(mean_of(block.light), value);
			}
		}
		if (mean_product(plane_residual(truth[0]), plane_residual(truth[1])) > MOTTLE_SMOOTH * MOTTLE_SMOOTH) {
			return;
		}
		add_window(p_x, p_y, { centered(ratio[0]), centered(ratio[1]) });
	}

	MottleError result() const {
		MottleError error = { .windows = windows };
		if (windows == 0) {
			return error;
		}
		double square_variance = 0;
		for (size_t i = 0; i < weights.size(); i++) {
			const double difference = weights[i] != 0.0 ? std::log2(mean_of(blocks[i].halves[0]) / mean_of(blocks[i].halves[1])) : 0.0;
			square_variance += std::pow(weights[i] / windows * difference, 2.0);
		}
		error.mottle = std::sqrt(std::max(square / windows, 0.0));
		error.interval = root_interval(square / windows, NORMAL_95 * std::sqrt(square_variance));
		error.noise = std::sqrt(noise / windows);
		error.worst = std::sqrt(worst);
		return error;
	}

private:
	size_t index(uint32_t p_x, uint32_t p_y, uint32_t p_i) const { return size_t(p_y + p_i / SIDE) * row + p_x + p_i % SIDE; }

	void add_window(uint32_t p_x, uint32_t p_y, const std::array<Window, 2> &p_ratio) {
		const double variance = mean_product(p_ratio[0], p_ratio[1]);
		Window difference;
		for (uint32_t i = 0; i < COUNT; i++) {
			difference[i] = 0.5 * (p_ratio[0][i] - p_ratio[1][i]);
			weights[index(p_x, p_y, i)] += 0.5 * (p_ratio[0][i] + p_ratio[1][i]) / COUNT;
		}
		windows++;
		square += variance;
		noise += mean_product(difference, difference);
		worst = std::max(worst, variance);
	}

	const std::vector<LightBlock> &blocks;
	uint32_t row;
	// By block: how much `square` changes with the log2 of one half's value there, noise of second order left out.
	std::vector<double> weights;
	double darkest = 0;
	uint32_t windows = 0;
	double square = 0; // sums over windows
	double noise = 0;
	double worst = 0;
};

} // namespace

MottleError measure_mottle(const MetricImage &p_light, const TruthImage &p_truth) {
	const uint32_t width = p_truth.width / p_truth.block_pixels;
	const uint32_t height = p_truth.height / p_truth.block_pixels;
	const std::vector<LightBlock> blocks = light_blocks(p_light, p_truth);
	MottleSum sum(blocks, width);
	for (uint32_t y = 0; y + SIDE <= height; y += MOTTLE_STEP_BLOCKS) {
		for (uint32_t x = 0; x + SIDE <= width; x += MOTTLE_STEP_BLOCKS) {
			sum.add(x, y);
		}
	}
	return sum.result();
}

} // namespace lucent
