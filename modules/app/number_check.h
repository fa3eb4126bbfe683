// SPDX-License-Identifier: MIT
#pragma once

#include "servers/core/error.h"

#include <CLI/CLI.hpp>

namespace lucent {

// Passes numbers from p_min to p_max; CLI11's own ranges let NaN through.
inline CLI::Validator number_between(double p_min, double p_max) {
	const auto check = [p_min, p_max](const std::string &p_text) {
		double value = 0;
		const bool fits = CLI::detail::lexical_cast(p_text, value) && value >= p_min && value <= p_max;
		return fits ? std::string() : fmt::format("'{}' is not a number from {:g} to {:g}", p_text, p_min, p_max);
	};
	CLI::Validator validator;
	validator.description(fmt::format("{:g} to {:g}", p_min, p_max));
	validator.operation([check](std::string &p_text) { return check(p_text); });
	return validator;
}

} // namespace lucent
