// SPDX-License-Identifier: MIT
#include "modules/app/bench_quality.h"
#include "modules/app/bench_results.h"
#include "modules/bench/statistics.h"
#include "modules/image/image_io.h"
#include "servers/core/file_io.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace lucent {

using Json = nlohmann::ordered_json;

namespace {

const std::string NONE = "–";

// Godot's figures beside the truth; null where there are none.
Json read_godot(const std::string &p_folder) {
	const Result<std::vector<std::byte>> bytes = read_file(p_folder + "godot.json");
	if (!bytes) {
		return {};
	}
	const char *text = reinterpret_cast<const char *>(bytes.value().data());
	return Json::parse(text, text + bytes.value().size(), nullptr, false);
}

std::string number(double p_value, int p_digits) {
	return fmt::format("{:.{}f}", p_value, p_digits);
}

std::string with_interval(double p_value, double p_interval) {
	return fmt::format("{:.3f} ±{:.3f}", p_value, p_interval);
}

std::string godot_cell(const Json &p_godot, const std::string &p_scene, const char *p_settings, const char *p_figure) {
	const Json::json_pointer pointer("/scenes/" + p_scene + "/" + p_settings + "/" + p_figure);
	return p_godot.is_object() && p_godot.contains(pointer) ? number(p_godot[pointer].get<double>(), 2) : NONE;
}

std::string leak_text(double p_leak) {
	return p_leak == 0.0 ? "0" : fmt::format("{:.3g}", p_leak);
}

ReportTable quality_table(const std::vector<QualityRow> &p_rows, const Json &p_godot) {
	ReportTable table;
	table.columns = { "scene", "nrmse", "noise", "Godot's", "its best", "flat", "pixels", "noise", "mottle", "noise", "energy", "Godot's", "of its best", "relmse", "logcorr", "frames", "GI ms" };
	for (const QualityRow &row : p_rows) {
		const LightError &error = row.error;
		const std::string frames = std::to_string(row.frames) + (row.settled ? "" : "+");
		if (error.sealed) {
			table.rows.push_back({ row.name + " (leak max)", leak_text(error.leak.max), NONE, godot_cell(p_godot, row.name, "default", "leak_max"), godot_cell(p_godot, row.name, "best", "leak_max"), NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, frames, number(row.gi_ms, 2) });
			continue;
		}
		const MottleError &mottle = error.mottle;
		const bool mottle_known = mottle.windows > 0;
		table.rows.push_back({ row.name, with_interval(error.blocks.nrmse, error.blocks.interval), number(error.blocks.noise, 3), godot_cell(p_godot, row.name, "default", "nrmse"), godot_cell(p_godot, row.name, "best", "nrmse"), number(error.flat, 3),
				with_interval(error.pixels.nrmse, error.pixels.interval), number(error.pixels.noise, 3), mottle_known ? with_interval(mottle.mottle, mottle.interval) : NONE, mottle_known ? number(mottle.noise, 3) : NONE,
				with_interval(error.energy, error.energy_interval), godot_cell(p_godot, row.name, "default", "energy"), godot_cell(p_godot, row.name, "best", "energy"), number(error.relmse, 3), number(error.log_correlation, 3), frames, number(row.gi_ms, 2) });
	}
	return table;
}

Json row_json(const QualityRow &p_row, const Json &p_godot) {
	const LightError &error = p_row.error;
	Json json = { { "scene", p_row.name }, { "frames", p_row.frames }, { "settled", p_row.settled }, { "sealed", error.sealed }, { "blocks", error.block_count }, { "mean", error.mean }, { "truth_mean", error.truth_mean } };
	if (error.sealed) {
		json["leak"] = { { "pixels", error.leak.pixels }, { "mean", error.leak.mean }, { "p999", error.leak.p999 }, { "max", error.leak.max } };
	} else {
		json.update({ { "nrmse", error.blocks.nrmse }, { "nrmse_interval", error.blocks.interval }, { "noise", error.blocks.noise }, { "flat", error.flat }, { "energy", error.energy }, { "energy_interval", error.energy_interval }, { "relmse", error.relmse }, { "log_correlation", error.log_correlation } });
		json["pixels"] = { { "nrmse", error.pixels.nrmse }, { "nrmse_interval", error.pixels.interval }, { "noise", error.pixels.noise } };
		json["mottle"] = { { "windows", error.mottle.windows }, { "mottle", error.mottle.mottle }, { "mottle_interval", error.mottle.interval }, { "noise", error.mottle.noise }, { "worst", error.mottle.worst } };
	}
	for (const auto &[frame, value] : p_row.curve) {
		json["curve"].push_back({ frame, value });
	}
	json["gi_ms_median"] = p_row.gi_ms;
	json["gi_bytes"] = p_row.gi_bytes;
	json["seconds"] = p_row.seconds;
	if (p_godot.is_object() && p_godot.contains("scenes") && p_godot["scenes"].contains(p_row.name)) {
		json["godot"] = p_godot["scenes"][p_row.name];
	}
	return json;
}

// So that a bright part of the truth is at 0.8 of the display's white.
float exposure_of(const TruthImage &p_truth) {
	std::vector<double> values;
	for (size_t i = 0; i < p_truth.pixel_count(); i++) {
		if (p_truth.mask[i] != 0) {
			values.push_back((p_truth.indirect[3 * i] + p_truth.indirect[3 * i + 1] + p_truth.indirect[3 * i + 2]) / 3.0);
		}
	}
	const double bright = percentile(values, 0.95);
	return bright > SEALED_MEAN ? float(0.8 / bright) : 1.0f;
}

// Ours, truth and difference side by side.
Status write_triptych(const std::string &p_path, const QualityRow &p_row) {
	constexpr uint32_t GAP_PIXELS = 4;
	const float exposure = exposure_of(p_row.truth);
	const MetricImage truth = p_row.truth.light();
	const std::vector<float> shown[] = { display_values(p_row.light, exposure), display_values(truth, exposure) };
	const std::vector<uint8_t> difference = difference_picture(p_row.light, truth, exposure);
	const uint32_t width = 3 * truth.width + 2 * GAP_PIXELS;
	std::vector<uint8_t> picture(size_t(width) * truth.height * 3, 255);
	for (uint32_t panel = 0; panel < 3; panel++) {
		for (size_t i = 0; i < 3 * truth.pixel_count(); i++) {
			const size_t x = i / 3 % truth.width + panel * (truth.width + GAP_PIXELS), y = i / 3 / truth.width;
			picture[3 * (y * width + x) + i % 3] = panel == 2 ? difference[i] : uint8_t(shown[panel][i] * 255.0f + 0.5f);
		}
	}
	return write_png(p_path, width, truth.height, 3, picture);
}

ReportChart curve_chart(const std::vector<QualityRow> &p_rows, size_t p_first, size_t p_count) {
	ReportChart chart = { .title = "Error by frame", .x_label = "frame", .y_label = "nrmse", .log_x = true, .log_y = true };
	for (size_t i = p_first; i < std::min(p_first + p_count, p_rows.size()); i++) {
		ReportSeries series = { .name = p_rows[i].name };
		for (const auto &[frame, value] : p_rows[i].curve) {
			series.x.push_back(frame);
			series.y.push_back(value);
		}
		if (!p_rows[i].error.sealed) {
			chart.series.push_back(series);
		}
	}
	return chart;
}

std::string caption(const QualityRow &p_row) {
	const std::string figures = p_row.error.sealed ? "largest leak " + leak_text(p_row.error.leak.max) : fmt::format("nrmse {:.3f}, of pixels {:.3f}, mottle {:.3f}, energy {:.3f}", p_row.error.blocks.nrmse, p_row.error.pixels.nrmse, p_row.error.mottle.mottle, p_row.error.energy);
	return p_row.name + ": ours, truth, difference (red: ours is brighter, blue: darker). Indirect light alone. " + figures;
}

} // namespace

