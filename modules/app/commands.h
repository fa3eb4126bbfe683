// SPDX-License-Identifier: MIT
#pragma once
// The subcommands. p_args: what follows the subcommand's name. Each returns an ExitCode.

#include <string>
#include <vector>

namespace lucent {

inline constexpr const char *LUCENT_VERSION = "0.1.0";

int render_command(const std::vector<std::string> &p_args);
int reference_command(const std::vector<std::string> &p_args);
int bench_command(const std::vector<std::string> &p_args);
int compare_command(const std::vector<std::string> &p_args);
int doctool_command(const std::vector<std::string> &p_args);
int info_command(const std::vector<std::string> &p_args);

} // namespace lucent
