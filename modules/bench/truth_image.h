// SPDX-License-Identifier: MIT
#pragma once
// Path-traced indirect light of a scene, small enough to be kept beside it: an .exr of half floats.

#include "modules/reference/image_metrics.h"
#include "modules/reference/path_tracer.h"

namespace lucent {

// The side of the blocks that pictures are compared in: both sides are averaged over them, which leaves less of the truth's noise.
inline constexpr uint32_t TRUTH_BLOCK_PIXELS = 4;

// Two pictures of it, of independent seeds and half of the samples each: where both are compared with a third, their noise is told from its error.
// Rows from the top. Without emissive surfaces, sky seen directly and lamps' light at the first surface.
struct TruthImage {
	uint32_t width = 0;
	uint32_t height = 0;
	uint32_t block_pixels = TRUTH_BLOCK_PIXELS;
	std::vector<float> halves[2]; // rgb, linear radiance; independent of each other
	std::vector<float> indirect; // their mean
	std::vector<float> albedo; // rgb
	std::vector<float> variance; // rgb, of the block's mean in `indirect`; the same all over a block
	std::vector<uint8_t> mask; // 1: counts. 0: an emissive surface, the sky or something black shows there

	size_t pixel_count() const { return size_t(width) * height; }
	MetricImage light() const { return { width, height, indirect }; }
	void average_halves(); // into indirect
};

// p_runs: an even number of pictures with layers, of one size that is a multiple of the block, by different seeds and equal samples.
// The first half of them becomes the first of the halves.
TruthImage combine_runs(std::span<const PathTracerResult> p_runs);

// Channels indirect.RGB and indirect2.RGB (the halves), albedo.RGB, deviation.RGB (root of the variance) and mask.Y.
Status write_truth(const std::string &p_path, const TruthImage &p_truth);
Result<TruthImage> read_truth(const std::string &p_path);

// Half the size: means of 2 x 2 pixels; one counts where all four do. Blocks stay what they are in the picture.
TruthImage half_size(const TruthImage &p_truth);

} // namespace lucent
