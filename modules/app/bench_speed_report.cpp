// SPDX-License-Identifier: MIT
#include "modules/app/bench_results.h"
#include "modules/app/bench_speed.h"
#include "modules/app/stats_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace lucent {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char *YARDSTICK = "light every frame"; // the state that others are compared with

std::string ms(double p_value) {
	return fmt::format("{:.3f}", p_value);
}

std::string mebibytes(uint64_t p_bytes) {
	return fmt::format("{:.1f}", double(p_bytes) / (1 << 20));
}

void push_distribution(std::vector<std::string> &r_row, const Distribution &p_distribution) {
	for (const double value : { p_distribution.median, p_distribution.p95, p_distribution.p99, p_distribution.max }) {
		r_row.push_back(ms(value));
	}
}

const SpeedState *find_state(const SpeedResult &p_result, const std::string &p_name) {
	const auto found = std::find_if(p_result.states.begin(), p_result.states.end(), [&](const SpeedState &p_state) { return p_state.name == p_name; });
	return found == p_result.states.end() ? nullptr : &*found;
}

ReportTable state_table(const SpeedResult &p_result) {
	ReportTable table;
	table.columns = { "GPU ms", "GI median", "p95", "p99", "max", "frame median", "p95", "p99", "max" };
	for (const SpeedState &state : p_result.states) {
		std::vector<std::string> row = { state.name };
		push_distribution(row, gi_distribution(state.frames));
		push_distribution(row, gpu_distribution(state.frames));
		table.rows.push_back(row);
	}
	return table;
}

// What holds on any device: GI's time as multiples of that with a light that changes every frame.
ReportTable ratio_table(const SpeedResult &p_result) {
	ReportTable table;
	table.columns = { "GI's time / its median with a light that changes every frame", "median", "p95", "max" };
	const SpeedState *yardstick = find_state(p_result, YARDSTICK);
	const double unit = yardstick == nullptr ? 0.0 : gi_distribution(yardstick->frames).median;
	for (const SpeedState &state : p_result.states) {
		const Distribution gi = gi_distribution(state.frames);
		const auto ratio = [&](double p_value) { return unit > 0.0 ? fmt::format("{:.2f}", p_value / unit) : std::string("–"); };
		table.rows.push_back({ state.name, ratio(gi.median), ratio(gi.p95), ratio(gi.max) });
	}
	return table;
}

ReportTable count_table(const SpeedResult &p_result) {
	ReportTable table;
	table.columns = { "counts", "passes a frame", "of GI", "most of GI", "draws", "triangles", "rays", "cells", "records", "probes", "GI MiB" };
	for (const SpeedState &state : p_result.states) {
		std::vector<double> passes, gi_passes;
		uint64_t rays = 0;
		for (const FrameSample &frame : state.frames) {
			passes.push_back(double(frame.passes.size()));
			gi_passes.push_back(double(std::count_if(frame.passes.begin(), frame.passes.end(), [](const PassTiming &p_pass) { return is_gi_pass(p_pass.name); })));
			rays = std::max(rays, frame.stats.gi.rays);
		}
		const FrameStats &last = state.frames.back().stats;
		table.rows.push_back({ state.name, fmt::format("{:g}", percentile(passes, 0.5)), fmt::format("{:g}", percentile(gi_passes, 0.5)), fmt::format("{:g}", percentile(gi_passes, 1.0)), std::to_string(last.draws), std::to_string(last.triangles), std::to_string(rays),
				std::to_string(last.gi.surface_cells), std::to_string(last.gi.surface_records), std::to_string(last.gi.probes), mebibytes(last.gi.bytes) });
	}
	return table;
}

std::string millions(uint64_t p_count) {
	return fmt::format("{:.2f}", double(p_count) * 1e-6);
}

