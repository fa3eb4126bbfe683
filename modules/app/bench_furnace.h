// SPDX-License-Identifier: MIT
#pragma once

#include "modules/app/bench_options.h"
#include "modules/bench/furnace.h"

#include <nlohmann/json_fwd.hpp>

namespace lucent {

// One scene with one albedo.
struct FurnaceRow {
	std::string name; // without folder and ending; a number follows where two scenes share it
	std::string path;
	float albedo = 0;
	FurnaceError error;
	MetricImage picture; // linear, of the last frame
	uint32_t frames = 0;
	bool settled = false;
	GiStats gi; // of the last frame
	double seconds = 0; // to load and draw
};

// Prints the table, writes furnace.json, furnace_NAME_ALBEDO.png for each row and furnace.html.
Status write_furnace(const BenchOptions &p_options, const std::vector<FurnaceRow> &p_rows, const nlohmann::ordered_json &p_conditions);

} // namespace lucent
