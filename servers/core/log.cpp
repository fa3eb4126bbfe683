// SPDX-License-Identifier: MIT
#include "servers/core/log.h"

#include <cstdio>
#include <set>

namespace lucent {

namespace {

bool verbose = false;

void default_handler(LogLevel p_level, std::string_view p_message) {
	if (p_level == LogLevel::INFO && !verbose) {
		return;
	}
	const char *prefix = p_level == LogLevel::ERROR ? "error: " : (p_level == LogLevel::WARNING ? "warning: " : "");
	fmt::print(stderr, "{}{}\n", prefix, p_message);
}

LogHandler handler = default_handler;

} // namespace

LogHandler set_log_handler(LogHandler p_handler) {
	LogHandler previous = handler;
	handler = p_handler ? std::move(p_handler) : LogHandler(default_handler);
	return previous;
}

void set_log_verbose(bool p_verbose) {
	verbose = p_verbose;
}

void log_message(LogLevel p_level, std::string_view p_message) {
	handler(p_level, p_message);
}

void log_warning_once(const std::string &p_key, std::string_view p_message) {
	static std::set<std::string> said;
	if (said.insert(p_key).second) {
		log_message(LogLevel::WARNING, p_message);
	}
}

} // namespace lucent