Status write_quality(const BenchOptions &p_options, const std::vector<QualityRow> &p_rows, const Json &p_conditions) {
	const Json godot = read_godot(p_options.truth);
	const ReportTable table = quality_table(p_rows, godot);
	Json json = { { "bench", "quality" }, { "conditions", p_conditions }, { "godot_conditions", godot.is_object() ? godot.value("conditions", "") : "" }, { "scenes", Json::array() } };
	HtmlReport html("Quality: indirect light against path-traced truth", conditions_line(p_conditions) + fmt::format(", {}x{}, {}³ cells", p_options.width, p_options.height, p_conditions["grid"].get<uint32_t>()));
	html.paragraph("nrmse: root mean square error over blocks of 4 x 4 pixels / mean of the truth; pixels: the same over single pixels; the truth's noise is taken out of both, ±: 95 % interval over it. "
				   "mottle: standard deviation of log2(ours / truth) over 8 x 8 blocks in which the truth is smooth. noise: what a perfect picture would score if the noise were left in; "
				   "a bar counts where the noise is below a third of it. flat: what constant light of the right mean would. energy: mean / mean of the truth. frames+: the light had not settled by then.");
	html.table(table);
	html.paragraph(json["godot_conditions"].get<std::string>() + ".");
	html.heading("Convergence");
	html.chart(curve_chart(p_rows, 0, 8));
	html.heading("Pictures, worst first");
	for (const QualityRow &row : p_rows) {
		json["scenes"].push_back(row_json(row, godot));
		if (!p_options.json.empty()) {
			continue;
		}
		const std::string path = p_options.output + row.name + ".png";
		if (const Status status = write_triptych(path, row); !status) {
			return status;
		}
		if (const Status status = html.picture(path, caption(row)); !status) {
			return status;
		}
	}
	std::fputs(table_text(table).c_str(), stdout);
	std::printf("±: 95 %% over the truth's noise; ours, and what a light that has not settled (+) lacks, is part of nrmse\n%s\n", conditions_line(p_conditions).c_str());
	if (const Status status = write_bench_json(p_options, "quality", json); !status) {
		return status;
	}
	return write_bench_report(p_options, "report.html", html);
}

} // namespace lucent