// Passes by rows, kinds of frames by columns.
ReportTable fetch_table(const SpeedResult &p_result) {
	ReportTable table;
	table.columns = { "fetches in a frame, millions (MiB)" };
	for (const FetchFrame &frame : p_result.fetches) {
		table.columns.push_back(frame.what);
		GiFetches sum = { .pass = "all" };
		std::vector<GiFetches> rows = frame.passes;
		for (const GiFetches &pass : rows) {
			sum.fetches += pass.fetches;
			sum.bytes += pass.bytes;
		}
		rows.push_back(sum);
		table.rows.resize(rows.size());
		for (size_t i = 0; i < rows.size(); i++) {
			if (table.rows[i].empty()) {
				table.rows[i].push_back(rows[i].pass);
			}
			table.rows[i].push_back(fmt::format("{} ({})", millions(rows[i].fetches), mebibytes(rows[i].bytes)));
		}
	}
	return table;
}

ReportTable pass_table(const SpeedState &p_state) {
	ReportTable table;
	table.columns = { "GPU ms, " + p_state.name, "median", "p95", "p99", "max" };
	for (const PassRow &pass : pass_rows(p_state.frames)) {
		std::vector<std::string> row = { pass.name };
		push_distribution(row, pass.ms);
		table.rows.push_back(row);
	}
	return table;
}

ReportTable scaling_table(const SpeedResult &p_result) {
	ReportTable table;
	table.columns = { "scaling", "value", "GI ms", "of that gather", "frame ms", "first frame's GI ms", "cells", "records", "probes", "rays", "M fetches", "GI MiB" };
	for (const ScalePoint &point : p_result.scaling) {
		table.rows.push_back({ point.group, point.label, ms(point.gi_ms), ms(point.gather_ms), ms(point.frame_ms), ms(point.first_ms), std::to_string(point.gi.surface_cells), std::to_string(point.gi.surface_records), std::to_string(point.gi.probes), std::to_string(point.gi.rays), millions(point.fetches.fetches), mebibytes(point.gi.bytes) });
	}
	return table;
}

// By the debug name's first two parts without their numbers, largest first.
ReportTable memory_table(const MemoryReport &p_report) {
	std::vector<std::pair<uint64_t, std::string>> kinds;
	for (const MemoryReport::Entry &entry : p_report.entries) {
		const size_t first = entry.name.find('.');
		std::string name = first == std::string::npos ? entry.name : entry.name.substr(0, entry.name.find('.', first + 1));
		name.erase(name.find_last_not_of("0123456789") + 1);
		const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto &p_kind) { return p_kind.second == name; });
		if (found == kinds.end()) {
			kinds.emplace_back(entry.bytes, name);
		} else {
			found->first += entry.bytes;
		}
	}
	std::sort(kinds.rbegin(), kinds.rend());
	ReportTable table;
	table.columns = { "memory", "MiB" };
	for (const auto &[bytes, name] : kinds) {
		table.rows.push_back({ name, mebibytes(bytes) });
	}
	table.rows.push_back({ "all", mebibytes(p_report.total_bytes) });
	return table;
}

Json distribution_json(const Distribution &p_distribution) {
	return { { "count", p_distribution.count }, { "median", p_distribution.median }, { "p95", p_distribution.p95 }, { "p99", p_distribution.p99 }, { "max", p_distribution.max } };
}

Json state_json(const SpeedState &p_state) {
	Json json = { { "state", p_state.name }, { "what", p_state.what }, { "gi_ms", distribution_json(gi_distribution(p_state.frames)) }, { "gpu_ms", distribution_json(gpu_distribution(p_state.frames)) } };
	std::vector<double> wall;
	for (const FrameSample &frame : p_state.frames) {
		wall.push_back(frame.wall_ms);
		json["gi_ms_by_frame"].push_back(frame.gi_ms());
	}
	json["wall_ms"] = distribution_json(distribution_of(wall));
	for (const PassRow &pass : pass_rows(p_state.frames)) {
		Json row = distribution_json(pass.ms);
		row["pass"] = pass.name;
		json["passes"].push_back(row);
	}
	return json;
}

