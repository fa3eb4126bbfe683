// SPDX-License-Identifier: MIT
#pragma once

namespace lucent {

// What the program returns; --help lists them.
enum ExitCode : int {
	EXIT_OK = 0,
	EXIT_DEVICE = 1, // no device, or rendering failed
	EXIT_USAGE = 2, // an argument is wrong
	EXIT_BAD_INPUT = 3, // a scene or resource can't be read
	EXIT_OUTPUT = 4, // a result can't be written
	EXIT_WORSE = 5, // a compared figure is beyond its --threshold
};

inline constexpr const char *EXIT_CODES_HELP = "Exit codes:\n"
											   "  0  done\n"
											   "  1  no usable Vulkan device, or rendering failed\n"
											   "  2  an argument is wrong\n"
											   "  3  a scene or resource can't be read\n"
											   "  4  a result can't be written\n"
											   "  5  lucent compare: a figure is beyond its --threshold; lucent bench response: a picture at rest moves, or two runs differ\n";

} // namespace lucent
