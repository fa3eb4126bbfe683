// SPDX-License-Identifier: MIT
#pragma once
// Blotches: how much the ratio of a picture to the truth varies where the truth itself is smooth, which is where a person sees them.

#include "modules/bench/truth_image.h"

namespace lucent {

inline constexpr uint32_t MOTTLE_WINDOW_BLOCKS = 8; // a side: 32 pixels at the truth's size
inline constexpr uint32_t MOTTLE_STEP_BLOCKS = 4; // between windows, which overlap
// A window is smooth where log2 of its truth departs from its own plane (least squares) by at most this, root mean square; noise taken out. 0.1 is 7 %.
inline constexpr double MOTTLE_SMOOTH = 0.1;
// log2(ours / truth) is clamped to this on both sides: what is black counts as six stops too dark.
inline constexpr double MOTTLE_LIMIT = 6.0;
// Windows with a block below this share of the truth's mean don't count: a ratio to nearly nothing says nothing.
inline constexpr double MOTTLE_DARKEST = 1e-3;

struct MottleError {
	uint32_t windows = 0; // smooth ones; 0: nothing is known
	double mottle = 0; // root mean square over them of the standard deviation of log2(ours / truth) in each, the truth's noise taken out
	double interval = 0; // half of the width of the 95 % interval over the truth's noise
	double noise = 0; // what a perfect picture would score if the truth's noise were left in
	double worst = 0; // of one window
};

// Blocks are p_truth's; a window counts where all of its blocks are seen (light_error.h). Sizes must be equal, values finite.
MottleError measure_mottle(const MetricImage &p_light, const TruthImage &p_truth);

} // namespace lucent
