// SPDX-License-Identifier: MIT
#pragma once
// The command line of `lucent reference`, checked.

#include "modules/app/render_options.h"
#include "modules/reference/path_tracer.h"

namespace lucent {

struct ReferenceOptions {
	RenderOptions scene; // scene, size, camera and settings
	std::string output; // .exr
	PathTracerSettings tracer;
	std::vector<std::string> aovs; // names of REFERENCE_AOV_NAMES
	std::string filter = "box";
	bool report_throughput = false;
	bool quiet = false;
	bool exit = false; // --help was printed
};

inline constexpr const char *REFERENCE_AOV_NAMES[] = { "direct", "indirect", "emission", "background", "albedo", "normal", "depth" };

Result<ReferenceOptions> parse_reference_options(const std::vector<std::string> &p_args);

} // namespace lucent
