// SPDX-License-Identifier: MIT
#include "modules/reference/pixel_filter.h"

#include <cmath>

namespace lucent {

namespace {

constexpr double TURN = 6.283185307179586;
constexpr double BLACKMAN_HARRIS_WIDTH_PIXELS = 1.5;

// The window's integral from 0 to p_t, of all of it: four terms (Harris, Proc. IEEE 66(1) 1978, table 1).
double blackman_harris_share(double p_t) {
	return p_t + (-0.48829 * std::sin(TURN * p_t) + 0.14128 / 2.0 * std::sin(2.0 * TURN * p_t) - 0.01168 / 3.0 * std::sin(3.0 * TURN * p_t)) / (TURN * 0.35875);
}

double blackman_harris_inverse(double p_share) {
	double low = 0, high = 1;
	for (int i = 0; i < 40; i++) {
		const double middle = 0.5 * (low + high);
		(blackman_harris_share(middle) < p_share ? low : high) = middle;
	}
	return 0.5 * (low + high);
}

} // namespace

PixelFilterSampler::PixelFilterSampler(PixelFilter p_filter) {
	for (uint32_t i = 0; p_filter == PixelFilter::BLACKMAN_HARRIS && i <= INTERVALS; i++) {
		offsets.push_back(float((blackman_harris_inverse(double(i) / INTERVALS) - 0.5) * BLACKMAN_HARRIS_WIDTH_PIXELS));
	}
}

} // namespace lucent
