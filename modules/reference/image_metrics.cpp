// SPDX-License-Identifier: MIT
#include "modules/reference/image_metrics.h"

#include "servers/core/math_types.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr double LIT_THRESHOLD = 0.05;

double pixel_mean(const MetricImage &p_image, size_t p_pixel) {
	const float *v = p_image.values.data() + 3 * p_pixel;
	return (double(v[0]) + v[1] + v[2]) / 3.0;
}

// The value below which p_share of p_values lie; reorders them.
template <typename T>
double percentile(std::vector<T> &r_values, double p_share) {
	const size_t index = std::min(r_values.size() - 1, size_t(p_share * double(r_values.size())));
	std::nth_element(r_values.begin(), r_values.begin() + ptrdiff_t(index), r_values.end());
	return r_values[index];
}

double ratio(double p_a, double p_b, double p_of_zeros) {
	if (p_b == 0.0) {
		return p_a == 0.0 ? p_of_zeros : std::numeric_limits<double>::infinity();
	}
	return p_a / p_b;
}

Result<std::vector<size_t>> chosen_pixels(const MetricImage &p_image, std::span<const uint8_t> p_mask) {
	if (p_image.values.size() != 3 * p_image.pixel_count()) {
		return make_error("an image of {}x{} has {} values, not 3 a pixel", p_image.width, p_image.height, p_image.values.size());
	}
	if (!p_mask.empty() && p_mask.size() != p_image.pixel_count()) {
		return make_error("the mask has {} pixels, the image {}", p_mask.size(), p_image.pixel_count());
	}
	std::vector<size_t> pixels;
	for (size_t i = 0; i < p_image.pixel_count(); i++) {
		if (p_mask.empty() || p_mask[i] != 0) {
			pixels.push_back(i);
		}
	}
	if (pixels.empty()) {
		return make_error("{}", p_mask.empty() ? "the image is empty" : "the mask chooses no pixel");
	}
	return pixels;
}

Status check_finite(const MetricImage &p_image, const std::vector<size_t> &p_pixels, const char *p_which) {
	for (size_t pixel : p_pixels) {
		for (size_t c = 0; c < 3; c++) {
			if (!std::isfinite(p_image.values[3 * pixel + c])) {
				return make_error("pixel {},{} of the {} image is not finite", pixel % p_image.width, pixel / p_image.width, p_which);
			}
		}
	}
	return Ok();
}

void add_linear_metrics(const MetricImage &p_a, const MetricImage &p_b, const std::vector<size_t> &p_pixels, ImageMetrics &r_metrics) {
	std::vector<double> truth;
	for (size_t pixel : p_pixels) {
		truth.push_back(pixel_mean(p_b, pixel));
	}
	const double bright = percentile(truth, 0.95);
	// For a truth that is black nearly everywhere, any error is as large as it is in absolute terms.
	const double epsilon = bright > 0.0 ? 0.05 * bright : 1.0;
	double square = 0, relative = 0, sum_a = 0, sum_b = 0;
	uint64_t over = 0, under = 0;
	for (size_t pixel : p_pixels) {
		for (size_t i = 3 * pixel; i < 3 * pixel + 3; i++) {
			const double b = p_b.values[i];
			const double difference = p_a.values[i] - b;
			square += difference * difference;
			relative += difference * difference / (b * b + epsilon * epsilon);
			r_metrics.max_error = std::max(r_metrics.max_error, std::abs(difference));
		}
		const double a = pixel_mean(p_a, pixel), b = pixel_mean(p_b, pixel);
		sum_a += a;
		sum_b += b;
		over += a - b > LIT_THRESHOLD;
		under += b - a > LIT_THRESHOLD;
	}
	const double count = double(p_pixels.size());
	r_metrics.pixels = p_pixels.size();
	r_metrics.mean_a = sum_a / count;
	r_metrics.mean_b = sum_b / count;
	r_metrics.rmse = std::sqrt(square / (3.0 * count));
	r_metrics.nrmse = ratio(r_metrics.rmse, r_metrics.mean_b, 0.0);
	r_metrics.relmse = relative / (3.0 * count);
	r_metrics.energy = ratio(r_metrics.mean_a, r_metrics.mean_b, 1.0);
	r_metrics.over_lit = double(over) / count;
	r_metrics.under_lit = double(under) / count;
}

} // namespace

