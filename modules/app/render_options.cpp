// SPDX-License-Identifier: MIT
#include "modules/app/render_options.h"

#include "modules/app/exit_codes.h"
#include "modules/app/parse_error.h"
#include "modules/app/suggestion.h"
#include "servers/rendering/rendering_server.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace lucent {

static std::string join(const std::vector<std::string> &p_words, const char *p_between) {
	std::string text;
	for (const std::string &word : p_words) {
		text += (text.empty() ? "" : p_between) + word;
	}
	return text;
}

static std::vector<std::string> aov_names() {
	return { std::begin(AOV_NAMES), std::end(AOV_NAMES) };
}

static std::vector<std::string> debug_views() {
	return RenderingServer(nullptr).get_debug_views();
}

static std::string footer() {
	return "Examples:\n"
		   "  lucent render doc/samples/cornell/cornell.tscn -o cornell.png\n"
		   "  lucent render model.glb -o model.png -o model.exr --size 1920x1080 --frames 256\n"
		   "  lucent render room.tscn -o room.exr --aov direct,indirect_diffuse --stats room.json\n"
		   "  lucent render room.tscn -o off.png --set 'WorldEnvironment:environment:sdfgi_enabled=false'\n"
		   "  lucent render room.tscn -o red.png --set 'Lamp:light_color=Color(1, 0, 0, 1)' --camera Corner\n"
		   "\n" +
			std::string(EXIT_CODES_HELP);
}

Status parse_size(const std::string &p_text, RenderOptions &r_options) {
	const size_t cross = p_text.find('x');
	const char *end = p_text.data() + p_text.size();
	if (cross != std::string::npos) {
		uint64_t width = 0;
		uint64_t height = 0;
		const auto [width_end, width_status] = std::from_chars(p_text.data(), p_text.data() + cross, width);
		const auto [height_end, height_status] = std::from_chars(p_text.data() + cross + 1, end, height);
		if (width_status == std::errc() && height_status == std::errc() && width_end == p_text.data() + cross && height_end == end) {
			if (width < 1 || height < 1 || width > MAX_IMAGE_SIZE || height > MAX_IMAGE_SIZE) {
				return make_error("--size {}: width and height must be 1 to {}", p_text, MAX_IMAGE_SIZE);
			}
			r_options.width = uint32_t(width);
			r_options.height = uint32_t(height);
			return Ok();
		}
	}
	return make_error("--size '{}': expected WIDTHxHEIGHT, for example 1280x720", p_text);
}

static Result<Ok> check_outputs(const RenderOptions &p_options) {
	if (p_options.outputs.empty()) {
		return make_error("nothing to write: name at least one picture with -o (.png or .exr)");
	}
	bool has_exr = false;
	for (const std::string &path : p_options.outputs) {
		std::string lower = path;
		std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
		if (!lower.ends_with(".png") && !lower.ends_with(".exr")) {
			return make_error("-o '{}': the name must end in .png (display) or .exr (linear)", path);
		}
		has_exr = has_exr || lower.ends_with(".exr");
		if (std::count(p_options.outputs.begin(), p_options.outputs.end(), path) > 1) {
			return make_error("-o '{}' is given twice", path);
		}
	}
	if (!p_options.aovs.empty() && !has_exr) {
		return make_error("--aov adds layers to an .exr, but no -o names one");
	}
	return Ok();
}

static Result<Ok> check_aovs(RenderOptions &r_options) {
	const std::vector<std::string> names = aov_names();
	if (std::find(r_options.aovs.begin(), r_options.aovs.end(), "all") != r_options.aovs.end()) {
		r_options.aovs = names;
	}
	for (const std::string &aov : r_options.aovs) {
		if (std::find(names.begin(), names.end(), aov) == names.end()) {
			return make_error("--aov '{}' is unknown{}; there are {} and all", aov, suggestion(aov, names), join(names, ", "));
		}
	}
	std::sort(r_options.aovs.begin(), r_options.aovs.end());
	r_options.aovs.erase(std::unique(r_options.aovs.begin(), r_options.aovs.end()), r_options.aovs.end());
	return Ok();
}

