// SPDX-License-Identifier: MIT
#pragma once
// Three kinds of error (doc/conventions.md):
//   ERR_FAIL_*   the caller's mistake: says function, file, line and a sentence, returns the documented default;
//   INVARIANT    our own bug: prints and aborts;
//   Result<T>    a bad file or a machine that can't: carried to whoever can tell the user.

#include "servers/core/log.h"

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

namespace lucent {

// What went wrong, ready to print: "cornell.tscn:12: expected a number after '=', found 'abc'".
struct Error {
	std::string message;
};

// A value or an Error. Check before use: value() of a failed result aborts.
template <typename T>
class [[nodiscard]] Result {
public:
	Result(T p_value) :
			stored_value(std::move(p_value)) {}
	Result(Error p_error) :
			stored_error(std::move(p_error)) {}

	bool ok() const { return stored_value.has_value(); }
	explicit operator bool() const { return ok(); }
	T &value() {
		require();
		return *stored_value;
	}
	const T &value() const {
		require();
		return *stored_value;
	}
	T take() {
		require();
		return std::move(*stored_value);
	}
	const Error &error() const { return stored_error; }

private:
	void require() const {
		if (!stored_value.has_value()) {
			log_error("Result::value() of a failed result: {}", stored_error.message);
			std::abort();
		}
	}
	std::optional<T> stored_value;
	Error stored_error;
};

struct Ok {};
using Status = Result<Ok>;

template <typename... Args>
Error make_error(fmt::format_string<Args...> p_format, Args &&...p_args) {
	return Error{ fmt::format(p_format, std::forward<Args>(p_args)...) };
}

[[noreturn]] void invariant_failed(const char *p_function, const char *p_file, int p_line, const char *p_condition, const std::string &p_message);
void report_caller_error(const char *p_function, const char *p_file, int p_line, const std::string &p_message);

} // namespace lucent

#define ERR_FAIL_COND_MSG(m_cond, ...) \
	do { \
		if (m_cond) [[unlikely]] { \
			::lucent::report_caller_error(__func__, __FILE__, __LINE__, ::fmt::format(__VA_ARGS__)); \
			return; \
		} \
	} while (false)

#define ERR_FAIL_COND_V_MSG(m_cond, m_return, ...) \
	do { \
		if (m_cond) [[unlikely]] { \
			::lucent::report_caller_error(__func__, __FILE__, __LINE__, ::fmt::format(__VA_ARGS__)); \
			return m_return; \
		} \
	} while (false)

// INVARIANT(size == expected, "size {} is not {}", size, expected)
#define INVARIANT(m_cond, ...) \
	do { \
		if (!(m_cond)) [[unlikely]] { \
			::lucent::invariant_failed(__func__, __FILE__, __LINE__, #m_cond, ::fmt::format(__VA_ARGS__)); \
		} \
	} while (false)
