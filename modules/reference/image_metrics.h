// SPDX-License-Identifier: MIT
#pragma once
// How far a picture is from the truth. Pictures are linear, scene-referred, width * height * 3 floats, rows from the top.

#include "servers/core/error.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lucent {

struct MetricImage {
	uint32_t width = 0;
	uint32_t height = 0;
	std::vector<float> values;

	size_t pixel_count() const { return size_t(width) * height; }
};

// a: the picture under test, b: the truth. Means run over the chosen pixels and the three channels.
struct ImageMetrics {
	uint64_t pixels = 0;
	double mean_a = 0;
	double mean_b = 0;
	double rmse = 0; // sqrt(mean((a - b)^2))
	double nrmse = 0; // rmse / mean_b
	double relmse = 0; // mean((a - b)^2 / (b^2 + (0.05 s)^2)), s: 95th percentile of b's pixel means
	double energy = 0; // mean_a / mean_b
	double over_lit = 0; // share of pixels whose mean is more than 0.05 above b's
	double under_lit = 0; // … below
	double max_error = 0; // largest |a - b| of a channel
	double ssim = 0; // mean structural similarity of luminance, tone-mapped; 1: equal
	double flip = 0; // mean FLIP, 0 to 1
	double flip_p99 = 0;
};

// Where light must not get: what is there has leaked. Of a's pixel means, absolute.
struct LeakMetrics {
	uint64_t pixels = 0;
	double mean = 0;
	double p999 = 0;
	double max = 0;
};

struct MetricSettings {
	float exposure = 1.0f; // for ssim and flip, which see clamp(exposure * value, 0, 1) in sRGB
	float pixels_per_degree = 67.0f; // FLIP's: a 0.7 m wide 3840-pixel display seen from 0.7 m
};

// p_mask: a byte a pixel, not 0: counts; empty: all do. Fails where sizes differ, nothing is chosen or a value is not finite.
// Over a mean of 0, nrmse is 0 and energy 1 where a is black too, else both are infinite.
Result<ImageMetrics> compare_images(const MetricImage &p_a, const MetricImage &p_b, std::span<const uint8_t> p_mask, const MetricSettings &p_settings = {});
Result<LeakMetrics> measure_leak(const MetricImage &p_a, std::span<const uint8_t> p_mask);

// Linear to display: exposure, clamp to 0..1, sRGB encoding.
std::vector<float> display_values(const MetricImage &p_image, float p_exposure);

// By pixel; inputs are sRGB-encoded RGB, 0 to 1.
// Wang et al., IEEE TIP 13(4) 2004: Gaussian window of 11 x 11, sigma 1.5; K1 0.01, K2 0.03; on Rec. 709 luma; the rim is repeated outwards.
std::vector<float> ssim_map(std::span<const float> p_a, std::span<const float> p_b, uint32_t p_width, uint32_t p_height);
// Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", PACMCGIT 3(2) 2020. p_b is the reference.
std::vector<float> flip_map(std::span<const float> p_a, std::span<const float> p_b, uint32_t p_width, uint32_t p_height, float p_pixels_per_degree);

// RGB8: black where equal on the display, red where a is brighter, blue where darker; full colour from a luma difference of 0.25.
std::vector<uint8_t> difference_picture(const MetricImage &p_a, const MetricImage &p_b, float p_exposure);

} // namespace lucent
