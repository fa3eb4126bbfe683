// SPDX-License-Identifier: MIT
#pragma once

#include "modules/app/render_options.h"
#include "servers/rendering/rendering_server.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace lucent {

// Whether a pass belongs to GI by its name: those of the technique and of its world.
bool is_gi_pass(const std::string &p_name);

// GPU times over the frames of a run.
class PassTimes {
public:
	struct Pass {
		std::string name;
		double sum_ms = 0.0;
		double last_ms = 0.0; // in the last frame that had it
		uint32_t last_frame = 0;
	};

	void add(const std::vector<std::pair<std::string, double>> &p_frame);
	const std::vector<Pass> &passes() const { return entries; }
	uint32_t frames() const { return frame_count; }

private:
	std::vector<Pass> entries; // in order of appearance
	std::vector<std::pair<std::string, double>> last_frame;
	uint32_t frame_count = 0; // with times
};

// What --stats reports besides what server and device know.
struct RenderSummary {
	uint32_t frames = 0;
	bool converged = false;
	PassTimes passes;
	double load_s = 0.0; // wall clock: start to first frame
	double render_s = 0.0; // first frame to last picture
	double total_s = 0.0;
};

// Bytes by kind: the debug name's first part, and its first two ("sdfgi.cascade2.sdf" counts for "sdfgi" and for "sdfgi.cascade2").
nlohmann::ordered_json memory_json(const MemoryReport &p_report);

// What GI counted (GiStats), without its fetches.
nlohmann::ordered_json gi_json(const GiStats &p_gi);

// The JSON text of --stats.
std::string stats_json(const RenderOptions &p_options, const RenderSummary &p_summary, const RenderingServer &p_server);

} // namespace lucent
