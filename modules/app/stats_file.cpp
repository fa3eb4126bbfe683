// SPDX-License-Identifier: MIT
#include "modules/app/stats_file.h"

#include "servers/rendering/device/rendering_device.h"

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

namespace lucent {

using Json = nlohmann::ordered_json;

static Json device_json(const DeviceInfo &p_info) {
	static const char *const TYPES[] = { "discrete", "integrated", "virtual", "cpu", "other" };
	return {
		{ "name", p_info.name },
		{ "driver", p_info.driver },
		{ "api_version", p_info.api_version },
		{ "type", TYPES[size_t(p_info.type)] },
		{ "subgroup_size", p_info.subgroup_size },
	};
}

Json memory_json(const MemoryReport &p_report) {
	std::map<std::string, uint64_t> kinds;
	std::map<std::string, uint64_t> parts;
	for (const MemoryReport::Entry &entry : p_report.entries) {
		const size_t first = entry.name.find('.');
		kinds[entry.name.substr(0, first)] += entry.bytes;
		if (first != std::string::npos) {
			parts[entry.name.substr(0, entry.name.find('.', first + 1))] += entry.bytes;
		}
	}
	return { { "total_bytes", p_report.total_bytes }, { "kinds", kinds }, { "parts", parts } };
}

bool is_gi_pass(const std::string &p_name) {
	return p_name.find("sdfgi.") != std::string::npos || p_name.find("gi_world.") != std::string::npos; // "clear sdfgi.statistics" too
}

void PassTimes::add(const std::vector<std::pair<std::string, double>> &p_frame) {
	// A frame that the server waited for is told again until the next has finished.
	if (p_frame == last_frame) {
		return;
	}
	last_frame = p_frame;
	frame_count += p_frame.empty() ? 0 : 1;
	for (const auto &[name, gpu_ms] : p_frame) {
		auto found = std::find_if(entries.begin(), entries.end(), [&](const Pass &p_pass) { return p_pass.name == name; });
		if (found == entries.end()) {
			found = entries.insert(entries.end(), Pass{ name });
		}
		found->sum_ms += gpu_ms;
		found->last_ms = gpu_ms + (found->last_frame == frame_count ? found->last_ms : 0.0); // cascades repeat passes
		found->last_frame = frame_count;
	}
}

// mean_ms: over all frames, also those without the pass.
static Json times_json(const PassTimes &p_times) {
	Json passes = Json::array();
	double total_ms = 0.0;
	double gi_ms = 0.0;
	for (const PassTimes::Pass &pass : p_times.passes()) {
		const double mean_ms = pass.sum_ms / std::max(p_times.frames(), 1u);
		passes.push_back({ { "name", pass.name }, { "mean_ms", mean_ms }, { "last_ms", pass.last_ms } });
		total_ms += mean_ms;
		gi_ms += is_gi_pass(pass.name) ? mean_ms : 0.0;
	}
	return { { "frames", p_times.frames() }, { "total", total_ms }, { "gi", gi_ms }, { "passes", passes } };
}

Json gi_json(const GiStats &p_gi) {
	constexpr const char *KINDS[] = { "sky", "record", "neighbour", "nothing", "back", "lost_cell" };
	Json gather_rays = Json::object();
	for (size_t i = 0; i < p_gi.gather_rays.size(); i++) {
		gather_rays[KINDS[i]] = p_gi.gather_rays[i];
	}
	return {
		{ "rays", p_gi.rays },
		{ "surface_cells", p_gi.surface_cells },
		{ "surface_records", p_gi.surface_records },
		{ "listed_triangles", p_gi.listed_triangles },
		{ "plain_cells", p_gi.plain_cells },
		{ "unlisted_cells", p_gi.unlisted_cells },
		{ "gather_rays", gather_rays },
		{ "startless_pixels", p_gi.startless_pixels },
		{ "recordless_pixels", p_gi.recordless_pixels },
		{ "probes", p_gi.probes },
		{ "bytes", p_gi.bytes },
	};
}

std::string stats_json(const RenderOptions &p_options, const RenderSummary &p_summary, const RenderingServer &p_server) {
	const FrameStats frame = p_server.get_frame_stats();
	const RenderingDevice &device = *p_server.get_rendering_device();
	const Json stats = {
		{ "scene", p_options.scene },
		{ "image_size", { p_options.width, p_options.height } },
		{ "frames", p_summary.frames },
		{ "converged", p_summary.converged },
		{ "wall_s", { { "load", p_summary.load_s }, { "render", p_summary.render_s }, { "total", p_summary.total_s } } },
		{ "device", device_json(device.info()) },
		{ "gpu_ms", times_json(p_summary.passes) },
		{ "memory", memory_json(device.memory_report()) },
		{ "draws", frame.draws },
		{ "triangles", frame.triangles },
		{ "lights", frame.lights },
		{ "gi", gi_json(frame.gi) },
	};
	return stats.dump(1, '\t', false, Json::error_handler_t::replace) + "\n";
}

} // namespace lucent
