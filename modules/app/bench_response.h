// SPDX-License-Identifier: MIT
#pragma once

#include "modules/app/bench_options.h"
#include "modules/bench/statistics.h"

#include <nlohmann/json_fwd.hpp>

namespace lucent {

inline constexpr uint32_t REPEAT_FRAMES = 20; // after which two runs are compared

struct ResponsePreset {
	uint32_t width = 256;
	uint32_t height = 144;
	uint32_t grid = 128;
	uint32_t frames_to_converge = 0; // 0: the default
	uint32_t settle_frames = 600; // at most
	uint32_t frames = 256; // after the change; the last counts as where it ends
};

struct ResponseRow {
	std::string name;
	std::string scene;
	bool settled = false; // before the change
	uint32_t settle_frames = 0;
	double affected = 0; // share of the pixels
	std::vector<double> curve; // by frame: how far their luminance has moved to where it ends, on average
	Response response;
	bool ended = false; // the light had settled again in the last frame: that is where it ends
	double rest_difference = 0; // largest between frames before the change
	uint64_t rest_rays = 0;
};

struct ScrollResult {
	bool settled = false;
	std::vector<double> p99_steps, max_steps; // of 255, against the picture before, by frame
};

struct ResponseResult {
	ResponsePreset preset;
	std::vector<ResponseRow> rows;
	ScrollResult scroll;
	bool repeats = false; // two runs on new devices gave the same bits

	// Where a scene settled nothing moves and no ray is traced; and some scene did.
	bool rests() const;
};

// Prints the tables, writes response.json and response.html.
Status write_response(const BenchOptions &p_options, const ResponseResult &p_result, const nlohmann::ordered_json &p_conditions);

} // namespace lucent
