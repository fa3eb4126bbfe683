// SPDX-License-Identifier: MIT
#include "modules/app/commands.h"
#include "modules/app/exit_codes.h"
#include "modules/app/register_modules.h"
#include "modules/scene/class_documentation.h"
#include "servers/core/class_db.h"
#include "servers/core/log.h"

#include <cstdio>

namespace lucent {

static const char HELP[] = "usage: lucent doctool DIR\n"
						   "\n"
						   "Writes one CLASS.xml for each registered class into DIR, in the format of Godot's class reference.\n"
						   "\n"
						   "Example:\n"
						   "  lucent doctool doc/classes\n"
						   "\n";

int doctool_command(const std::vector<std::string> &p_args) {
	if (p_args.size() == 1 && (p_args[0] == "--help" || p_args[0] == "-h")) {
		std::fputs(HELP, stdout);
		std::fputs(EXIT_CODES_HELP, stdout);
		return EXIT_OK;
	}
	if (p_args.size() != 1 || p_args[0].starts_with('-')) {
		log_error("lucent doctool takes one folder ('lucent doctool --help' explains)");
		return EXIT_USAGE;
	}
	register_modules();
	if (const Status status = scene::write_class_xml(p_args[0]); !status) {
		log_error("{}", status.error().message);
		return EXIT_OUTPUT;
	}
	std::printf("%s: %zu classes\n", p_args[0].c_str(), ClassDB::get_class_list().size());
	return EXIT_OK;
}

} // namespace lucent
