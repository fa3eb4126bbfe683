// SPDX-License-Identifier: MIT
#include "modules/app/commands.h"
#include "modules/app/exit_codes.h"
#include "servers/core/log.h"

#include <cstdio>
#include <exception>
#include <new>

namespace lucent {

static const char HELP[] = "Lucent: real-time global illumination from signed distance fields.\n"
						   "\n"
						   "usage: lucent COMMAND [OPTIONS]\n"
						   "       lucent COMMAND --help\n"
						   "\n"
						   "Commands:\n"
						   "  render     draw a scene (.tscn, .glb, .gltf) into pictures (.png, .exr), without a window\n"
						   "  reference  path-trace a scene: the truth for what render draws (.exr)\n"
						   "  compare    say how far a picture is from the truth\n"
						   "  bench      measure quality, speed and response; write tables and reports\n"
						   "  info       list Vulkan devices and what they can do\n"
						   "  doctool    write the class reference as Godot-format XML\n"
						   "\n"
						   "Options:\n"
						   "  --version  print the version\n"
						   "  --help     print this\n"
						   "\n"
						   "Examples:\n"
						   "  lucent render doc/samples/cornell/cornell.tscn -o cornell.png\n"
						   "  lucent render model.glb -o model.png -o model.exr --size 1920x1080\n"
						   "  lucent info\n"
						   "\n";

struct Command {
	const char *name;
	int (*run)(const std::vector<std::string> &p_args);
};

static const Command COMMANDS[] = {
#ifdef MODULE_SCENE_ENABLED
	{ "render", render_command },
	{ "doctool", doctool_command },
#endif
#if defined(MODULE_REFERENCE_ENABLED) && defined(MODULE_SCENE_ENABLED) && defined(MODULE_IMAGE_ENABLED)
	{ "reference", reference_command },
#endif
#if defined(MODULE_REFERENCE_ENABLED) && defined(MODULE_IMAGE_ENABLED)
	{ "compare", compare_command },
#endif
#if defined(MODULE_BENCH_ENABLED) && defined(MODULE_SCENE_ENABLED)
	{ "bench", bench_command },
#endif
	{ "info", info_command },
};

static int run(const std::vector<std::string> &p_args) {
	if (p_args.empty() || p_args[0] == "--help" || p_args[0] == "-h" || p_args[0] == "help") {
		std::fputs(HELP, p_args.empty() ? stderr : stdout);
		std::fputs(EXIT_CODES_HELP, p_args.empty() ? stderr : stdout);
		return p_args.empty() ? EXIT_USAGE : EXIT_OK;
	}
	if (p_args[0] == "--version") {
		std::printf("lucent %s\n", LUCENT_VERSION);
		return EXIT_OK;
	}
	for (const Command &command : COMMANDS) {
		if (p_args[0] == command.name) {
			return command.run({ p_args.begin() + 1, p_args.end() });
		}
	}
	log_error("there is no command '{}'; 'lucent --help' lists them", p_args[0]);
	return EXIT_USAGE;
}

} // namespace lucent

int main(int p_count, char **p_args) {
	// The last resort: whatever a library throws past its wrapper ends as one line, not as an abort.
	try {
		return lucent::run({ p_args + (p_count > 0 ? 1 : 0), p_args + p_count });
	} catch (const std::bad_alloc &) {
		lucent::log_error("out of memory");
	} catch (const std::exception &exception) {
		lucent::log_error("{}", exception.what());
	}
	return lucent::EXIT_DEVICE;
}
