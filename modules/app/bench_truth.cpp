// SPDX-License-Identifier: MIT
#include "modules/app/bench.h"
#include "modules/app/bench_results.h"
#include "modules/app/output_files.h"
#include "modules/app/register_modules.h"
#include "modules/app/render_session.h"
#include "modules/bench/light_error.h"
#include "modules/bench/truth_image.h"

#include <cstdio>

namespace lucent {

namespace {

constexpr uint32_t RUNS = 8;

Result<TruthImage> trace_truth(const BenchOptions &p_options, const std::string &p_name) {
	RenderingServer server(nullptr);
	RenderSession session(server);
	if (const Status status = session.load(p_options.scenes + p_name + ".tscn"); !status) {
		return status.error();
	}
	RenderOptions view;
	view.width = p_options.width;
	view.height = p_options.height;
	if (const Status status = session.open_viewport(view); !status) {
		return status.error();
	}
	const Viewport &viewport = *server.scenario_snapshot().viewports.get(session.viewport());
	const Result<std::unique_ptr<PathTracer>> tracer = PathTracer::create(server.scenario_snapshot(), viewport.scenario, viewport.camera);
	if (!tracer) {
		return tracer.error();
	}
	std::vector<PathTracerResult> runs;
	for (uint32_t seed = 0; seed < RUNS; seed++) {
		Result<PathTracerResult> run = tracer.value()->render({ .width = view.width, .height = view.height, .spp = p_options.spp / RUNS, .seed = seed, .aov = true });
		if (!run) {
			return run.error();
		}
		runs.push_back(run.take());
	}
	return combine_runs(runs);
}

} // namespace

int bench_truth(const BenchOptions &p_options) {
	register_modules();
	const Result<std::vector<std::string>> names = bench_scenes(p_options);
	if (!names) {
		return bench_failure(EXIT_BAD_INPUT, names.error());
	}
	for (const std::string &name : names.value()) {
		const std::string path = p_options.truth + name + ".exr";
		if (const Status status = check_writable(path); !status) {
			return bench_failure(EXIT_OUTPUT, status.error());
		}
		const Result<TruthImage> truth = trace_truth(p_options, name);
		if (!truth) {
			return bench_failure(EXIT_BAD_INPUT, truth.error());
		}
		if (const Status status = write_truth(path, truth.value()); !status) {
			return bench_failure(EXIT_OUTPUT, status.error());
		}
		const Result<LightError> self = measure_light_error(truth.value().light(), truth.value());
		if (!self) {
			return bench_failure(EXIT_BAD_INPUT, self.error());
		}
		std::printf("%s: mean %.5g, noise %.4f of it a block and %.4f a pixel, flat %.3f, %u smooth windows\n", path.c_str(), self.value().truth_mean, self.value().blocks.noise, self.value().pixels.noise, self.value().flat, self.value().mottle.windows);
		std::fflush(stdout);
	}
	return EXIT_OK;
}

} // namespace lucent