static Result<Ok> check_debug_view(const RenderOptions &p_options) {
	const std::vector<std::string> views = debug_views();
	if (!p_options.debug_view.empty() && std::find(views.begin(), views.end(), p_options.debug_view) == views.end()) {
		return make_error("--debug-view '{}' is unknown{}; there are {}", p_options.debug_view, suggestion(p_options.debug_view, views), join(views, ", "));
	}
	return Ok();
}

static void declare_options(CLI::App &r_app, RenderOptions &r_options, std::string &r_size) {
	const auto last = CLI::MultiOptionPolicy::TakeLast;
	r_app.add_option("SCENE", r_options.scene, "a .tscn, .glb or .gltf file. What it lacks comes from Godot's editor preview: a sun, a procedural sky "
											   "(SDFGI on), and a camera that frames everything")
			->required();
	r_app.add_option("-o,--output", r_options.outputs, "picture to write, any number of times: .png is tone-mapped 8-bit sRGB, .exr is linear light before exposure and tone mapping")
			->type_name("FILE")
			->expected(1)
			->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
	r_app.add_option("--size", r_size, "picture size [1280x720]")->type_name("WxH")->multi_option_policy(last);
	r_app.add_option("--frames", r_options.frames, fmt::format("frames to draw [until GI has converged, at most {}; says how many that took]", MAX_FRAMES_TO_CONVERGE))
			->check(CLI::Range(1u, 1000000u))
			->type_name("N")
			->multi_option_policy(last);
	r_app.add_option("--camera", r_options.camera, "look through this camera: a node's name or path")->type_name("NAME")->multi_option_policy(last);
	r_app.add_option("--set", r_options.settings, "change a property before drawing, any number of times; the value is written as in a .tscn")
			->type_name("'NODE:PROPERTY[:SUB]=VALUE'")
			->expected(1)
			->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
	r_app.add_option("--aov", r_options.aovs, "layers to add to .exr files, separated by commas: " + join(aov_names(), ", ") + ", or all")
			->type_name("LAYER,…")
			->expected(1)
			->delimiter(',')
			->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
	r_app.add_option("--stats", r_options.stats, "write device, times of each pass, memory by kind and counters as JSON")->type_name("FILE.json")->multi_option_policy(last);
	r_app.add_option("--debug-view", r_options.debug_view, "draw a view into GI instead: " + join(debug_views(), ", "))->type_name("NAME")->multi_option_policy(last);
	r_app.add_option("--device", r_options.device, "index (as in lucent info) or part of the name of the Vulkan device")->type_name("DEVICE")->multi_option_policy(last);
	r_app.add_option("--reload-shaders", r_options.reload_shaders, "source root: recompile changed .glsl files between frames (needs glslangValidator)")
			->type_name("DIR")
			->multi_option_policy(last);
	r_app.add_flag("--validation", r_options.validation, "turn Vulkan's validation layers on");
	r_app.add_flag("--strict", r_options.strict, "end with exit code 3 where a part of the scene can't be read, in place of drawing the rest");
	r_app.add_flag("--quiet", r_options.quiet, "print errors and warnings only");
	r_app.add_flag("--verbose", r_options.verbose, "say more on stderr");
}

Result<ParsedOptions> parse_render_options(const std::vector<std::string> &p_args) {
	ParsedOptions parsed;
	RenderOptions &options = parsed.options;
	std::string size;
	CLI::App app("Draws a scene into pictures, without a window.", "lucent render");
	declare_options(app, options, size);
	app.footer(footer());
	try {
		app.parse(std::vector<std::string>(p_args.rbegin(), p_args.rend())); // CLI11 takes them last first
	} catch (const CLI::CallForHelp &) {
		std::fputs(app.help().c_str(), stdout);
		parsed.exit = true;
		return parsed;
	} catch (const CLI::ParseError &error) {
		return make_error("{}", parse_error_text(app, error));
	}
	if (!size.empty()) {
		if (Result<Ok> status = parse_size(size, options); !status) {
			return status.error();
		}
	}
	for (const Result<Ok> &status : { check_aovs(options), check_outputs(options), check_debug_view(options) }) {
		if (!status) {
			return status.error();
		}
	}
	return parsed;
}

} // namespace lucent
