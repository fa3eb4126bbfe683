// SPDX-License-Identifier: MIT
#include "modules/app/compare_options.h"

#include "modules/app/exit_codes.h"
#include "modules/app/number_check.h"
#include "modules/app/parse_error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lucent {

static std::string metric_list() {
	std::string list;
	for (const char *name : METRIC_NAMES) {
		list += std::string(list.empty() ? "" : ", ") + name;
	}
	for (const char *name : LEAK_METRIC_NAMES) {
		list += std::string(", ") + name;
	}
	return list;
}

static std::string footer() {
	return "B is the truth. Linear figures are of scene-referred light (PNG is decoded from sRGB); ssim and flip see what a display shows.\n"
		   "  rmse, nrmse, relmse, max_error  differences; nrmse is relative to B's mean, relmse to each pixel\n"
		   "  energy                          A's mean over B's\n"
		   "  over_lit, under_lit             share of pixels more than 0.05 above, below B\n"
		   "  ssim, flip, flip_p99            similarity (1: equal), perceived difference (0: equal)\n"
		   "\n"
		   "Examples:\n"
		   "  lucent compare ours.exr truth.exr --diff difference.png\n"
		   "  lucent compare ours.exr truth.exr --layer indirect_diffuse+indirect_specular:indirect --threshold nrmse=0.12\n"
		   "  lucent compare ours.exr truth.exr --mask floor.png --leak sealed_room.png --json\n"
		   "\n" +
			std::string(EXIT_CODES_HELP);
}

static Result<MetricBound> parse_bound(const std::string &p_text) {
	const size_t equals = p_text.find('=');
	const std::string name = p_text.substr(0, equals);
	const auto is_name = [&name](const char *p_name) { return name == p_name; };
	if (std::none_of(std::begin(METRIC_NAMES), std::end(METRIC_NAMES), is_name) && std::none_of(std::begin(LEAK_METRIC_NAMES), std::end(LEAK_METRIC_NAMES), is_name)) {
		return make_error("--threshold '{}': there is no figure '{}'; there are {}", p_text, name, metric_list());
	}
	const std::string number = equals == std::string::npos ? "" : p_text.substr(equals + 1);
	char *end = nullptr;
	const double value = std::strtod(number.c_str(), &end);
	if (number.empty() || *end != '\0' || !(value >= 0) || !std::isfinite(value)) {
		return make_error("--threshold '{}': expected {}=NUMBER, finite and not below 0", p_text, name);
	}
	return MetricBound{ name, value };
}

static Status check(const CompareOptions &p_options) {
	for (const MetricBound &bound : p_options.bounds) {
		if (bound.metric.starts_with("leak_") && p_options.leak_masks.empty()) {
			return make_error("--threshold {}: needs --leak", bound.metric);
		}
	}
	if (!p_options.difference.empty() && !p_options.difference.ends_with(".png")) {
		return make_error("--diff '{}': the name must end in .png", p_options.difference);
	}
	return Ok();
}

Result<CompareOptions> parse_compare_options(const std::vector<std::string> &p_args) {
	CompareOptions options;
	std::string layer;
	std::vector<std::string> bounds;
	const auto all = CLI::MultiOptionPolicy::TakeAll;
	CLI::App app("Says how far a picture is from the truth.", "lucent compare");
	app.add_option("A", options.image_a, "picture under test: .exr, .hdr, .png")->required();
	app.add_option("B", options.image_b, "the truth, of the same size")->required();
	app.add_option("--layer", layer, "compare EXR layers instead of the picture: names joined by + and -; after a colon those of B, where they differ")->type_name("LAYERS[:LAYERS]");
	app.add_option("--mask", options.masks, "also compare this region: a picture, bright where it counts; any number of times")->type_name("FILE")->expected(1)->multi_option_policy(all);
	app.add_option("--leak", options.leak_masks, "light of A in this region, which should be dark; any number of times")->type_name("FILE")->expected(1)->multi_option_policy(all);
	app.add_option("--threshold", bounds, "exit with 5 where a figure, in any region, is worse: " + metric_list())->type_name("FIGURE=VALUE")->expected(1)->multi_option_policy(all);
	app.add_option("--diff", options.difference, "write a false-colour difference: red where A is brighter, blue where darker")->type_name("FILE.png");
	app.add_option("--exposure", options.exposure, "factor before ssim, flip and --diff cut off at 1 [1]")->type_name("FACTOR")->check(number_between(1e-6, 1e6));
	app.add_flag("--json", options.json, "print the figures as JSON");
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
	const size_t colon = layer.find(':');
	options.layer_a = layer.substr(0, colon);
	options.layer_b = colon == std::string::npos ? layer : layer.substr(colon + 1);
	for (const std::string &text : bounds) {
		const Result<MetricBound> bound = parse_bound(text);
		if (!bound) {
			return bound.error();
		}
		options.bounds.push_back(bound.value());
	}
	if (const Status status = check(options); !status) {
		return status.error();
	}
	return options;
}

} // namespace lucent
