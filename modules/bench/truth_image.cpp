// SPDX-License-Identifier: MIT
#include "modules/bench/truth_image.h"

#include "modules/image/image_io.h"

#include <algorithm>

namespace lucent {

namespace {

// Below this sum of the channels a surface reflects too little to be judged by.
constexpr float BLACK_ALBEDO = 0.01f;

bool is_dark(const std::vector<float> &p_values, size_t p_pixel) {
	return p_values[3 * p_pixel] + p_values[3 * p_pixel + 1] + p_values[3 * p_pixel + 2] <= 0.0f;
}

// Unbiased variance of the mean of p_runs' block means, written to every pixel of the block.
void put_variance(TruthImage &r_truth, std::span<const PathTracerResult> p_runs, uint32_t p_x0, uint32_t p_y0) {
	const uint32_t side = r_truth.block_pixels;
	const double runs = double(p_runs.size());
	for (uint32_t c = 0; c < 3; c++) {
		double sum = 0, square = 0;
		for (const PathTracerResult &run : p_runs) {
			double mean = 0;
			for (uint32_t i = 0; i < side * side; i++) {
				mean += run.indirect[3 * (size_t(p_y0 + i / side) * r_truth.width + p_x0 + i % side) + c] / double(side * side);
			}
			sum += mean;
			square += mean * mean;
		}
		const double variance = std::max(square - sum * sum / runs, 0.0) / (runs - 1.0) / runs;
		for (uint32_t i = 0; i < side * side; i++) {
			r_truth.variance[3 * (size_t(p_y0 + i / side) * r_truth.width + p_x0 + i % side) + c] = float(variance);
		}
	}
}

// A pixel beside the void may be partly void itself, which a black sky doesn't tell from a dark surface.
void mask_rim_of_void(TruthImage &r_truth, const PathTracerResult &p_run) {
	for (size_t i = 0; i < r_truth.pixel_count(); i++) {
		if (p_run.depth[i] > 0.0f) {
			continue;
		}
		const uint32_t x = uint32_t(i % r_truth.width), y = uint32_t(i / r_truth.width);
		for (uint32_t ny = y > 0 ? y - 1 : 0; ny <= std::min(y + 1, r_truth.height - 1); ny++) {
			for (uint32_t nx = x > 0 ? x - 1 : 0; nx <= std::min(x + 1, r_truth.width - 1); nx++) {
				r_truth.mask[size_t(ny) * r_truth.width + nx] = 0;
			}
		}
	}
}

Result<std::vector<float>> layer(const std::string &p_path, const ExrImage &p_image, const std::string &p_name, const std::vector<std::string> &p_letters) {
	std::vector<float> values(size_t(p_image.width) * p_image.height * p_letters.size());
	for (size_t c = 0; c < p_letters.size(); c++) {
		const ExrChannel *channel = p_image.find(p_name + "." + p_letters[c]);
		if (channel == nullptr) {
			return make_error("{}: expected a picture made by 'lucent bench truth', with a channel {}.{}", p_path, p_name, p_letters[c]);
		}
		for (size_t i = 0; i < channel->values.size(); i++) {
			values[i * p_letters.size() + c] = channel->values[i];
		}
	}
	return values;
}

} // namespace

void TruthImage::average_halves() {
	indirect.resize(halves[0].size());
	std::transform(halves[0].begin(), halves[0].end(), halves[1].begin(), indirect.begin(), [](float p_a, float p_b) { return 0.5f * (p_a + p_b); });
}

TruthImage combine_runs(std::span<const PathTracerResult> p_runs) {
	const PathTracerResult &first = p_runs.front();
	TruthImage truth = { .width = first.width, .height = first.height };
	INVARIANT(p_runs.size() >= 2 && p_runs.size() % 2 == 0 && truth.width % TRUTH_BLOCK_PIXELS == 0 && truth.height % TRUTH_BLOCK_PIXELS == 0, "{} runs of {} x {} pixels", p_runs.size(), truth.width, truth.height);
	const float weight = 1.0f / float(p_runs.size());
	truth.halves[0].resize(3 * truth.pixel_count());
	truth.halves[1].resize(3 * truth.pixel_count());
	truth.albedo.resize(3 * truth.pixel_count());
	truth.variance.resize(3 * truth.pixel_count());
	truth.mask.assign(truth.pixel_count(), 1);
	for (size_t r = 0; r < p_runs.size(); r++) {
		const PathTracerResult &run = p_runs[r];
		std::vector<float> &half = truth.halves[r < p_runs.size() / 2 ? 0 : 1];
		for (size_t i = 0; i < half.size(); i++) {
			half[i] += 2.0f * weight * run.indirect[i];
			truth.albedo[i] += weight * run.albedo[i];
		}
		for (size_t i = 0; i < truth.pixel_count(); i++) {
			truth.mask[i] &= is_dark(run.emission, i) && is_dark(run.background, i) && run.depth[i] > 0.0f ? 1 : 0;
		}
	}
	truth.average_halves();
	mask_rim_of_void(truth, first);
	for (size_t i = 0; i < truth.pixel_count(); i++) {
		truth.mask[i] &= truth.albedo[3 * i] + truth.albedo[3 * i + 1] + truth.albedo[3 * i + 2] > BLACK_ALBEDO ? 1 : 0;
	}
	for (uint32_t y = 0; y < truth.height; y += TRUTH_BLOCK_PIXELS) {
		for (uint32_t x = 0; x < truth.width; x += TRUTH_BLOCK_PIXELS) {
			put_variance(truth, p_runs, x, y);
		}
	}
	return truth;
}

Status write_truth(const std::string &p_path, const TruthImage &p_truth) {
	const std::vector<std::string> rgb = { "R", "G", "B" };
	const std::vector<float> mask(p_truth.mask.begin(), p_truth.mask.end());
	// Variances are far below a half float's smallest steps: their roots are stored.
	std::vector<float> deviation(p_truth.variance.size());
	std::transform(p_truth.variance.begin(), p_truth.variance.end(), deviation.begin(), [](float p_value) { return std::sqrt(p_value); });
	const std::vector<ExrLayer> layers = { { "indirect", rgb, p_truth.halves[0], true }, { "indirect2", rgb, p_truth.halves[1], true }, { "albedo", rgb, p_truth.albedo, true }, { "deviation", rgb, deviation, true }, { "mask", { "Y" }, mask, true } };
	return write_exr(p_path, p_truth.width, p_truth.height, layers);
}

Result<TruthImage> read_truth(const std::string &p_path) {
	const Result<ExrImage> file = read_exr_layers(p_path);
	if (!file) {
		return file.error();
	}
	TruthImage truth = { .width = file.value().width, .height = file.value().height };
	if (truth.width % TRUTH_BLOCK_PIXELS != 0 || truth.height % TRUTH_BLOCK_PIXELS != 0) {
		return make_error("{}: {}x{} is not a multiple of {} pixels", p_path, truth.width, truth.height, TRUTH_BLOCK_PIXELS);
	}
	const std::vector<std::string> rgb = { "R", "G", "B" };
	Result<std::vector<float>> indirect = layer(p_path, file.value(), "indirect", rgb);
	Result<std::vector<float>> indirect2 = layer(p_path, file.value(), "indirect2", rgb);
	Result<std::vector<float>> albedo = layer(p_path, file.value(), "albedo", rgb);
	Result<std::vector<float>> deviation = layer(p_path, file.value(), "deviation", rgb);
	const Result<std::vector<float>> mask = layer(p_path, file.value(), "mask", { "Y" });
	for (const Result<std::vector<float>> *part : std::initializer_list<const Result<std::vector<float>> *>{ &indirect, &indirect2, &albedo, &deviation, &mask }) {
		if (!*part) {
			return part->error();
		}
	}
	truth.halves[0] = indirect.take();
	truth.halves[1] = indirect2.take();
	truth.average_halves();
	truth.albedo = albedo.take();
	truth.variance = deviation.take();
	for (float &value : truth.variance) {
		value *= value;
	}
	for (const float value : mask.value()) {
		truth.mask.push_back(value > 0.5f ? 1 : 0);
	}
	return truth;
}

TruthImage half_size(const TruthImage &p_truth) {
	TruthImage half = { .width = p_truth.width / 2, .height = p_truth.height / 2, .block_pixels = p_truth.block_pixels / 2 };
	const auto shrink = [&](const std::vector<float> &p_values) {
		std::vector<float> result(3 * half.pixel_count());
		for (size_t i = 0; i < result.size(); i++) {
			const size_t x = i / 3 % half.width, y = i / 3 / half.width;
			const float *corner = p_values.data() + 3 * (2 * y * p_truth.width + 2 * x) + i % 3;
			result[i] = 0.25f * (corner[0] + corner[3] + corner[3 * p_truth.width] + corner[3 * p_truth.width + 3]);
		}
		return result;
	};
	half.halves[0] = shrink(p_truth.halves[0]);
	half.halves[1] = shrink(p_truth.halves[1]);
	half.average_halves();
	half.albedo = shrink(p_truth.albedo);
	half.variance = shrink(p_truth.variance);
	half.mask.resize(half.pixel_count());
	for (size_t i = 0; i < half.mask.size(); i++) {
		const uint8_t *corner = p_truth.mask.data() + 2 * (i / half.width) * p_truth.width + 2 * (i % half.width);
		half.mask[i] = corner[0] & corner[1] & corner[p_truth.width] & corner[p_truth.width + 1];
	}
	return half;
}

} // namespace lucent
