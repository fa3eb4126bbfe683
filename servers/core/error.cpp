// SPDX-License-Identifier: MIT
#include "servers/core/error.h"

namespace lucent {

void invariant_failed(const char *p_function, const char *p_file, int p_line, const char *p_condition, const std::string &p_message) {
	log_error("invariant '{}' failed in {} ({}:{}): {}", p_condition, p_function, p_file, p_line, p_message);
	std::abort();
}

void report_caller_error(const char *p_function, const char *p_file, int p_line, const std::string &p_message) {
	log_error("{} ({}:{}): {}", p_function, p_file, p_line, p_message);
}

} // namespace lucent
