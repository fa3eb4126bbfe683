// SPDX-License-Identifier: MIT
#include "modules/app/reference_options.h"

#include "modules/app/exit_codes.h"
#include "modules/app/number_check.h"
#include "modules/app/parse_error.h"
#include "modules/app/suggestion.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>

namespace lucent {

static std::vector<std::string> aov_names() {
	return { std::begin(REFERENCE_AOV_NAMES), std::end(REFERENCE_AOV_NAMES) };
}

static std::string aov_list() {
	std::string list;
	for (const std::string &name : aov_names()) {
		list += (list.empty() ? "" : ", ") + name;
	}
	return list;
}

static std::string footer() {
	return "The picture is linear, scene-referred light. Layer 'variance' is that of each mean: +- 1.96 sqrt(variance) holds the truth 95 times\n"
		   "in 100; it is 0, and the interval unknown, where a pixel has one sample. Without --time one seed gives one picture, whatever\n"
		   "the number of threads. Ctrl-C writes what there is.\n"
		   "\n"
		   "  direct      light of lamps that the first surface reflects\n"
		   "  indirect    everything else that it reflects: light of emissive surfaces and of the sky, seen by it or after bounces\n"
		   "  emission    what the first surface emits\n"
		   "  background  sky that the camera sees. The picture is the sum of these four\n"
		   "\n"
		   "Examples:\n"
		   "  lucent reference doc/samples/cornell/cornell.tscn -o truth.exr --size 256x144 --spp 1024\n"
		   "  lucent reference room.tscn -o truth.exr --spp 65536 --time 60 --aov direct,indirect\n"
		   "\n" +
			std::string(EXIT_CODES_HELP);
}

static Status check_aovs(ReferenceOptions &r_options) {
	const std::vector<std::string> names = aov_names();
	if (std::find(r_options.aovs.begin(), r_options.aovs.end(), "all") != r_options.aovs.end()) {
		r_options.aovs = names;
	}
	for (const std::string &aov : r_options.aovs) {
		if (std::find(names.begin(), names.end(), aov) == names.end()) {
			return make_error("--aov '{}' is unknown{}; there are {} and all", aov, suggestion(aov, names), aov_list());
		}
	}
	std::sort(r_options.aovs.begin(), r_options.aovs.end());
	r_options.aovs.erase(std::unique(r_options.aovs.begin(), r_options.aovs.end()), r_options.aovs.end());
	return Ok();
}

static void declare_options(CLI::App &r_app, ReferenceOptions &r_options, std::string &r_size) {
	const auto last = CLI::MultiOptionPolicy::TakeLast;
	const auto all = CLI::MultiOptionPolicy::TakeAll;
	PathTracerSettings &tracer = r_options.tracer;
	r_app.add_option("SCENE", r_options.scene.scene, "a .tscn, .glb or .gltf file, as for lucent render")->required();
	r_app.add_option("-o,--output", r_options.output, "picture to write: .exr")->type_name("FILE.exr")->multi_option_policy(last);
	r_app.add_option("--size", r_size, "picture size [1280x720]")->type_name("WxH")->multi_option_policy(last);
	r_app.add_option("--spp", tracer.spp, "samples a pixel [64]")->type_name("N")->check(CLI::Range(1u, 1u << 24))->multi_option_policy(last);
	r_app.add_option("--time", tracer.time_limit_s, "stop after about this many seconds; one sample of every pixel is made in any case")->type_name("SECONDS")->check(number_between(1e-3, 1e9))->multi_option_policy(last);
	r_app.add_option("--seed", tracer.seed, "of the random numbers [0]")->type_name("N")->check(CLI::Range(0u, std::numeric_limits<uint32_t>::max()))->multi_option_policy(last);
	r_app.add_option("--threads", tracer.threads, "threads [as many as the machine has]")->type_name("N")->check(CLI::Range(0u, 1024u))->multi_option_policy(last);
	r_app.add_option("--filter", r_options.filter, "pixel filter: box, or blackman-harris (1.5 pixels wide) [box]")->type_name("NAME")->multi_option_policy(last);
	r_app.add_option("--aov", r_options.aovs, "layers to add, separated by commas: " + aov_list() + ", or all")->type_name("LAYER,…")->expected(1)->delimiter(',')->multi_option_policy(all);
	r_app.add_option("--camera", r_options.scene.camera, "look through this camera: a node's name or path")->type_name("NAME")->multi_option_policy(last);
	r_app.add_option("--set", r_options.scene.settings, "change a property first, any number of times; the value is written as in a .tscn")
			->type_name("'NODE:PROPERTY[:SUB]=VALUE'")
			->expected(1)
			->multi_option_policy(all);
	r_app.add_flag("--report-throughput", r_options.report_throughput, "print millions of rays a second beside bare rtcIntersect1's on the same rays, write nothing");
	r_app.add_flag("--strict", r_options.scene.strict, "end with exit code 3 where a part of the scene can't be read, in place of tracing the rest");
	r_app.add_flag("--quiet", r_options.quiet, "print errors and warnings only");
}

Result<ReferenceOptions> parse_reference_options(const std::vector<std::string> &p_args) {
	ReferenceOptions options;
	std::string size;
	CLI::App app("Path-traces a scene: the truth for what lucent render draws.", "lucent reference");
	declare_options(app, options, size);
	app.footer(footer());
	try {
		app.parse(std::vector<std::string>(p_args.rbegin(), p_args.rend())); // CLI11 takes them last first
	} catch (const CLI::CallForHelp &) {
		std::fputs(app.help().c_str(), stdout);
		options.exit = true;
		return options;
	} catch (const CLI::ParseError &error) {
		return make_error("{}", parse_error_text(app, error));
	}
	if (!size.empty()) {
		if (const Status status = parse_size(size, options.scene); !status) {
			return status.error();
		}
	}
	if (const Status status = check_aovs(options); !status) {
		return status.error();
	}
	if (!options.report_throughput && !options.output.ends_with(".exr")) {
		return make_error("-o '{}': name a picture that ends in .exr", options.output);
	}
	if (options.filter != "box" && options.filter != "blackman-harris") {
		return make_error("--filter '{}' is unknown{}; there are box and blackman-harris", options.filter, suggestion(options.filter, { "box", "blackman-harris" }));
	}
	options.tracer.filter = options.filter == "box" ? PixelFilter::BOX : PixelFilter::BLACKMAN_HARRIS;
	options.tracer.width = options.scene.width;
	options.tracer.height = options.scene.height;
	options.tracer.aov = !options.aovs.empty();
	return options;
}

} // namespace lucent
