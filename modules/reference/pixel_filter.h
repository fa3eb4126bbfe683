// SPDX-License-Identifier: MIT
#pragma once
// Positions around a pixel's centre, distributed as a filter weighs them.

#include "modules/reference/path_tracer.h"

#include <vector>

namespace lucent {

class PixelFilterSampler {
public:
	explicit PixelFilterSampler(PixelFilter p_filter);
	// In pixels from the centre, for a random number in [0, 1). The filters are separable: once for each direction.
	float sample(float p_random) const {
		if (offsets.empty()) {
			return p_random - 0.5f;
		}
		const float position = p_random * float(INTERVALS);
		const uint32_t i = uint32_t(position);
		return offsets[i] + (offsets[i + 1] - offsets[i]) * (position - float(i));
	}

private:
	static constexpr uint32_t INTERVALS = 4096;
	std::vector<float> offsets; // the inverse of the filter's distribution function at i / INTERVALS; empty: box
};

} // namespace lucent
