// SPDX-License-Identifier: MIT
#include "modules/bench/statistics.h"

#include <algorithm>
#include <cmath>

namespace lucent {

double percentile(std::vector<double> p_values, double p_share) {
	if (p_values.empty()) {
		return 0.0;
	}
	std::sort(p_values.begin(), p_values.end());
	const double place = std::clamp(p_share, 0.0, 1.0) * double(p_values.size() - 1);
	const size_t below = size_t(place);
	const size_t above = std::min(below + 1, p_values.size() - 1);
	return p_values[below] + (place - double(below)) * (p_values[above] - p_values[below]);
}

Distribution distribution_of(const std::vector<double> &p_values) {
	return { p_values.size(), percentile(p_values, 0.5), percentile(p_values, 0.95), percentile(p_values, 0.99), percentile(p_values, 1.0) };
}

Response response_of(double p_before, const std::vector<double> &p_values) {
	Response response = { .before = p_before, .after = p_values.back() };
	const double change = response.after - p_before;
	if (change == 0.0) {
		return response;
	}
	// Reached is within the rest of the change on either side, so that an overshoot counts as not yet there.
	const auto frames_to = [&](double p_share) {
		uint32_t frame = uint32_t(p_values.size());
		while (frame > 1 && std::abs(p_values[frame - 2] - response.after) <= (1.0 - p_share) * std::abs(change)) {
			frame--;
		}
		return frame;
	};
	response.frames_50 = frames_to(0.5);
	response.frames_90 = frames_to(0.9);
	response.frames_99 = frames_to(0.99);
	for (const double value : p_values) {
		response.overshoot = std::max(response.overshoot, (value - response.after) / change);
	}
	return response;
}

} // namespace lucent
