// SPDX-License-Identifier: MIT
#include "modules/app/commands.h"
#include "modules/app/exit_codes.h"
#include "modules/app/output_files.h"
#include "modules/app/property_setting.h"
#include "modules/app/reference_options.h"
#include "modules/app/register_modules.h"
#include "modules/app/render_session.h"
#include "modules/image/image_io.h"
#include "modules/reference/path_tracer.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace lucent {

namespace {

std::atomic<bool> interrupted{ false };
static_assert(std::atomic<bool>::is_always_lock_free); // set in a signal handler

// While it lives, the first Ctrl-C asks to stop; a second one ends the program as usual.
class InterruptGuard {
public:
	InterruptGuard() {
		struct sigaction action = {};
		action.sa_handler = [](int) { interrupted = true; };
		action.sa_flags = SA_RESETHAND;
		sigaction(SIGINT, &action, &previous);
	}
	~InterruptGuard() { sigaction(SIGINT, &previous, nullptr); }
	InterruptGuard(const InterruptGuard &) = delete;
	InterruptGuard &operator=(const InterruptGuard &) = delete;

private:
	struct sigaction previous = {};
};

int report(ExitCode p_code, const Error &p_error) {
	log_error("{}", p_error.message);
	return p_code;
}

void show_progress(const PathTracerProgress &p_progress) {
	std::fprintf(stderr, "\r\x1b[K%u of %u samples a pixel, %.0f s, about %.0f s left", p_progress.spp_done, p_progress.spp, p_progress.elapsed_s, p_progress.remaining_s);
	std::fflush(stderr);
}

const std::vector<float> &layer_values(const PathTracerResult &p_result, const std::string &p_name) {
	const std::vector<float> *const values[] = { &p_result.direct, &p_result.indirect, &p_result.emission, &p_result.background, &p_result.albedo, &p_result.normal, &p_result.depth };
	static_assert(std::size(values) == std::size(REFERENCE_AOV_NAMES));
	size_t i = 0;
	while (i + 1 < std::size(values) && p_name != REFERENCE_AOV_NAMES[i]) {
		i++;
	}
	return *values[i];
}

Status write_result(const ReferenceOptions &p_options, const PathTracerResult &p_result) {
	const std::vector<std::string> rgb = { "R", "G", "B" };
	std::vector<ExrLayer> layers = { { "", rgb, p_result.radiance }, { "variance", rgb, p_result.variance } };
	for (const std::string &aov : p_options.aovs) {
		const std::vector<std::string> channels = aov == "depth" ? std::vector<std::string>{ "Z" } : aov == "normal" ? std::vector<std::string>{ "X", "Y", "Z" }
																													 : rgb;
		layers.push_back({ aov, channels, layer_values(p_result, aov) });
	}
	return write_exr(p_options.output, p_result.width, p_result.height, layers);
}

void print_summary(const ReferenceOptions &p_options, const PathTracerResult &p_result) {
	double mean = 0, variance = 0;
	for (size_t i = 0; i < p_result.radiance.size(); i++) {
		mean += p_result.radiance[i];
		variance += p_result.variance[i];
	}
	const uint64_t pixels = uint64_t(p_result.width) * p_result.height;
	const double count = 3.0 * double(std::max<uint64_t>(pixels - p_result.untraced_pixels, 1));
	const std::string interval = p_result.spp < 2 ? " (interval unknown: too few samples)" : fmt::format(" +- {:.2g}", 1.96 * std::sqrt(variance) / count);
	std::printf("%s: %ux%u, %u samples a pixel in %.1f s, %.2f million rays a second, mean %.6g%s%s\n", p_options.output.c_str(), p_result.width, p_result.height, p_result.spp, p_result.seconds,
			double(p_result.rays) / p_result.seconds * 1e-6, mean / count, interval.c_str(), interrupted ? " (interrupted)" : "");
}

void warn(const PathTracerResult &p_result) {
	if (p_result.untraced_pixels > 0) {
		log_warning("{} of {} pixels have no sample: they are black, and left out of the mean", p_result.untraced_pixels, uint64_t(p_result.width) * p_result.height);
	}
	if (p_result.bad_samples > 0) {
		log_warning("{} samples were not finite and count as black", p_result.bad_samples);
	}
}

int report_throughput(PathTracer &r_tracer, const PathTracerSettings &p_settings) {
	const Result<PathTracerThroughput> result = r_tracer.measure_throughput(p_settings);
	if (!result) {
		return report(EXIT_DEVICE, result.error());
	}
	const PathTracerThroughput &rates = result.value();
	std::printf("path tracer %.3f, rtcIntersect1 alone %.3f million rays a second (%.1f %%), %llu rays replayed\n", rates.path_tracer_mrays_s, rates.bare_mrays_s,
			100.0 * rates.path_tracer_mrays_s / rates.bare_mrays_s, static_cast<unsigned long long>(rates.recorded_rays));
	return EXIT_OK;
}

int trace(const ReferenceOptions &p_options, PathTracer &r_tracer) {
	const bool progress = !p_options.quiet && isatty(STDERR_FILENO) == 1;
	PathTracerSettings settings = p_options.tracer;
	settings.cancel = &interrupted;
	Result<PathTracerResult> result = Error();
	{
		const InterruptGuard guard;
		result = r_tracer.render(settings, progress ? show_progress : std::function<void(const PathTracerProgress &)>());
	}
	if (progress) {
		std::fputs("\r\x1b[K", stderr);
	}
	if (!result) {
		return report(EXIT_DEVICE, result.error());
	}
	if (const Status status = write_result(p_options, result.value()); !status) {
		return report(EXIT_OUTPUT, status.error());
	}
	if (!p_options.quiet) {
		print_summary(p_options, result.value());
	}
	warn(result.value());
	return EXIT_OK;
}

int reference(const ReferenceOptions &p_options) {
	if (!p_options.report_throughput) {
		if (const Status status = check_writable(p_options.output); !status) {
			return report(EXIT_OUTPUT, status.error());
		}
	}
	register_modules();
	RenderingServer server(nullptr);
	RenderSession session(server);
	if (const Status status = session.load(p_options.scene.scene, p_options.scene.strict); !status) {
		return report(EXIT_BAD_INPUT, status.error());
	}
	for (const std::string &setting : p_options.scene.settings) {
		if (const Status status = apply_setting(session.root(), setting); !status) {
			return report(EXIT_USAGE, status.error());
		}
	}
	if (const Status status = session.open_viewport(p_options.scene); !status) {
		return report(EXIT_USAGE, status.error());
	}
	const RenderScene &scene = server.scenario_snapshot();
	const Viewport &viewport = *scene.viewports.get(session.viewport());
	const Result<std::unique_ptr<PathTracer>> tracer = PathTracer::create(scene, viewport.scenario, viewport.camera);
	if (!tracer) {
		return report(EXIT_DEVICE, tracer.error());
	}
	return p_options.report_throughput ? report_throughput(*tracer.value(), p_options.tracer) : trace(p_options, *tracer.value());
}

} // namespace

int reference_command(const std::vector<std::string> &p_args) {
	const Result<ReferenceOptions> options = parse_reference_options(p_args);
	if (!options) {
		return report(EXIT_USAGE, options.error());
	}
	return options.value().exit ? int(EXIT_OK) : reference(options.value());
}

} // namespace lucent
