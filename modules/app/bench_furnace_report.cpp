// SPDX-License-Identifier: MIT
#include "modules/app/bench_furnace.h"
#include "modules/app/bench_results.h"
#include "modules/image/image_io.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace lucent {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char *EXPLANATION = "Every surface reflects the albedo's share of the light and emits the rest, the sky is 1, no lamp shines: every pixel must be 1. "
									"off: share of pixels that are more than 5 % away. frames+: the light had not settled by then.";

ReportTable furnace_table(const std::vector<FurnaceRow> &p_rows) {
	ReportTable table;
	table.columns = { "scene", "albedo", "mean", "p1", "p5", "p50", "p95", "p99", "off", "frames" };
	for (const FurnaceRow &row : p_rows) {
		const FurnaceError &error = row.error;
		table.rows.push_back({ row.name, fmt::format("{:g}", row.albedo), fmt::format("{:.4f}", error.mean), fmt::format("{:.3f}", error.p1), fmt::format("{:.3f}", error.p5),
				fmt::format("{:.3f}", error.p50), fmt::format("{:.3f}", error.p95), fmt::format("{:.3f}", error.p99), fmt::format("{:.2f} %", 100.0 * error.off), std::to_string(row.frames) + (row.settled ? "" : "+") });
	}
	return table;
}

Json row_json(const FurnaceRow &p_row) {
	const FurnaceError &error = p_row.error;
	return {
		{ "scene", p_row.name },
		{ "path", p_row.path },
		{ "albedo", std::round(double(p_row.albedo) * 1e6) * 1e-6 },
		{ "frames", p_row.frames },
		{ "settled", p_row.settled },
		{ "mean", error.mean },
		{ "p1", error.p1 },
		{ "p5", error.p5 },
		{ "p50", error.p50 },
		{ "p95", error.p95 },
		{ "p99", error.p99 },
		{ "off", error.off },
		{ "gi", { { "rays", p_row.gi.rays }, { "surface_cells", p_row.gi.surface_cells }, { "surface_records", p_row.gi.surface_records }, { "probes", p_row.gi.probes }, { "bytes", p_row.gi.bytes } } },
		{ "seconds", p_row.seconds },
	};
}

std::string caption(const FurnaceRow &p_row) {
	return fmt::format("{}, albedo {:g}: mean {:.4f}, {:.2f} % of pixels off by more than 5 %. Red: too dark, cyan: too bright, full colour at 0.25.", p_row.name, p_row.albedo, p_row.error.mean, 100.0 * p_row.error.off);
}

} // namespace

Status write_furnace(const BenchOptions &p_options, const std::vector<FurnaceRow> &p_rows, const Json &p_conditions) {
	const ReportTable table = furnace_table(p_rows);
	const uint32_t grid = p_conditions["grid"].get<uint32_t>();
	const std::string line = conditions_line(p_conditions) + fmt::format(", {}x{}, {}", p_options.width, p_options.height, grid != 0 ? fmt::format("{}³ cells", grid) : "the scenes' cells");
	Json json = { { "bench", "furnace" }, { "conditions", p_conditions }, { "scenes", Json::array() } };
	HtmlReport html("Furnace: scenes in which every pixel must be 1", line);
	html.paragraph(EXPLANATION);
	html.table(table);
	html.heading("Maps, worst first");
	for (const FurnaceRow &row : p_rows) {
		json["scenes"].push_back(row_json(row));
		if (!p_options.json.empty()) {
			continue;
		}
		const std::string path = fmt::format("{}furnace_{}_{:g}.png", p_options.output, row.name, row.albedo);
		if (const Status status = write_png(path, row.picture.width, row.picture.height, 3, furnace_map(row.picture)); !status) {
			return status;
		}
		if (const Status status = html.picture(path, caption(row)); !status) {
			return status;
		}
	}
	std::fputs(table_text(table).c_str(), stdout);
	std::printf("every pixel must be 1; off: share of pixels more than 5 %% away\n%s\n", line.c_str());
	if (const Status status = write_bench_json(p_options, "furnace", json); !status) {
		return status;
	}
	return write_bench_report(p_options, "furnace.html", html);
}

} // namespace lucent
