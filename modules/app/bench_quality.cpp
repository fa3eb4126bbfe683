// SPDX-License-Identifier: MIT
#include "modules/app/bench_quality.h"
#include "modules/app/bench.h"
#include "modules/app/bench_results.h"
#include "modules/app/bench_rig.h"
#include "modules/app/register_modules.h"
#include "modules/bench/statistics.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace lucent {

namespace {

constexpr uint32_t CPU_FRAMES = 76; // the scenes here settle after 40
constexpr uint32_t CPU_GRID = 64;
constexpr uint32_t GPU_FRAMES = 512;

Result<TruthImage> fitting_truth(const BenchOptions &p_options, const std::string &p_name) {
	const std::string path = p_options.truth + p_name + ".exr";
	Result<TruthImage> truth = read_truth(path);
	if (!truth) {
		return truth;
	}
	if (truth.value().width == p_options.width * 2 && truth.value().height == p_options.height * 2) {
		return half_size(truth.value());
	}
	if (truth.value().width != p_options.width || truth.value().height != p_options.height) {
		return make_error("{}: --size {}x{} is neither the truth's {}x{} nor half of it", path, p_options.width, p_options.height, truth.value().width, truth.value().height);
	}
	return truth;
}

// What SDFGI adds: the same two pictures that a user gets from `lucent render` with and without it.
MetricImage indirect_light(BenchScene &r_scene, const MetricImage &p_direct) {
	MetricImage light = r_scene.picture(ViewportBuffer::COLOR_LINEAR);
	for (size_t i = 0; i < light.values.size(); i++) {
		light.values[i] -= p_direct.values[i];
	}
	return light;
}

// 1, 2, 4 … frames, and the last.
bool is_on_curve(uint32_t p_frame, bool p_last) {
	return p_last || (p_frame & (p_frame - 1)) == 0;
}

Result<QualityRow> measure_scene(RenderingDevice &r_device, const BenchOptions &p_options, const std::string &p_name) {
	const auto start = std::chrono::steady_clock::now();
	QualityRow row = { .name = p_name };
	Result<TruthImage> truth = fitting_truth(p_options, p_name);
	if (!truth) {
		return truth.error();
	}
	row.truth = truth.take();
	BenchScene scene(r_device);
	if (const Status status = scene.load(p_options.scenes + p_name + ".tscn", p_options, p_options.width, p_options.height); !status) {
		return status.error();
	}
	scene.set_sdfgi_enabled(false);
	scene.draw();
	const MetricImage direct = scene.picture(ViewportBuffer::COLOR_LINEAR);
	scene.set_sdfgi_enabled(true);
	const uint32_t limit = p_options.frames != 0 ? p_options.frames : GPU_FRAMES;
	std::vector<double> frame_ms;
	while (row.frames < limit && !row.settled) {
		const FrameSample sample = scene.draw();
		row.frames++;
		row.settled = sample.stats.gi.converged;
		row.gi_bytes = sample.stats.gi.bytes;
		frame_ms.push_back(sample.gi_ms());
		if (!is_on_curve(row.frames, row.settled || row.frames == limit)) {
			continue;
		}
		row.light = indirect_light(scene, direct);
		const Result<LightError> error = measure_light_error(row.light, row.truth);
		if (!error) {
			return make_error("{}: {}", p_name, error.error().message);
		}
		row.error = error.value();
		row.curve.emplace_back(row.frames, row.error.sealed ? row.error.leak.max : row.error.blocks.nrmse);
	}
	row.gi_ms = percentile(frame_ms, 0.5);
	row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	return row;
}

// Worst first; sealed scenes by whether they leak.
void sort_rows(std::vector<QualityRow> &r_rows) {
	const auto badness = [](const QualityRow &p_row) {
		return !p_row.error.sealed ? p_row.error.blocks.nrmse : (p_row.error.leak.max > 0.0 ? std::numeric_limits<double>::infinity() : -1.0);
	};
	std::stable_sort(r_rows.begin(), r_rows.end(), [&](const QualityRow &p_a, const QualityRow &p_b) { return badness(p_a) > badness(p_b); });
}

} // namespace

int bench_quality(const BenchOptions &p_options) {
	const Result<std::vector<std::string>> names = bench_scenes(p_options);
	if (!names) {
		return bench_failure(EXIT_BAD_INPUT, names.error());
	}
	if (const Status status = prepare_output(p_options); !status) {
		return bench_failure(EXIT_OUTPUT, status.error());
	}
	const Result<std::unique_ptr<RenderingDevice>> device = create_bench_device(p_options);
	if (!device) {
		return bench_failure(EXIT_DEVICE, device.error());
	}
	BenchOptions options = p_options;
	if (is_cpu_device(device.value()->info())) {
		// The scenes are small: 64 cells of 0.2 m hold most of them.
		options.grid = options.grid != 0 ? options.grid : CPU_GRID;
		options.frames = options.frames != 0 ? options.frames : CPU_FRAMES;
	}
	register_modules();
	std::vector<QualityRow> rows;
	for (const std::string &name : names.value()) {
		Result<QualityRow> row = measure_scene(*device.value(), options, name);
		if (!row) {
			return bench_failure(EXIT_BAD_INPUT, row.error());
		}
		rows.push_back(row.take());
		if (!p_options.quiet) {
			std::fprintf(stderr, "%s: %u frames, %.1f s\n", name.c_str(), rows.back().frames, rows.back().seconds);
		}
	}
	sort_rows(rows);
	nlohmann::ordered_json conditions = bench_conditions(p_options, device.value()->info());
	conditions["size"] = { p_options.width, p_options.height };
	conditions["grid"] = options.grid != 0 ? options.grid : SdfgiSettings().grid_size_cells;
	if (const Status status = write_quality(p_options, rows, conditions); !status) {
		return bench_failure(EXIT_OUTPUT, status.error());
	}
	return EXIT_OK;
}

} // namespace lucent
