// SPDX-License-Identifier: MIT
#pragma once

#include "modules/app/bench_options.h"
#include "modules/bench/light_error.h"

#include <nlohmann/json_fwd.hpp>

namespace lucent {

struct QualityRow {
	std::string name;
	TruthImage truth;
	MetricImage light; // ours, of the last frame
	LightError error; // of it
	std::vector<std::pair<uint32_t, double>> curve; // frame, nrmse (sealed: largest leak)
	uint32_t frames = 0;
	bool settled = false;
	double gi_ms = 0; // median of GI's GPU time over the frames
	uint64_t gi_bytes = 0;
	double seconds = 0;
};

// Prints the table, writes quality.json, NAME.png for each scene and report.html.
Status write_quality(const BenchOptions &p_options, const std::vector<QualityRow> &p_rows, const nlohmann::ordered_json &p_conditions);

} // namespace lucent
