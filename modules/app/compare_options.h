// SPDX-License-Identifier: MIT
#pragma once
// The command line of `lucent compare`, checked.

#include "servers/core/error.h"

#include <string>
#include <vector>

namespace lucent {

// A bound for --threshold. Errors are bounded from above, ssim from below, energy by its distance from 1.
struct MetricBound {
	std::string metric;
	double value = 0;
};

struct CompareOptions {
	std::string image_a;
	std::string image_b;
	std::string layer_a; // "": the picture itself; else layers joined by + and -
	std::string layer_b;
	std::vector<std::string> masks;
	std::vector<std::string> leak_masks;
	std::vector<MetricBound> bounds;
	std::string difference; // .png
	float exposure = 1.0f;
	bool json = false;
	bool exit = false; // --help was printed
};

inline constexpr const char *METRIC_NAMES[] = { "rmse", "nrmse", "relmse", "energy", "over_lit", "under_lit", "max_error", "ssim", "flip", "flip_p99" };
inline constexpr const char *LEAK_METRIC_NAMES[] = { "leak_mean", "leak_p999", "leak_max" };

Result<CompareOptions> parse_compare_options(const std::vector<std::string> &p_args);

} // namespace lucent