std::vector<float> display_values(const MetricImage &p_image, float p_exposure) {
	std::vector<float> values(p_image.values.size());
	for (size_t i = 0; i < values.size(); i++) {
		const float value = p_exposure * p_image.values[i];
		values[i] = linear_to_srgb(value > 0.0f ? std::min(value, 1.0f) : 0.0f);
	}
	return values;
}

Result<ImageMetrics> compare_images(const MetricImage &p_a, const MetricImage &p_b, std::span<const uint8_t> p_mask, const MetricSettings &p_settings) {
	if (p_a.width != p_b.width || p_a.height != p_b.height) {
		return make_error("the first image is {}x{}, the second {}x{}", p_a.width, p_a.height, p_b.width, p_b.height);
	}
	const Result<std::vector<size_t>> pixels = chosen_pixels(p_b, p_mask);
	if (!pixels) {
		return pixels.error();
	}
	if (p_a.values.size() != p_b.values.size()) {
		return make_error("the first image has {} values, the second {}", p_a.values.size(), p_b.values.size());
	}
	for (const auto &[image, which] : { std::pair(&p_a, "first"), std::pair(&p_b, "second") }) {
		if (const Status finite = check_finite(*image, pixels.value(), which); !finite) {
			return finite.error();
		}
	}
	ImageMetrics metrics;
	add_linear_metrics(p_a, p_b, pixels.value(), metrics);
	const std::vector<float> a = display_values(p_a, p_settings.exposure);
	const std::vector<float> b = display_values(p_b, p_settings.exposure);
	const std::vector<float> similarity = ssim_map(a, b, p_a.width, p_a.height);
	const std::vector<float> flip = flip_map(a, b, p_a.width, p_a.height, p_settings.pixels_per_degree);
	std::vector<float> chosen_flip;
	for (size_t pixel : pixels.value()) {
		metrics.ssim += similarity[pixel];
		metrics.flip += flip[pixel];
		chosen_flip.push_back(flip[pixel]);
	}
	metrics.ssim /= double(metrics.pixels);
	metrics.flip /= double(metrics.pixels);
	metrics.flip_p99 = percentile(chosen_flip, 0.99);
	return metrics;
}

Result<LeakMetrics> measure_leak(const MetricImage &p_a, std::span<const uint8_t> p_mask) {
	const Result<std::vector<size_t>> pixels = chosen_pixels(p_a, p_mask);
	if (!pixels) {
		return pixels.error();
	}
	if (const Status finite = check_finite(p_a, pixels.value(), "first"); !finite) {
		return finite.error();
	}
	LeakMetrics leak;
	std::vector<double> values;
	for (size_t pixel : pixels.value()) {
		const float *v = p_a.values.data() + 3 * pixel;
		values.push_back((std::abs(double(v[0])) + std::abs(double(v[1])) + std::abs(double(v[2]))) / 3.0);
		leak.mean += values.back();
		leak.max = std::max(leak.max, values.back());
	}
	leak.pixels = values.size();
	leak.mean /= double(values.size());
	leak.p999 = percentile(values, 0.999);
	return leak;
}

std::vector<uint8_t> difference_picture(const MetricImage &p_a, const MetricImage &p_b, float p_exposure) {
	constexpr float FULL_SCALE = 0.25f;
	const std::vector<float> a = display_values(p_a, p_exposure);
	const std::vector<float> b = display_values(p_b, p_exposure);
	const auto luma = [](const float *p_rgb) { return 0.2126f * p_rgb[0] + 0.7152f * p_rgb[1] + 0.0722f * p_rgb[2]; };
	std::vector<uint8_t> picture(a.size());
	for (size_t i = 0; i < picture.size(); i += 3) {
		const float difference = (luma(a.data() + i) - luma(b.data() + i)) / FULL_SCALE;
		const float strength = std::min(std::abs(difference), 1.0f);
		// Two ramps through one hue each: dark to half strength, then towards white.
		const uint8_t main = uint8_t(std::lround(255.0f * std::min(2.0f * strength, 1.0f)));
		const uint8_t rest = uint8_t(std::lround(255.0f * std::max(2.0f * strength - 1.0f, 0.0f) * 0.7f));
		picture[i] = difference > 0.0f ? main : 0;
		picture[i + 1] = rest;
		picture[i + 2] = difference < 0.0f ? main : 0;
	}
	return picture;
}

} // namespace lucent
