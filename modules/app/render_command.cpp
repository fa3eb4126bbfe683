// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_driver.h"
#include "modules/app/commands.h"
#include "modules/app/exit_codes.h"
#include "modules/app/output_files.h"
#include "modules/app/property_setting.h"
#include "modules/app/register_modules.h"
#include "modules/app/render_options.h"
#include "modules/app/render_session.h"
#include "modules/app/stats_file.h"
#include "servers/core/file_io.h"
#include "servers/rendering/device/rendering_device.h"

#include <chrono>
#include <cstdio>
#include <unistd.h>

namespace lucent {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point p_start) {
	return std::chrono::duration<double>(Clock::now() - p_start).count();
}

// One line on a terminal, rewritten; nothing in a pipe.
class ProgressLine {
public:
	explicit ProgressLine(bool p_wanted) :
			shown(p_wanted && isatty(STDERR_FILENO) == 1) {}
	~ProgressLine() { clear(); }

	void update(uint32_t p_frame, uint32_t p_frames) {
		if (shown && seconds_since(last) > 0.1) {
			last = Clock::now();
			std::fprintf(stderr, "\r\x1b[Kframe %u of %s%u", p_frame, p_frames == 0 ? "at most " : "", p_frames == 0 ? MAX_FRAMES_TO_CONVERGE : p_frames);
			std::fflush(stderr);
			dirty = true;
		}
	}
	void clear() {
		if (dirty) {
			std::fputs("\r\x1b[K", stderr);
			dirty = false;
		}
	}

private:
	bool shown;
	bool dirty = false;
	Clock::time_point last;
};

int report(ExitCode p_code, const Error &p_error) {
	log_error("{}", p_error.message);
	return p_code;
}

// Draws until done; the summary says how far it came.
void draw_frames(RenderSession &r_session, RenderingServer &r_server, RenderingDevice &r_device, const RenderOptions &p_options, RenderSummary &r_summary) {
	ProgressLine progress(!p_options.quiet);
	const uint32_t limit = p_options.frames != 0 ? p_options.frames : MAX_FRAMES_TO_CONVERGE;
	// Only the last picture is kept, and light doesn't depend on pictures: the others are drawn only where somebody measures frames.
	const bool every_picture = !p_options.stats.empty();
	bool pictured = false;
	while (r_summary.frames < limit) {
		if (!p_options.reload_shaders.empty()) {
			r_device.reload_shaders(p_options.reload_shaders);
		}
		pictured = every_picture || r_summary.frames + 1 == limit;
		r_server.viewport_set_picture_enabled(r_session.viewport(), pictured);
		r_session.draw_frame();
		r_summary.frames++;
		const FrameStats frame = r_server.get_frame_stats();
		r_summary.passes.add(frame.pass_ms);
		r_summary.converged = frame.gi.converged || frame.gi.frames == 0; // without GI one frame is all
		if (p_options.frames == 0 && r_summary.converged) {
			break;
		}
		progress.update(r_summary.frames, p_options.frames);
	}
	if (!pictured) {
		r_server.viewport_set_picture_enabled(r_session.viewport(), true);
		r_session.draw_frame();
	}
}

void print_summary(const RenderOptions &p_options, const RenderSummary &p_summary, const RenderingDevice &p_device) {
	std::string names;
	for (const std::string &output : p_options.outputs) {
		names += (names.empty() ? "" : ", ") + output;
	}
	const char *how = p_summary.converged ? "converged" : "not converged";
	std::printf("%s: %ux%u, %u frame%s (%s) in %.1f s on %s\n", names.c_str(), p_options.width, p_options.height, p_summary.frames, p_summary.frames == 1 ? "" : "s", how, p_summary.total_s, p_device.info().name.c_str());
}

int check_outputs_writable(const RenderOptions &p_options) {
	for (const std::string &path : p_options.outputs) {
		if (const Status status = check_writable(path); !status) {
			return report(EXIT_OUTPUT, status.error());
		}
	}
	if (!p_options.stats.empty()) {
		if (const Status status = check_writable(p_options.stats); !status) {
			return report(EXIT_OUTPUT, status.error());
		}
	}
	return EXIT_OK;
}

int write_results(RenderSession &r_session, RenderingServer &r_server, const RenderOptions &p_options, RenderSummary &r_summary, Clock::time_point p_drawn, Clock::time_point p_start) {
	if (const Status status = write_pictures(r_server, r_session.viewport(), p_options); !status) {
		return report(EXIT_OUTPUT, status.error());
	}
	r_summary.render_s = seconds_since(p_drawn);
	r_summary.total_s = seconds_since(p_start);
	if (!p_options.stats.empty()) {
		const std::string text = stats_json(p_options, r_summary, r_server);
		if (const Status status = write_file(p_options.stats, std::as_bytes(std::span(text))); !status) {
			return report(EXIT_OUTPUT, status.error());
		}
	}
	return EXIT_OK;
}

int render(const RenderOptions &p_options) {
	const Clock::time_point start = Clock::now();
	set_log_verbose(p_options.verbose);
	if (const int code = check_outputs_writable(p_options); code != EXIT_OK) {
		return code;
	}
	Result<std::unique_ptr<RenderingDeviceDriver>> driver = create_vulkan_driver({ p_options.device, p_options.validation });
	if (!driver) {
		return report(EXIT_DEVICE, driver.error());
	}
	Result<std::unique_ptr<RenderingDevice>> device = RenderingDevice::create(driver.take());
	if (!device) {
		return report(EXIT_DEVICE, device.error());
	}
	const uint32_t largest = device.value()->info().max_texture_2d_texels;
	if (p_options.width > largest || p_options.height > largest) {
		return report(EXIT_USAGE, make_error("--size {}x{}: this device's pictures have at most {} pixels an axis", p_options.width, p_options.height, largest));
	}
	register_modules();
	RenderingServer server(device.value().get());
	RenderSession session(server);
	if (const Status status = session.load(p_options.scene, p_options.strict); !status) {
		return report(EXIT_BAD_INPUT, status.error());
	}
	for (const std::string &setting : p_options.settings) {
		if (const Status status = apply_setting(session.root(), setting); !status) {
			return report(EXIT_USAGE, status.error());
		}
	}
	if (const Status status = session.open_viewport(p_options); !status) {
		return report(EXIT_USAGE, status.error());
	}
	RenderSummary summary;
	summary.load_s = seconds_since(start);
	const Clock::time_point drawn = Clock::now();
	draw_frames(session, server, *device.value(), p_options, summary);
	const int code = write_results(session, server, p_options, summary, drawn, start);
	if (code == EXIT_OK && !p_options.quiet) {
		print_summary(p_options, summary, *device.value());
	}
	return code;
}

} // namespace

int render_command(const std::vector<std::string> &p_args) {
	const Result<ParsedOptions> parsed = parse_render_options(p_args);
	if (!parsed) {
		return report(EXIT_USAGE, parsed.error());
	}
	return parsed.value().exit ? int(EXIT_OK) : render(parsed.value().options);
}

} // namespace lucent
