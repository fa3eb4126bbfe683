// SPDX-License-Identifier: MIT
#pragma once
// The command lines of `lucent bench`, checked.

#include "modules/app/render_options.h"

namespace lucent {

enum class BenchKind {
	QUALITY,
	FURNACE,
	SPEED,
	RESPONSE,
	TRUTH
};

struct BenchOptions {
	BenchKind kind = BenchKind::QUALITY;
	std::vector<std::string> names; // of scenes, without .tscn (furnace: files too); empty: all
	std::string scenes; // folder
	std::string truth; // folder
	std::string output; // folder
	std::string json; // another file than the folder's; empty: the folder's
	std::string device;
	std::string preset; // cpu or gpu; empty: by the device
	std::vector<std::string> settings; // --set
	std::vector<float> albedos; // of furnaces
	uint32_t width = 256;
	uint32_t height = 144;
	uint32_t frames = 0; // 0: by the device
	uint32_t grid = 0; // cells an axis; 0: the scene's
	uint32_t spp = 2048; // of truth
	bool validation = false;
	bool quiet = false;
	bool exit = false; // --help was printed
};

// p_args: the first is quality, furnace, speed, response or truth.
Result<BenchOptions> parse_bench_options(const std::vector<std::string> &p_args);

// The folder that holds bin/: where tests/ and doc/ are found. Ends in '/'.
std::string source_root();

// p_options.scenes' .tscn files: those named, or all, sorted. Names without folder and ending.
Result<std::vector<std::string>> bench_scenes(const BenchOptions &p_options);

} // namespace lucent
