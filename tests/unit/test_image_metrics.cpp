// SPDX-License-Identifier: MIT
#include "modules/reference/image_metrics.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace lucent;

namespace {

constexpr float FLIP_GREYS = 0.285013f; // sRGB 0.5 against 0.6
constexpr float FLIP_RED_GREEN = 0.986662f;

MetricImage constant(uint32_t p_width, uint32_t p_height, float p_r, float p_g, float p_b) {
	MetricImage image = { p_width, p_height, {} };
	for (size_t i = 0; i < image.pixel_count(); i++) {
		image.values.insert(image.values.end(), { p_r, p_g, p_b });
	}
	return image;
}

// FLIP of two plain pictures, sRGB-encoded colours.
float plain_flip(float p_ar, float p_ag, float p_ab, float p_br, float p_bg, float p_bb) {
	const MetricImage a = constant(40, 30, p_ar, p_ag, p_ab), b = constant(40, 30, p_br, p_bg, p_bb);
	const std::vector<float> map = flip_map(a.values, b.values, 40, 30, 67.0f);
	for (float value : map) {
		CHECK(value == doctest::Approx(map[0]).epsilon(1e-4));
	}
	return map[0];
}

} // namespace

TEST_CASE("image metrics: figures of two constant images") {
	const MetricImage a = constant(8, 4, 0.6f, 0.6f, 0.6f);
	const MetricImage b = constant(8, 4, 0.5f, 0.5f, 0.5f);
	const Result<ImageMetrics> result = compare_images(a, b, {});
	REQUIRE(result.ok());
	const ImageMetrics &metrics = result.value();
	CHECK(metrics.pixels == 32);
	CHECK(metrics.rmse == doctest::Approx(0.1).epsilon(1e-5));
	CHECK(metrics.nrmse == doctest::Approx(0.2).epsilon(1e-5));
	CHECK(metrics.relmse == doctest::Approx(0.01 / (0.25 + 0.025 * 0.025)).epsilon(1e-5));
	CHECK(metrics.energy == doctest::Approx(1.2).epsilon(1e-5));
	CHECK(metrics.over_lit == 1.0);
	CHECK(metrics.under_lit == 0.0);
	CHECK(metrics.max_error == doctest::Approx(0.1).epsilon(1e-5));
	// Without structure, SSIM is the luminance term.
	const double x = 1.055 * std::pow(0.6, 1 / 2.4) - 0.055, y = 1.055 * std::pow(0.5, 1 / 2.4) - 0.055;
	CHECK(metrics.ssim == doctest::Approx((2 * x * y + 1e-4) / (x * x + y * y + 1e-4)).epsilon(1e-3));
}

TEST_CASE("image metrics: equal images have no error") {
	MetricImage image = constant(16, 16, 0.2f, 0.3f, 0.4f);
	for (size_t i = 0; i < image.values.size(); i++) {
		image.values[i] *= float(i % 7);
	}
	const Result<ImageMetrics> result = compare_images(image, image, {});
	REQUIRE(result.ok());
	CHECK(result.value().rmse == 0.0);
	CHECK(result.value().energy == 1.0);
	CHECK(result.value().flip == 0.0);
	CHECK(result.value().ssim == doctest::Approx(1.0));
}

TEST_CASE("image metrics: a black truth") {
	const MetricImage black = constant(4, 4, 0, 0, 0);
	const Result<ImageMetrics> equal = compare_images(black, black, {});
	REQUIRE(equal.ok());
	CHECK(equal.value().energy == 1.0);
	CHECK(equal.value().nrmse == 0.0);
	const Result<ImageMetrics> lit = compare_images(constant(4, 4, 0.1f, 0, 0), black, {});
	REQUIRE(lit.ok());
	CHECK(std::isinf(lit.value().energy));
	CHECK(std::isinf(lit.value().nrmse));
}

TEST_CASE("image metrics: a mask chooses what counts") {
	MetricImage a = constant(4, 4, 1.0f, 1.0f, 1.0f);
	const MetricImage b = constant(4, 4, 1.0f, 1.0f, 1.0f);
	std::vector<uint8_t> mask(16, 0);
	mask[5] = 255;
	a.values[15] = 3.0f; // pixel 5, red
	a.values[0] = 100.0f; // pixel 0 is left out
	const Result<ImageMetrics> result = compare_images(a, b, mask);
	REQUIRE(result.ok());
	CHECK(result.value().pixels == 1);
	CHECK(result.value().rmse == doctest::Approx(std::sqrt(4.0 / 3.0)));
	CHECK(result.value().mean_a == doctest::Approx(5.0 / 3.0));
	CHECK_FALSE(compare_images(a, b, std::vector<uint8_t>(16, 0)).ok());
	CHECK_FALSE(compare_images(a, b, std::vector<uint8_t>(15, 1)).ok());
	a.values[15] = NAN;
	CHECK_FALSE(compare_images(a, b, mask).ok());
	CHECK_FALSE(compare_images(constant(4, 3, 1, 1, 1), b, {}).ok());
}

