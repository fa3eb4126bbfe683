// SPDX-License-Identifier: MIT
#include "modules/app/commands.h"
#include "modules/app/compare_options.h"
#include "modules/app/exit_codes.h"
#include "modules/image/image_io.h"
#include "modules/reference/metric_files.h"
#include "servers/core/file_io.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace lucent {

namespace {

struct RegionRow {
	std::string name; // "whole" or the mask's path
	ImageMetrics metrics;
};

struct LeakRow {
	std::string name;
	LeakMetrics metrics;
};

struct Comparison {
	MetricImage a;
	MetricImage b;
	std::vector<RegionRow> regions;
	std::vector<LeakRow> leaks;
};

int report(ExitCode p_code, const Error &p_error) {
	log_error("{}", p_error.message);
	return p_code;
}

// In METRIC_NAMES' order.
std::vector<double> figures(const ImageMetrics &p_metrics) {
	return { p_metrics.rmse, p_metrics.nrmse, p_metrics.relmse, p_metrics.energy, p_metrics.over_lit, p_metrics.under_lit, p_metrics.max_error, p_metrics.ssim, p_metrics.flip, p_metrics.flip_p99 };
}

// In LEAK_METRIC_NAMES' order.
std::vector<double> figures(const LeakMetrics &p_metrics) {
	return { p_metrics.mean, p_metrics.p999, p_metrics.max };
}

bool is_scene_referred(const std::string &p_path) {
	const std::string extension = path_extension(p_path);
	return extension == "exr" || extension == "hdr";
}

Status load(const CompareOptions &p_options, Comparison &r_comparison) {
	Result<MetricImage> a = load_metric_image(p_options.image_a, p_options.layer_a);
	if (!a) {
		return a.error();
	}
	Result<MetricImage> b = load_metric_image(p_options.image_b, p_options.layer_b);
	if (!b) {
		return b.error();
	}
	r_comparison.a = a.take();
	r_comparison.b = b.take();
	if (r_comparison.a.width != r_comparison.b.width || r_comparison.a.height != r_comparison.b.height) {
		return make_error("{} is {}x{}, {} is {}x{}: only pictures of one size compare", p_options.image_a, r_comparison.a.width, r_comparison.a.height, p_options.image_b, r_comparison.b.width, r_comparison.b.height);
	}
	if (const bool a_is_scene = is_scene_referred(p_options.image_a); a_is_scene != is_scene_referred(p_options.image_b)) {
		log_warning("{} is scene-referred, {} what a display shows, cut off at 1 and maybe tone-mapped: their light differs where the picture doesn't", a_is_scene ? p_options.image_a : p_options.image_b,
				a_is_scene ? p_options.image_b : p_options.image_a);
	}
	return Ok();
}

Status measure(const CompareOptions &p_options, Comparison &r_comparison) {
	const MetricSettings settings = { .exposure = p_options.exposure };
	const MetricImage &a = r_comparison.a;
	const Result<ImageMetrics> whole = compare_images(a, r_comparison.b, {}, settings);
	if (!whole) {
		return whole.error();
	}
	r_comparison.regions.push_back({ "whole", whole.value() });
	for (const std::string &path : p_options.masks) {
		const Result<std::vector<uint8_t>> mask = load_metric_mask(path, a.width, a.height);
		if (!mask) {
			return mask.error();
		}
		const Result<ImageMetrics> region = compare_images(a, r_comparison.b, mask.value(), settings);
		if (!region) {
			return make_error("{}: {}", path, region.error().message);
		}
		r_comparison.regions.push_back({ path, region.value() });
	}
	for (const std::string &path : p_options.leak_masks) {
		const Result<std::vector<uint8_t>> mask = load_metric_mask(path, a.width, a.height);
		if (!mask) {
			return mask.error();
		}
		const Result<LeakMetrics> leak = measure_leak(a, mask.value());
		if (!leak) {
			return make_error("{}: {}", path, leak.error().message);
		}
		r_comparison.leaks.push_back({ path, leak.value() });
	}
	return Ok();
}

template <size_t N>
nlohmann::ordered_json json_row(const std::string &p_name, uint64_t p_pixels, const char *const (&p_names)[N], const std::vector<double> &p_values) {
	nlohmann::ordered_json row = { { "region", p_name }, { "pixels", p_pixels } };
	for (size_t i = 0; i < N; i++) {
		row[p_names[i]] = std::isfinite(p_values[i]) ? nlohmann::ordered_json(p_values[i]) : nlohmann::ordered_json(nullptr);
	}
	return row;
}

void print_json(const CompareOptions &p_options, const Comparison &p_comparison, const std::vector<std::string> &p_failures) {
	nlohmann::ordered_json root = { { "a", p_options.image_a }, { "b", p_options.image_b }, { "layer_a", p_options.layer_a }, { "layer_b", p_options.layer_b }, { "width", p_comparison.a.width }, { "height", p_comparison.a.height }, { "exposure", p_options.exposure } };
	root["regions"] = nlohmann::ordered_json::array();
	for (const RegionRow &row : p_comparison.regions) {
		nlohmann::ordered_json object = json_row(row.name, row.metrics.pixels, METRIC_NAMES, figures(row.metrics));
		object["mean_a"] = row.metrics.mean_a;
		object["mean_b"] = row.metrics.mean_b;
		root["regions"].push_back(object);
	}
	root["leaks"] = nlohmann::ordered_json::array();
	for (const LeakRow &row : p_comparison.leaks) {
		root["leaks"].push_back(json_row(row.name, row.metrics.pixels, LEAK_METRIC_NAMES, figures(row.metrics)));
	}
	root["failures"] = p_failures;
	std::printf("%s\n", root.dump(1, '\t', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

template <size_t N>
void print_row(const std::string &p_name, const char *const (&p_names)[N], const std::vector<double> &p_values, bool p_head) {
	if (p_head) {
		std::printf("%-20s", "");
		for (const char *name : p_names) {
			std::printf(" %10s", name);
		}
		std::printf("\n");
	}
	std::printf("%-20s", p_name.c_str());
	for (double value : p_values) {
		std::printf(" %10.4g", value);
	}
	std::printf("\n");
}

void print_table(const Comparison &p_comparison) {
	for (size_t i = 0; i < p_comparison.regions.size(); i++) {
		print_row(p_comparison.regions[i].name, METRIC_NAMES, figures(p_comparison.regions[i].metrics), i == 0);
	}
	for (size_t i = 0; i < p_comparison.leaks.size(); i++) {
		print_row(p_comparison.leaks[i].name, LEAK_METRIC_NAMES, figures(p_comparison.leaks[i].metrics), i == 0);
	}
}

bool is_worse(const std::string &p_metric, double p_value, double p_bound) {
	if (p_metric == "ssim") {
		return !(p_value >= p_bound);
	}
	return !((p_metric == "energy" ? std::abs(p_value - 1.0) : p_value) <= p_bound);
}

template <size_t N>
void check_row(const std::string &p_name, const char *const (&p_names)[N], const std::vector<double> &p_values, const std::vector<MetricBound> &p_bounds, std::vector<std::string> &r_failures) {
	for (const MetricBound &bound : p_bounds) {
		for (size_t i = 0; i < N; i++) {
			if (bound.metric == p_names[i] && is_worse(bound.metric, p_values[i], bound.value)) {
				r_failures.push_back(fmt::format("{}: {} is {:.6g}, the bound is {:.6g}", p_name, bound.metric, p_values[i], bound.value));
			}
		}
	}
}

int compare(const CompareOptions &p_options) {
	Comparison comparison;
	if (const Status status = load(p_options, comparison); !status) {
		return report(EXIT_BAD_INPUT, status.error());
	}
	if (const Status status = measure(p_options, comparison); !status) {
		return report(EXIT_BAD_INPUT, status.error());
	}
	if (!p_options.difference.empty()) {
		const std::vector<uint8_t> picture = difference_picture(comparison.a, comparison.b, p_options.exposure);
		if (const Status status = write_png(p_options.difference, comparison.a.width, comparison.a.height, 3, picture); !status) {
			return report(EXIT_OUTPUT, status.error());
		}
	}
	std::vector<std::string> failures;
	for (const RegionRow &row : comparison.regions) {
		check_row(row.name, METRIC_NAMES, figures(row.metrics), p_options.bounds, failures);
	}
	for (const LeakRow &row : comparison.leaks) {
		check_row(row.name, LEAK_METRIC_NAMES, figures(row.metrics), p_options.bounds, failures);
	}
	if (p_options.json) {
		print_json(p_options, comparison, failures);
	} else {
		print_table(comparison);
	}
	for (const std::string &failure : failures) {
		log_error("{}", failure);
	}
	return failures.empty() ? EXIT_OK : EXIT_WORSE;
}

} // namespace

int compare_command(const std::vector<std::string> &p_args) {
	const Result<CompareOptions> options = parse_compare_options(p_args);
	if (!options) {
		return report(EXIT_USAGE, options.error());
	}
	return options.value().exit ? int(EXIT_OK) : compare(options.value());
}

} // namespace lucent
