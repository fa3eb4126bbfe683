// SPDX-License-Identifier: MIT
#include "modules/reference/image_filter.h"
#include "modules/reference/image_metrics.h"

#include <cmath>

namespace lucent {

std::vector<float> ssim_map(std::span<const float> p_a, std::span<const float> p_b, uint32_t p_width, uint32_t p_height) {
	constexpr int RADIUS = 5;
	constexpr double SIGMA = 1.5;
	constexpr float C1 = 0.01f * 0.01f, C2 = 0.03f * 0.03f;
	std::vector<float> kernel;
	double total = 0;
	for (int i = -RADIUS; i <= RADIUS; i++) {
		kernel.push_back(float(std::exp(-i * i / (2.0 * SIGMA * SIGMA))));
		total += kernel.back();
	}
	for (float &weight : kernel) {
		weight = float(weight / total);
	}
	Plane a(p_width, p_height), b(p_width, p_height), aa(p_width, p_height), bb(p_width, p_height), ab(p_width, p_height);
	for (size_t i = 0; i < a.values.size(); i++) {
		a.values[i] = 0.2126f * p_a[3 * i] + 0.7152f * p_a[3 * i + 1] + 0.0722f * p_a[3 * i + 2];
		b.values[i] = 0.2126f * p_b[3 * i] + 0.7152f * p_b[3 * i + 1] + 0.0722f * p_b[3 * i + 2];
		aa.values[i] = a.values[i] * a.values[i];
		bb.values[i] = b.values[i] * b.values[i];
		ab.values[i] = a.values[i] * b.values[i];
	}
	for (Plane *plane : { &a, &b, &aa, &bb, &ab }) {
		*plane = filter_separable(*plane, kernel, kernel);
	}
	std::vector<float> result(a.values.size());
	for (size_t i = 0; i < result.size(); i++) {
		const float mean_a = a.values[i], mean_b = b.values[i];
		const float variance = std::max(aa.values[i] - mean_a * mean_a, 0.0f) + std::max(bb.values[i] - mean_b * mean_b, 0.0f);
		const float covariance = ab.values[i] - mean_a * mean_b;
		result[i] = (2 * mean_a * mean_b + C1) * (2 * covariance + C2) / ((mean_a * mean_a + mean_b * mean_b + C1) * (variance + C2));
	}
	return result;
}

} // namespace lucent
