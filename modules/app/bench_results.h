// SPDX-License-Identifier: MIT
#pragma once
// What every benchmark's results begin and end with.

#include "modules/app/bench_options.h"
#include "modules/app/exit_codes.h"
#include "modules/bench/report.h"
#include "servers/rendering/device/rendering_device.h"

#include <nlohmann/json_fwd.hpp>

namespace lucent {

// Device, driver, commit (LUCENT_COMMIT, which the launcher sets), settings: what figures mean nothing without.
nlohmann::ordered_json bench_conditions(const BenchOptions &p_options, const DeviceInfo &p_device);
// The same in a line.
std::string conditions_line(const nlohmann::ordered_json &p_conditions);

// Says why on stderr; answers the code.
int bench_failure(ExitCode p_code, const Error &p_error);

bool is_cpu_device(const DeviceInfo &p_device);

// Makes the folder. Asked before the work, so that it isn't lost.
Status prepare_output(const BenchOptions &p_options);
// NAME.json in the folder, or --json's file.
Status write_bench_json(const BenchOptions &p_options, const std::string &p_name, const nlohmann::ordered_json &p_json);
// p_file in the folder; nothing with --json.
Status write_bench_report(const BenchOptions &p_options, const std::string &p_file, const HtmlReport &p_report);

} // namespace lucent
