// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lucent {

// One sentence on what p_app could not read; an option that it does not have brings the nearest that it has.
std::string parse_error_text(const CLI::App &p_app, const CLI::ParseError &p_error);

} // namespace lucent
