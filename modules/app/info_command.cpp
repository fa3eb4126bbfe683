// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_driver.h"
#include "modules/app/commands.h"
#include "modules/app/exit_codes.h"

#include <cstdio>

namespace lucent {

#ifdef __clang__
static const char COMPILER[] = __VERSION__; // names itself: "Clang 14 …"
#else
static const char COMPILER[] = "GCC " __VERSION__;
#endif

static const char HELP[] = "usage: lucent info\n"
						   "\n"
						   "Lists the usable Vulkan devices, best first, with the optional features that each has.\n"
						   "The index is what --device of `lucent render` takes, besides a part of the name.\n"
						   "\n"
						   "Example:\n"
						   "  lucent info\n"
						   "\n";

static const char *type_name(DeviceType p_type) {
	static const char *const NAMES[] = { "discrete", "integrated", "virtual", "cpu", "other" };
	return NAMES[size_t(p_type)];
}

static void print_device(size_t p_index, const DeviceInfo &p_info) {
	std::printf("%zu: %s (%s)\n", p_index, p_info.name.c_str(), type_name(p_info.type));
	std::printf("   driver:            %s\n", p_info.driver.c_str());
	std::printf("   Vulkan:            %s\n", p_info.api_version.c_str());
	std::printf("   subgroup size:     %u\n", p_info.subgroup_size);
	std::printf("   timestamps:        %s\n", p_info.timestamps ? "yes" : "no");
	std::printf("   largest texture:   %u texels an axis\n", p_info.max_texture_2d_texels);
	std::string features;
	for (const std::string &feature : p_info.optional_features) {
		features += (features.empty() ? "" : ", ") + feature;
	}
	std::printf("   optional features: %s\n", features.empty() ? "none" : features.c_str());
}

int info_command(const std::vector<std::string> &p_args) {
	if (!p_args.empty()) {
		const bool help = p_args[0] == "--help" || p_args[0] == "-h";
		if (!help) {
			log_error("lucent info takes no '{}'", p_args[0]);
			return EXIT_USAGE;
		}
		std::fputs(HELP, stdout);
		std::fputs(EXIT_CODES_HELP, stdout);
		return EXIT_OK;
	}
	std::printf("lucent %s, built by %s\n", LUCENT_VERSION, COMPILER);
	const Result<std::vector<DeviceInfo>> devices = list_vulkan_devices();
	if (!devices) {
		log_error("{}", devices.error().message);
		return EXIT_DEVICE;
	}
	for (size_t i = 0; i < devices.value().size(); i++) {
		print_device(i, devices.value()[i]);
	}
	if (devices.value().empty()) {
		log_error("no usable Vulkan 1.3 device; on Debian, 'apt-get install mesa-vulkan-drivers' brings one that runs on the CPU");
		return EXIT_DEVICE;
	}
	return EXIT_OK;
}

} // namespace lucent