TEST_CASE("image metrics: a leak is measured in absolute light") {
	MetricImage image = constant(100, 10, 0, 0, 0);
	image.values[3 * 20] = 0.3f;
	std::vector<uint8_t> mask(1000, 1);
	Result<LeakMetrics> leak = measure_leak(image, mask);
	REQUIRE(leak.ok());
	CHECK(leak.value().max == doctest::Approx(0.1));
	CHECK(leak.value().mean == doctest::Approx(0.0001));
	mask[20] = 0;
	leak = measure_leak(image, mask);
	REQUIRE(leak.ok());
	CHECK(leak.value().max == 0.0);
}

// The largest difference is green to blue by definition (section 4.1.3 of the paper): 1. Other figures are its equations, worked
// by hand for plain colours, which the contrast filters leave alone.
TEST_CASE("flip: plain colours") {
	CHECK(plain_flip(0, 1, 0, 0, 0, 1) == doctest::Approx(1.0).epsilon(1e-4));
	CHECK(plain_flip(0, 0, 0, 1, 1, 1) == doctest::Approx(0.967391).epsilon(1e-4));
	CHECK(plain_flip(0.5f, 0.5f, 0.5f, 0.6f, 0.6f, 0.6f) == doctest::Approx(FLIP_GREYS).epsilon(1e-3));
	CHECK(plain_flip(1, 0, 0, 0, 1, 0) == doctest::Approx(FLIP_RED_GREEN).epsilon(1e-3));
	CHECK(plain_flip(0.3f, 0.6f, 0.9f, 0.3f, 0.6f, 0.9f) == 0.0f);
}

TEST_CASE("flip: features raise the difference, fine patterns fade with distance") {
	const uint32_t size = 64;
	const MetricImage grey = constant(size, size, 0.5f, 0.5f, 0.5f);
	MetricImage step = grey, checker = grey;
	for (uint32_t y = 0; y < size; y++) {
		for (uint32_t x = 0; x < size; x++) {
			for (uint32_t c = 0; c < 3; c++) {
				step.values[3 * (y * size + x) + c] = x < size / 2 ? 0.5f : 0.6f;
				checker.values[3 * (y * size + x) + c] = (x + y) % 2 ? 0.45f : 0.55f;
			}
		}
	}
	const std::vector<float> edge = flip_map(step.values, grey.values, size, size, 67.0f);
	// Far right of the edge, the plain difference; at it, more for the feature that the other picture lacks than colour alone.
	CHECK(edge[32 * size + 60] == doctest::Approx(FLIP_GREYS).epsilon(1e-2));
	CHECK(edge[32 * size + 32] > 0.5f * FLIP_GREYS);
	CHECK(edge[32 * size + 4] < 0.01f);
	const std::vector<float> near = flip_map(checker.values, grey.values, size, size, 10.0f);
	const std::vector<float> far = flip_map(checker.values, grey.values, size, size, 134.0f);
	CHECK(far[32 * size + 32] < 0.2f * near[32 * size + 32]);
}

TEST_CASE("ssim: inverted structure is unlike") {
	MetricImage a = constant(32, 32, 0, 0, 0), b = a;
	for (uint32_t i = 0; i < 32 * 32; i++) {
		for (uint32_t c = 0; c < 3; c++) {
			a.values[3 * i + c] = i % 2 ? 0.8f : 0.2f;
			b.values[3 * i + c] = i % 2 ? 0.2f : 0.8f;
		}
	}
	const std::vector<float> map = ssim_map(a.values, b.values, 32, 32);
	// Means are equal and the covariance is minus the variance v = 0.09: (C2 - 2 v) / (C2 + 2 v).
	CHECK(map[16 * 32 + 16] == doctest::Approx((9e-4 - 0.18) / (9e-4 + 0.18)).epsilon(0.01));
}

TEST_CASE("difference picture: red where brighter, blue where darker, black where equal") {
	MetricImage a = constant(3, 1, 0.5f, 0.5f, 0.5f);
	const MetricImage b = a;
	a.values[0] = a.values[1] = a.values[2] = 0.6f;
	a.values[3] = a.values[4] = a.values[5] = 0.4f;
	const std::vector<uint8_t> picture = difference_picture(a, b, 1.0f);
	CHECK(picture[0] > 0);
	CHECK(picture[2] == 0);
	CHECK(picture[3] == 0);
	CHECK(picture[5] > 0);
	CHECK(int(picture[6]) + picture[7] + picture[8] == 0);
}
