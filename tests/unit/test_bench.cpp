// SPDX-License-Identifier: MIT
#include "modules/bench/light_error.h"
#include "modules/bench/report.h"
#include "modules/bench/statistics.h"
#include "modules/bench/truth_image.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

using namespace lucent;

namespace {

// Light that grows along x from 1 to 2, albedo 0.5, no noise.
TruthImage ramp(uint32_t p_width, uint32_t p_height) {
	TruthImage truth = { .width = p_width, .height = p_height };
	for (size_t i = 0; i < 3 * truth.pixel_count(); i++) {
		truth.indirect.push_back(1.0f + float(i / 3 % p_width) / float(p_width - 1));
		truth.albedo.push_back(0.5f);
		truth.variance.push_back(0.0f);
	}
	truth.mask.assign(truth.pixel_count(), 1);
	return truth;
}

} // namespace

TEST_CASE("statistics: percentiles are linear between order statistics") {
	CHECK(percentile({ 3, 1, 2, 4 }, 0.5) == doctest::Approx(2.5));
	CHECK(percentile({ 3, 1, 2, 4 }, 1.0) == 4.0);
	CHECK(percentile({ 7 }, 0.95) == 7.0);
	CHECK(percentile({}, 0.5) == 0.0);
	const Distribution distribution = distribution_of({ 1, 2, 3, 4, 5 });
	CHECK(distribution.median == 3.0);
	CHECK(distribution.p95 == doctest::Approx(4.8));
	CHECK(distribution.max == 5.0);
}

TEST_CASE("statistics: a response counts frames until the change is done and stays done") {
	const Response straight = response_of(0.0, { 0.5, 0.9, 0.99, 1.0, 1.0 });
	CHECK(straight.frames_50 == 1);
	CHECK(straight.frames_90 == 2);
	CHECK(straight.frames_99 == 3);
	CHECK(straight.overshoot == 0.0);
	// Falling, beyond the end and back.
	const Response overshot = response_of(2.0, { 1.0, 0.5, 1.0, 1.0 });
	CHECK(overshot.overshoot == doctest::Approx(0.5));
	CHECK(overshot.frames_50 == 1);
	CHECK(overshot.frames_90 == 3);
	CHECK(response_of(1.0, { 1.0, 1.0 }).frames_99 == 0);
}

TEST_CASE("light error: exact light has none, scaled light has its energy") {
	const TruthImage truth = ramp(16, 8);
	MetricImage light = truth.light();
	const LightError exact = measure_light_error(light, truth).value();
	CHECK(exact.nrmse == 0.0);
	CHECK(exact.energy == doctest::Approx(1.0));
	CHECK(exact.log_correlation == doctest::Approx(1.0));
	CHECK(exact.blocks == 8);
	for (float &value : light.values) {
		value *= 1.2f;
	}
	const LightError bright = measure_light_error(light, truth).value();
	CHECK(bright.energy == doctest::Approx(1.2));
	CHECK(bright.nrmse > 0.2); // at least the energy's error
	CHECK(bright.nrmse < 0.22);
	CHECK(bright.energy_interval == 0.0);
}

TEST_CASE("light error: the truth's noise widens the intervals and is not hidden") {
	TruthImage truth = ramp(16, 8);
	std::fill(truth.variance.begin(), truth.variance.end(), 0.01f);
	const LightError error = measure_light_error(truth.light(), truth).value();
	CHECK(error.noise == doctest::Approx(0.1 / error.truth_mean));
	CHECK(error.energy_interval == doctest::Approx(1.96 * 0.1 / std::sqrt(8.0) / error.truth_mean));
}

TEST_CASE("light error: masked pixels don't count, a black truth is about leaks") {
	TruthImage truth = ramp(16, 8);
	MetricImage light = truth.light();
	light.values[0] = 100.0f;
	truth.mask[0] = 0; // 15 of 16 pixels of the block are left
	CHECK(measure_light_error(light, truth).value().nrmse == 0.0);
	std::fill(truth.indirect.begin(), truth.indirect.end(), 0.0f);
	std::fill(light.values.begin(), light.values.end(), 0.0f);
	light.values[3 * 5] = 0.3f;
	const LightError leak = measure_light_error(light, truth).value();
	CHECK(leak.sealed);
	CHECK(leak.leak.max == doctest::Approx(0.1));
	CHECK_FALSE(measure_light_error({ 8, 8, std::vector<float>(192) }, truth).ok());
}

TEST_CASE("truth images: written, read and halved") {
	std::string folder = (std::filesystem::temp_directory_path() / "lucent-truth-XXXXXX").string();
	REQUIRE(mkdtemp(folder.data()) != nullptr);
	TruthImage truth = ramp(16, 8);
	truth.mask[17] = 0;
	std::fill(truth.variance.begin(), truth.variance.end(), 0.25f);
	REQUIRE(write_truth(folder + "/t.exr", truth).ok());
	const Result<TruthImage> read = read_truth(folder + "/t.exr");
	CHECK_FALSE(read_truth(folder + "/missing.exr").ok());
	std::filesystem::remove_all(folder);
	REQUIRE(read.ok());
	CHECK(read.value().mask == truth.mask);
	CHECK(read.value().variance[0] == doctest::Approx(0.25f).epsilon(0.001));
	CHECK(read.value().indirect[3 * 7] == doctest::Approx(truth.indirect[3 * 7]).epsilon(0.001));
	const TruthImage half = half_size(truth);
	CHECK(half.width == 8);
	CHECK(half.block_pixels == 2);
	CHECK(half.indirect[0] == doctest::Approx(0.5f * (truth.indirect[0] + truth.indirect[3])));
	CHECK(half.mask[0] == 0);
	CHECK(half.mask[1] == 1);
	CHECK(measure_light_error(half.light(), half).value().nrmse == 0.0);
}

TEST_CASE("reports: tables are aligned, HTML is escaped and whole") {
	const ReportTable table = { { "name", "ms" }, { { "a<b", "1.5" }, { "longer", "–" } } };
	CHECK(table_text(table) == "name     ms\na<b     1.5\nlonger    –\n");
	HtmlReport report("T", "conditions");
	report.table(table);
	report.chart({ .title = "c", .x_label = "x", .y_label = "y", .log_x = true, .series = { { "s", { 1, 10, 0 }, { 2, 3, 4 } } } });
	const std::string text = report.text();
	CHECK(text.find("a&lt;b") != std::string::npos);
	CHECK(text.find("<polyline") != std::string::npos);
	CHECK(text.find("nan") == std::string::npos);
	CHECK(text.ends_with("</html>\n"));
	CHECK_FALSE(report.picture("/nowhere/picture.png", "").ok());
}
