// SPDX-License-Identifier: MIT
#include "modules/app/bench_response.h"
#include "modules/app/bench_results.h"
#include "servers/rendering/gi/sdfgi/sdfgi_settings.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace lucent {

using Json = nlohmann::ordered_json;

namespace {

// Frames to a share of the change: "–" where nothing changed, with + where the last frame is not where the light ends.
std::string frames_text(const ResponseRow &p_row, uint32_t p_frames) {
	return p_row.response.after == 0.0 ? std::string("–") : std::to_string(p_frames) + (p_row.ended ? "" : "+");
}

ReportTable change_table(const ResponseResult &p_result) {
	ReportTable table;
	table.columns = { "change", "scene", "frames to 50 %", "90 %", "99 %", "overshoot", "change", "pixels", "settled after", "at rest: difference", "rays" };
	for (const ResponseRow &row : p_result.rows) {
		const Response &response = row.response;
		const std::string settled = std::to_string(row.settle_frames) + (row.settled ? "" : "+");
		const std::string rest = row.settled ? fmt::format("{:g}", row.rest_difference) : "–";
		table.rows.push_back({ row.name, row.scene, frames_text(row, response.frames_50), frames_text(row, response.frames_90), frames_text(row, response.frames_99), fmt::format("{:.1f} %", 100.0 * response.overshoot), fmt::format("{:.4g}", response.after),
				fmt::format("{:.0f} %", 100.0 * row.affected), settled, rest, row.settled ? std::to_string(row.rest_rays) : "–" });
	}
	return table;
}

ReportTable scroll_table(const ScrollResult &p_scroll) {
	ReportTable table;
	table.columns = { "cascade 0 moves one probe: frame after it", "p99, steps of 255", "max" };
	for (size_t frame = 0; frame < p_scroll.max_steps.size(); frame++) {
		if ((frame & (frame + 1)) == 0 || frame + 1 == p_scroll.max_steps.size()) { // 1, 2, 4 … and the last
			table.rows.push_back({ std::to_string(frame + 1), fmt::format("{:g}", p_scroll.p99_steps[frame]), fmt::format("{:g}", p_scroll.max_steps[frame]) });
		}
	}
	return table;
}

Json row_json(const ResponseRow &p_row) {
	const Response &response = p_row.response;
	return {
		{ "change", p_row.name },
		{ "scene", p_row.scene },
		{ "settled", p_row.settled },
		{ "settle_frames", p_row.settle_frames },
		{ "settled_again", p_row.ended },
		{ "frames_50", response.frames_50 },
		{ "frames_90", response.frames_90 },
		{ "frames_99", response.frames_99 },
		{ "overshoot", response.overshoot },
		{ "change", response.after },
		{ "affected", p_row.affected },
		{ "rest_difference", p_row.rest_difference },
		{ "rest_rays", p_row.rest_rays },
		{ "curve", p_row.curve },
	};
}

ReportChart change_chart(const ResponseResult &p_result) {
	ReportChart chart = { .title = "Share of the change", .x_label = "frame after the change", .y_label = "1: done", .log_x = true };
	for (const ResponseRow &row : p_result.rows) {
		ReportSeries series = { .name = row.name };
		const double change = row.response.after;
		for (size_t i = 0; i < row.curve.size() && change != 0.0; i++) {
			series.x.push_back(double(i + 1));
			series.y.push_back(row.curve[i] / change);
		}
		chart.series.push_back(series);
	}
	return chart;
}

ReportChart scroll_chart(const ScrollResult &p_scroll) {
	ReportChart chart = { .title = "Picture after cascade 0 moved one probe", .x_label = "frame", .y_label = "steps of 255", .log_x = true, .series = { { "p99", {}, p_scroll.p99_steps }, { "max", {}, p_scroll.max_steps } } };
	for (ReportSeries &series : chart.series) {
		for (size_t i = 0; i < series.y.size(); i++) {
			series.x.push_back(double(i + 1));
		}
	}
	return chart;
}

} // namespace

bool ResponseResult::rests() const {
	const auto settled = [](const ResponseRow &p_row) { return p_row.settled; };
	const auto rests = [](const ResponseRow &p_row) { return !p_row.settled || (p_row.rest_difference == 0.0 && p_row.rest_rays == 0); };
	return std::any_of(rows.begin(), rows.end(), settled) && std::all_of(rows.begin(), rows.end(), rests);
}

Status write_response(const BenchOptions &p_options, const ResponseResult &p_result, const Json &p_conditions) {
	const ResponsePreset &preset = p_result.preset;
	Json conditions = p_conditions;
	conditions["size"] = { preset.width, preset.height };
	conditions["grid"] = preset.grid;
	conditions["frames"] = preset.frames;
	conditions["frames_to_converge"] = preset.frames_to_converge != 0 ? preset.frames_to_converge : SdfgiSettings().frames_to_converge;
	const std::string line = conditions_line(conditions) + fmt::format("; {}x{}, {}³ cells, sets of {} frames, {} frames after the change", preset.width, preset.height, preset.grid, conditions["frames_to_converge"].get<uint32_t>(), preset.frames);
	const std::string repeats = fmt::format("Two runs on new devices, {} frames of rooms_1: {}.", REPEAT_FRAMES, p_result.repeats ? "the same bits" : "NOT the same bits");
	HtmlReport html("Response: how fast light follows a change", line);
	html.paragraph("How far the luminance of indirect light has moved to where it ends, averaged over the pixels that the change reaches. Frames: the first with the change is 1; the share is reached and kept. At rest: largest difference of a channel between "
				   "frames before the change, and rays traced there. + : the light had not settled by then, so that the figure may be too low.");
	std::printf("%s+: the light had not settled by then\n\n%s%s\n%s\n%s\n", table_text(change_table(p_result)).c_str(), table_text(scroll_table(p_result.scroll)).c_str(), p_result.scroll.settled ? "" : "The light had not settled before the step: the figures hold that too.\n", repeats.c_str(), line.c_str());
	html.table(change_table(p_result));
	html.chart(change_chart(p_result));
	html.table(scroll_table(p_result.scroll));
	html.chart(scroll_chart(p_result.scroll));
	html.paragraph(repeats);
	Json json = { { "bench", "response" }, { "conditions", conditions }, { "changes", Json::array() }, { "scroll", { { "settled", p_result.scroll.settled }, { "p99_steps", p_result.scroll.p99_steps }, { "max_steps", p_result.scroll.max_steps } } }, { "repeats_bit_for_bit", p_result.repeats }, { "rest_is_still", p_result.rests() } };
	for (const ResponseRow &row : p_result.rows) {
		json["changes"].push_back(row_json(row));
	}
	if (const Status status = write_bench_json(p_options, "response", json); !status) {
		return status;
	}
	return write_bench_report(p_options, "response.html", html);
}

} // namespace lucent
