// SPDX-License-Identifier: MIT
#include "servers/core/caller_error.h"

#include <utility>

namespace lucent {

void invariant_failed(const char *p_function, const char *p_file, int p_line, const char *p_condition, const std::string &p_message) {
	log_error("invariant '{}' failed in {} ({}:{}): {}", p_condition, p_function, p_file, p_line, p_message);
	std::abort();
}

static CallerErrorHandler caller_error_handler;

CallerErrorHandler set_caller_error_handler(CallerErrorHandler p_handler) {
	return std::exchange(caller_error_handler, std::move(p_handler));
}

void report_caller_error(const char *p_function, const char *p_file, int p_line, const std::string &p_message) {
	if (caller_error_handler && caller_error_handler(p_message)) {
		return;
	}
	log_error("{} ({}:{}): {}", p_function, p_file, p_line, p_message);
}

} // namespace lucent
