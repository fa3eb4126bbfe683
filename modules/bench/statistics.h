// SPDX-License-Identifier: MIT
#pragma once
// Figures of series of measurements.

#include <cstdint>
#include <vector>

namespace lucent {

// Linear between order statistics (the default of NumPy); 0 for none. p_share: 0 to 1.
double percentile(std::vector<double> p_values, double p_share);

struct Distribution {
	uint64_t count = 0;
	double median = 0;
	double p95 = 0;
	double p99 = 0;
	double max = 0;
};
Distribution distribution_of(const std::vector<double> &p_values);

// How a value that starts to change at frame 1 gets to where it stays.
struct Response {
	double before = 0;
	double after = 0; // the last value
	// Frames (the first with the change is 1) from which on at least that share of the change is done and stays done. 0: no change at all
	uint32_t frames_50 = 0;
	uint32_t frames_90 = 0;
	uint32_t frames_99 = 0;
	double overshoot = 0; // largest excess over the change, as a share of the change
};
// p_values: the value after each frame, the first with the change first; not empty.
Response response_of(double p_before, const std::vector<double> &p_values);

} // namespace lucent