Json result_json(const SpeedResult &p_result, const Json &p_conditions) {
	Json json = { { "bench", "speed" }, { "conditions", p_conditions }, { "settled_after_frames", p_result.settled_after }, { "states", Json::array() }, { "memory", memory_json(p_result.memory) }, { "scaling", Json::array() } };
	for (const SpeedState &state : p_result.states) {
		json["states"].push_back(state_json(state));
	}
	for (const FetchFrame &frame : p_result.fetches) {
		for (const GiFetches &pass : frame.passes) {
			json["fetches"].push_back({ { "frame", frame.what }, { "pass", pass.pass }, { "fetches", pass.fetches }, { "bytes", pass.bytes } });
		}
	}
	for (const ScalePoint &point : p_result.scaling) {
		json["scaling"].push_back({ { "group", point.group }, { "value", point.x }, { "gi_ms", point.gi_ms }, { "gather_ms", point.gather_ms }, { "frame_ms", point.frame_ms }, { "first_frame_gi_ms", point.first_ms }, { "cells", point.gi.surface_cells }, { "records", point.gi.surface_records }, { "probes", point.gi.probes }, { "rays", point.gi.rays }, { "fetches", point.fetches.fetches }, { "fetched_bytes", point.fetches.bytes }, { "gi_bytes", point.gi.bytes } });
	}
	return json;
}

void add_charts(const SpeedResult &p_result, HtmlReport &r_html) {
	ReportChart frames = { .title = "GI by frame", .x_label = "frame", .y_label = "GPU ms", .log_y = true };
	for (const SpeedState &state : p_result.states) {
		ReportSeries series = { .name = state.name };
		for (const FrameSample &frame : state.frames) {
			series.x.push_back(double(series.x.size() + 1));
			series.y.push_back(frame.gi_ms());
		}
		frames.series.push_back(series);
	}
	r_html.chart(frames);
	for (size_t i = 0; i < p_result.scaling.size();) {
		const std::string group = p_result.scaling[i].group;
		ReportChart chart = { .title = "GI by " + group, .x_label = group, .y_label = "GPU ms", .log_x = true, .series = { { "all of GI" }, { "of that gather" } } };
		for (; i < p_result.scaling.size() && p_result.scaling[i].group == group; i++) {
			const ScalePoint &point = p_result.scaling[i];
			for (ReportSeries &series : chart.series) {
				series.x.push_back(point.x);
			}
			chart.series[0].y.push_back(point.gi_ms);
			chart.series[1].y.push_back(point.gather_ms);
		}
		r_html.chart(chart);
	}
}

} // namespace

Status write_speed(const BenchOptions &p_options, const SpeedResult &p_result, const Json &p_conditions) {
	const SpeedPreset &preset = p_result.preset;
	const std::string line = conditions_line(p_conditions) + fmt::format("; atrium, {}x{}, {} cascades of {}³ cells, sets of {} frames, {} frames a state, {:g} a second", preset.width, preset.height, p_conditions["cascades"].get<uint32_t>(), preset.grid, p_conditions["frames_to_converge"].get<uint32_t>(), preset.frames, preset.frames_a_second);
	const std::string settled = p_result.settled_after != 0 ? fmt::format("The light settled after {} frames.", p_result.settled_after) : fmt::format("The light had not settled after {} frames: what is called settled is not.", preset.settle_frames);
	std::vector<ReportTable> tables = { count_table(p_result), fetch_table(p_result), ratio_table(p_result), state_table(p_result) };
	if (!preset.cpu) {
		std::rotate(tables.begin(), tables.end() - 1, tables.end());
	}
	for (const SpeedState &state : p_result.states) {
		if (state.name == YARDSTICK || state.name == "settled" || !preset.cpu) {
			tables.push_back(pass_table(state));
		}
	}
	tables.push_back(memory_table(p_result.memory));
	tables.push_back(scaling_table(p_result));
	HtmlReport html("Speed: what a frame costs", line);
	html.paragraph(settled + " GI: the passes of sdfgi.* and gi_world.*; p95 and p99 are percentiles over the frames of a state. In the scaling table a light changes in every frame. Fetches: loads from buffers and textures as the shaders have them, caches or not; a structure or a bilinear lookup is one.");
	for (const ReportTable &table : tables) {
		std::printf("%s\n", table_text(table).c_str());
		html.table(table);
	}
	add_charts(p_result, html);
	std::printf("%s\n%s\n", settled.c_str(), line.c_str());
	if (const Status status = write_bench_json(p_options, "speed", result_json(p_result, p_conditions)); !status) {
		return status;
	}
	return write_bench_report(p_options, "speed.html", html);
}

} // namespace lucent
