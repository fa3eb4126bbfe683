// SPDX-License-Identifier: MIT
#include "modules/app/bench_options.h"

#include "modules/app/exit_codes.h"
#include "modules/app/parse_error.h"
#include "modules/app/suggestion.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace lucent {

namespace {

struct Kind {
	const char *name;
	BenchKind kind;
	const char *description;
};
constexpr Kind KINDS[] = {
	{ "quality", BenchKind::QUALITY, "Renders the scenes with a path-traced truth and says how far SDFGI is from it: a table, quality.json, pictures, report.html." },
	{ "furnace", BenchKind::FURNACE, "Draws scenes in which every pixel must be 1: each material reflects RHO and emits 1 - RHO under a sky of 1. Says how far they are from it: a table, furnace.json, maps, furnace.html. Textures go, so alpha-masked surfaces are whole." },
	{ "speed", BenchKind::SPEED, "Measures GPU milliseconds of each pass, memory and counts, at rest, moving and changing, and how they scale: a table, speed.json, speed.html." },
	{ "response", BenchKind::RESPONSE, "Measures how fast light follows a change, and what moves at rest: a table, response.json, response.html." },
	{ "truth", BenchKind::TRUTH, "Path-traces the truth of the quality scenes anew (minutes each)." },
};

std::string footer() {
	return "Milliseconds of a CPU device say nothing about a GPU: compare ratios and counts there.\n"
		   "\n" +
			std::string(EXIT_CODES_HELP);
}

void declare_options(CLI::App &r_app, BenchOptions &r_options, std::string &r_size) {
	const auto last = CLI::MultiOptionPolicy::TakeLast;
	const bool furnace = r_options.kind == BenchKind::FURNACE;
	const bool quality = r_options.kind == BenchKind::QUALITY;
	if (furnace || quality || r_options.kind == BenchKind::TRUTH) {
		r_app.add_option("SCENE", r_options.names, furnace ? "names of scenes, or .tscn, .gltf and .glb files [all of the folder]" : "names of scenes [all]");
		r_app.add_option("--scenes", r_options.scenes, "folder of the scenes [tests/data/scenes]")->type_name("DIR")->multi_option_policy(last);
	}
	if (quality || r_options.kind == BenchKind::TRUTH) {
		r_app.add_option("--truth", r_options.truth, "folder of the truth [tests/data/truth]")->type_name("DIR")->multi_option_policy(last);
	}
	r_app.add_flag("--quiet", r_options.quiet, "print errors, warnings and the table only");
	if (r_options.kind == BenchKind::TRUTH) {
		r_app.add_option("--spp", r_options.spp, "samples a pixel, in eight runs of different seeds [2048]")->check(CLI::Range(16u, 1u << 20))->type_name("N")->multi_option_policy(last);
		return;
	}
	r_app.add_option("-o,--output", r_options.output, "folder for the results [bench]")->type_name("DIR")->multi_option_policy(last);
	r_app.add_option("--json", r_options.json, "write the figures here, and no other file")->type_name("FILE.json")->multi_option_policy(last);
	r_app.add_option("--device", r_options.device, "index (as in lucent info) or part of the name of the Vulkan device")->type_name("DEVICE")->multi_option_policy(last);
	r_app.add_option("--frames", r_options.frames, quality || furnace ? "frames to draw at most; fewer where the light has settled before [76 on a CPU device, else 512]" : "frames in each state [few on a CPU device, else 240]")
			->check(CLI::Range(1u, 1000000u))
			->type_name("N")
			->multi_option_policy(last);
	r_app.add_option("--grid", r_options.grid, furnace ? "cells an axis of each cascade [the scene's]" : "cells an axis of each cascade [64 on a CPU device, else 128]")->check(CLI::IsMember({ 64u, 128u, 256u }))->type_name("N")->multi_option_policy(last);
	if (quality) {
		r_app.add_option("--size", r_size, "picture size: that of the truth or half of it [256x144]")->type_name("WxH")->multi_option_policy(last);
	}
	if (furnace) {
		r_app.add_option("--size", r_size, "picture size [256x144]")->type_name("WxH")->multi_option_policy(last);
		r_app.add_option("--albedo", r_options.albedos, "share of the light that surfaces reflect, any number of times [0.5 and 0.9]")->check(CLI::Range(0.0f, 0.99f))->type_name("RHO")->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
	}
	if (!quality && !furnace) {
		r_app.add_option("--preset", r_options.preset, "cpu (small, counts first) or gpu (everything) [by the device]")->check(CLI::IsMember({ "cpu", "gpu" }))->type_name("NAME")->multi_option_policy(last);
	}
	r_app.add_option("--set", r_options.settings, "change a property of every scene before drawing, any number of times; the value is written as in a .tscn")
			->type_name("'NODE:PROPERTY[:SUB]=VALUE'")
			->expected(1)
			->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
	r_app.add_flag("--validation", r_options.validation, "turn Vulkan's validation layers on");
}

void print_help() {
	std::fputs("usage: lucent bench quality|furnace|speed|response|truth [OPTIONS]\n\n", stdout);
	for (const Kind &kind : KINDS) {
		std::printf("  %-9s %s\n", kind.name, kind.description);
	}
	std::fputs("\n'lucent bench quality --help' and so on say more.\n", stdout);
}

Result<const Kind *> find_kind(const std::string &p_name) {
	std::vector<std::string> names;
	for (const Kind &kind : KINDS) {
		if (p_name == kind.name) {
			return &kind;
		}
		names.push_back(kind.name);
	}
	return make_error("there is no bench '{}'{}; there are quality, furnace, speed, response and truth", p_name, suggestion(p_name, names));
}

void fill_defaults(BenchOptions &r_options) {
	const auto fill = [](std::string &r_value, const std::string &p_default) { r_value = r_value.empty() ? p_default : r_value; };
	fill(r_options.scenes, source_root() + "tests/data/scenes");
	fill(r_options.truth, source_root() + "tests/data/truth");
	fill(r_options.output, "bench");
	if (r_options.albedos.empty()) {
		r_options.albedos = { 0.5f, 0.9f };
	}
	for (std::string *folder : { &r_options.scenes, &r_options.truth, &r_options.output }) {
		if (!folder->ends_with('/')) {
			*folder += '/';
		}
	}
}

} // namespace

