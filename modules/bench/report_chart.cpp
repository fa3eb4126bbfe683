// SPDX-License-Identifier: MIT
// Curves as inline SVG.
#include "modules/bench/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lucent {

namespace {

constexpr double WIDTH = 720, HEIGHT = 300, LEFT = 64, RIGHT = 170, TOP = 28, BOTTOM = 42; // px
constexpr const char *COLORS[] = { "#1b6ca8", "#d1495b", "#2e933c", "#e0a100", "#7b4b94", "#00798c", "#8a5a44", "#444444" };

struct Axis {
	bool logarithmic = false;
	double low = 0, high = 1; // of shown values, as scaled
	double start_px = 0, end_px = 1;

	double scaled(double p_value) const { return logarithmic ? std::log10(p_value) : p_value; }
	bool shows(double p_value) const { return std::isfinite(p_value) && (!logarithmic || p_value > 0.0); }
	double place(double p_value) const { return start_px + (scaled(p_value) - low) / (high - low) * (end_px - start_px); }
};

// 1, 2 or 5 times a power of ten, for about five steps.
double nice_step(double p_span) {
	const double rough = p_span / 5.0;
	const double power = std::pow(10.0, std::floor(std::log10(rough)));
	for (const double factor : { 1.0, 2.0, 5.0 }) {
		if (rough <= factor * power) {
			return factor * power;
		}
	}
	return 10.0 * power;
}

std::vector<double> tick_values(const Axis &p_axis) {
	std::vector<double> ticks;
	if (!p_axis.logarithmic) {
		const double step = nice_step(p_axis.high - p_axis.low);
		for (double value = std::ceil(p_axis.low / step) * step; value <= p_axis.high + 1e-9 * step; value += step) {
			ticks.push_back(std::abs(value) < 1e-9 * step ? 0.0 : value);
		}
		return ticks;
	}
	for (double power = std::floor(p_axis.low); power <= p_axis.high; power += 1.0) {
		for (const double factor : { 1.0, 2.0, 3.0, 5.0 }) {
			const double value = factor * std::pow(10.0, power);
			if (p_axis.scaled(value) >= p_axis.low - 1e-9 && p_axis.scaled(value) <= p_axis.high + 1e-9) {
				ticks.push_back(value);
			}
		}
	}
	return ticks;
}

Axis fit_axis(const ReportChart &p_chart, bool p_x) {
	Axis axis = { .logarithmic = p_x ? p_chart.log_x : p_chart.log_y, .low = std::numeric_limits<double>::max(), .high = std::numeric_limits<double>::lowest() };
	for (const ReportSeries &series : p_chart.series) {
		for (const double value : p_x ? series.x : series.y) {
			if (axis.shows(value)) {
				axis.low = std::min(axis.low, axis.scaled(value));
				axis.high = std::max(axis.high, axis.scaled(value));
			}
		}
	}
	if (!p_x && !axis.logarithmic && axis.low > 0.0) {
		axis.low = 0.0; // heights compare as they look
	}
	if (axis.low > axis.high) {
		axis.low = 0.0;
		axis.high = 1.0;
	} else if (axis.high - axis.low < 1e-12) {
		axis.low -= 0.5;
		axis.high += 0.5;
	}
	if (!p_x && axis.logarithmic) {
		axis.low -= 0.05;
		axis.high += 0.05;
	}
	axis.start_px = p_x ? LEFT : HEIGHT - BOTTOM;
	axis.end_px = p_x ? WIDTH - RIGHT : TOP;
	return axis;
}

std::string text_at(double p_x, double p_y, const char *p_anchor, const std::string &p_text, const char *p_more = "") {
	return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", p_x, p_y, p_anchor, p_more, html_escape(p_text));
}

std::string draw_axes(const ReportChart &p_chart, const Axis &p_x, const Axis &p_y) {
	std::string svg;
	for (const double value : tick_values(p_x)) {
		svg += text_at(p_x.place(value), HEIGHT - BOTTOM + 16, "middle", fmt::format("{:g}", value));
	}
	for (const double value : tick_values(p_y)) {
		svg += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#e4e4e4\"/>", LEFT, WIDTH - RIGHT, p_y.place(value), p_y.place(value));
		svg += text_at(LEFT - 6, p_y.place(value) + 4, "end", fmt::format("{:g}", value));
	}
	svg += fmt::format("<path d=\"M{} {}V{}H{}\" fill=\"none\" stroke=\"#888\"/>", LEFT, TOP, HEIGHT - BOTTOM, WIDTH - RIGHT);
	svg += text_at((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8, "middle", p_chart.x_label);
	svg += text_at(LEFT, TOP - 10, "start", p_chart.title + ", " + p_chart.y_label, " font-weight=\"bold\"");
	return svg;
}

std::string draw_series(const ReportSeries &p_series, const Axis &p_x, const Axis &p_y, size_t p_index) {
	const char *color = COLORS[p_index % std::size(COLORS)];
	std::string points, marks;
	for (size_t i = 0; i < std::min(p_series.x.size(), p_series.y.size()); i++) {
		if (p_x.shows(p_series.x[i]) && p_y.shows(p_series.y[i])) {
			const double x = p_x.place(p_series.x[i]), y = p_y.place(p_series.y[i]);
			points += fmt::format("{:.1f},{:.1f} ", x, y);
			marks += p_series.x.size() <= 40 ? fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>", x, y, color) : "";
		}
	}
	const double legend_y = TOP + 10 + 18 * double(p_index);
	return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>{}", points, color, marks) +
			fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"3\"/>", WIDTH - RIGHT + 12, WIDTH - RIGHT + 30, legend_y, legend_y, color) +
			text_at(WIDTH - RIGHT + 36, legend_y + 4, "start", p_series.name);
}

} // namespace

void HtmlReport::chart(const ReportChart &p_chart) {
	const Axis x = fit_axis(p_chart, true), y = fit_axis(p_chart, false);
	body += fmt::format("<figure><svg viewBox=\"0 0 {} {}\" width=\"{}\" xmlns=\"http://www.w3.org/2000/svg\">", WIDTH, HEIGHT, WIDTH);
	body += draw_axes(p_chart, x, y);
	for (size_t i = 0; i < p_chart.series.size(); i++) {
		body += draw_series(p_chart.series[i], x, y, i);
	}
	body += "</svg></figure>\n";
}

} // namespace lucent
