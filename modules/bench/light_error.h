// SPDX-License-Identifier: MIT
#pragma once
// How far indirect light is from the truth, over the blocks of the truth that are seen well enough.

#include "modules/bench/mottle.h"

namespace lucent {

// Below this mean no light can get there: whatever is there has leaked, and errors relative to the truth have no meaning.
inline constexpr double SEALED_MEAN = 1e-4;

// The intervals (*interval: half of the width) hold 95 times in 100 over the truth's noise. Errors are without that noise: squares are
// means of (x - t1)(x - t2) over the truth's two halves.
struct ErrorFigure {
	double nrmse = 0; // root mean square error / mean of the truth
	double interval = 0;
	double noise = 0; // what a perfect picture would score if the truth's noise were left in. A bar below three times this can't be judged
};

struct LightError {
	uint64_t block_count = 0;
	bool sealed = false; // the truth is black: only leak counts
	double truth_mean = 0;
	double mean = 0;
	ErrorFigure blocks; // of blocks of pixels
	ErrorFigure pixels; // of single pixels; not of sealed scenes
	double flat = 0; // the nrmse of blocks of light that is constant, of the right mean
	double energy = 0; // mean / mean of the truth
	double energy_interval = 0;
	double relmse = 0; // mean((a - t1)(a - t2) / (t^2 + (0.05 s)^2)), s: 95th percentile of the truth's block means
	double log_correlation = 0; // of log luminance: shape, whatever the exposure
	MottleError mottle; // not of sealed scenes
	LeakMetrics leak; // over single pixels; sealed only
};

// Fails where sizes differ, a value is not finite or no block counts. p_light: the indirect light of the picture under test.
Result<LightError> measure_light_error(const MetricImage &p_light, const TruthImage &p_truth);

} // namespace lucent
