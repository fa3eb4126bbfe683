// SPDX-License-Identifier: MIT
#include "modules/app/parse_error.h"

#include "modules/app/suggestion.h"
#include "servers/core/error.h"

namespace lucent {

static std::string extra_argument_text(const CLI::App &p_app, const std::vector<std::string> &p_extra) {
	for (const std::string &argument : p_extra) {
		if (argument.starts_with('-')) {
			std::vector<std::string> known;
			for (const CLI::Option *option : p_app.get_options([](const CLI::Option *p_option) { return !p_option->get_lnames().empty(); })) {
				known.push_back("--" + option->get_lnames().front());
			}
			const std::string name = argument.substr(0, argument.find('='));
			return fmt::format("there is no option '{}'{}", name, suggestion(name, known));
		}
	}
	return fmt::format("'{}' is one argument too many", p_extra.front());
}

std::string parse_error_text(const CLI::App &p_app, const CLI::ParseError &p_error) {
	const std::vector<std::string> extra = p_app.remaining();
	const bool is_extra = dynamic_cast<const CLI::ExtrasError *>(&p_error) != nullptr && !extra.empty();
	return fmt::format("{} ('{} --help' explains)", is_extra ? extra_argument_text(p_app, extra) : p_error.what(), p_app.get_name());
}

} // namespace lucent
