// SPDX-License-Identifier: MIT
#include "modules/app/bench_results.h"

#include "modules/app/commands.h"
#include "modules/app/output_files.h"
#include "servers/core/file_io.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>

namespace lucent {

using Json = nlohmann::ordered_json;

int bench_failure(ExitCode p_code, const Error &p_error) {
	log_error("{}", p_error.message);
	return p_code;
}

bool is_cpu_device(const DeviceInfo &p_device) {
	return p_device.type == DeviceType::CPU;
}

Json bench_conditions(const BenchOptions &p_options, const DeviceInfo &p_device) {
	const char *commit = std::getenv("LUCENT_COMMIT");
	return {
		{ "device", p_device.name },
		{ "driver", p_device.driver },
		{ "cpu_device", is_cpu_device(p_device) },
		{ "version", LUCENT_VERSION },
		{ "commit", commit != nullptr && *commit != 0 ? commit : "unknown" },
		{ "set", p_options.settings },
	};
}

std::string conditions_line(const Json &p_conditions) {
	std::string line = p_conditions["device"].get<std::string>() + ", " + p_conditions["driver"].get<std::string>() + ", lucent " + p_conditions["version"].get<std::string>() + ", commit " + p_conditions["commit"].get<std::string>();
	for (const Json &setting : p_conditions["set"]) {
		line += ", " + setting.get<std::string>();
	}
	return p_conditions["cpu_device"].get<bool>() ? line + "; a CPU device: its milliseconds say nothing about a GPU" : line;
}

Status prepare_output(const BenchOptions &p_options) {
	if (!p_options.json.empty()) {
		return check_writable(p_options.json);
	}
	std::error_code error;
	std::filesystem::create_directories(p_options.output, error);
	if (error) {
		return make_error("{}: can't be made: {}", p_options.output, error.message());
	}
	return check_writable(p_options.output + "report.html");
}

static Status write_text(const std::string &p_path, const std::string &p_text) {
	return write_file(p_path, std::as_bytes(std::span(p_text)));
}

Status write_bench_json(const BenchOptions &p_options, const std::string &p_name, const Json &p_json) {
	const std::string path = p_options.json.empty() ? p_options.output + p_name + ".json" : p_options.json;
	return write_text(path, p_json.dump(1, '\t', false, Json::error_handler_t::replace) + "\n");
}

Status write_bench_report(const BenchOptions &p_options, const std::string &p_file, const HtmlReport &p_report) {
	return p_options.json.empty() ? write_text(p_options.output + p_file, p_report.text()) : Status(Ok());
}

} // namespace lucent