std::string source_root() {
	std::error_code error;
	const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
	return error ? "./" : program.parent_path().parent_path().string() + "/";
}

Result<BenchOptions> parse_bench_options(const std::vector<std::string> &p_args) {
	BenchOptions options;
	if (p_args.empty() || p_args[0] == "--help" || p_args[0] == "-h") {
		if (p_args.empty()) {
			return make_error("expected quality, furnace, speed, response or truth ('lucent bench --help' explains)");
		}
		print_help();
		options.exit = true;
		return options;
	}
	const Result<const Kind *> kind = find_kind(p_args[0]);
	if (!kind) {
		return kind.error();
	}
	options.kind = kind.value()->kind;
	std::string size;
	CLI::App app(kind.value()->description, std::string("lucent bench ") + kind.value()->name);
	declare_options(app, options, size);
	app.footer(footer());
	try {
		app.parse(std::vector<std::string>(p_args.rbegin(), p_args.rend() - 1)); // CLI11 takes them last first
	} catch (const CLI::CallForHelp &) {
		std::fputs(app.help().c_str(), stdout);
		options.exit = true;
		return options;
	} catch (const CLI::ParseError &error) {
		return make_error("{}", parse_error_text(app, error));
	}
	if (!size.empty()) {
		RenderOptions sized;
		if (const Status status = parse_size(size, sized); !status) {
			return status.error();
		}
		options.width = sized.width;
		options.height = sized.height;
	}
	fill_defaults(options);
	return options;
}

Result<std::vector<std::string>> bench_scenes(const BenchOptions &p_options) {
	std::vector<std::string> names;
	std::error_code error;
	for (const auto &entry : std::filesystem::directory_iterator(p_options.scenes, error)) {
		if (entry.path().extension() == ".tscn") {
			names.push_back(entry.path().stem().string());
		}
	}
	if (error || names.empty()) {
		return make_error("{}: expected a folder with .tscn scenes{}", p_options.scenes, error ? " (" + error.message() + ")" : "");
	}
	std::sort(names.begin(), names.end());
	for (const std::string &name : p_options.names) {
		if (std::find(names.begin(), names.end(), name) == names.end()) {
			return make_error("{} has no scene '{}'{}", p_options.scenes, name, suggestion(name, names));
		}
	}
	return p_options.names.empty() ? names : p_options.names;
}

} // namespace lucent
