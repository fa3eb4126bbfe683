// SPDX-License-Identifier: MIT
#pragma once
// One sink for everything that the program says besides its results. Formatting is {fmt}'s.

#include <fmt/core.h>

#include <functional>
#include <string>
#include <string_view>

namespace lucent {

enum class LogLevel {
	INFO,
	WARNING,
	ERROR
};

// Receives every message; the default writes `warning: …` and `error: …` to stderr, INFO only when verbose.
using LogHandler = std::function<void(LogLevel, std::string_view)>;

// Replaces the handler and returns the one that was there. An empty handler restores the default.
LogHandler set_log_handler(LogHandler p_handler);
void set_log_verbose(bool p_verbose);

void log_message(LogLevel p_level, std::string_view p_message);

// As log_message at WARNING, but each p_key is said once a process.
void log_warning_once(const std::string &p_key, std::string_view p_message);

template <typename... Args>
void log_info(fmt::format_string<Args...> p_format, Args &&...p_args) {
	log_message(LogLevel::INFO, fmt::format(p_format, std::forward<Args>(p_args)...));
}
template <typename... Args>
void log_warning(fmt::format_string<Args...> p_format, Args &&...p_args) {
	log_message(LogLevel::WARNING, fmt::format(p_format, std::forward<Args>(p_args)...));
}
template <typename... Args>
void log_error(fmt::format_string<Args...> p_format, Args &&...p_args) {
	log_message(LogLevel::ERROR, fmt::format(p_format, std::forward<Args>(p_args)...));
}

} // namespace lucent
