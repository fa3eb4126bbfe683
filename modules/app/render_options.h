// SPDX-License-Identifier: MIT
#pragma once
// The command line of `lucent render`, checked.

#include "servers/core/error.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lucent {

struct RenderOptions {
	std::string scene;
	std::vector<std::string> outputs; // .png or .exr each
	uint32_t width = 1280;
	uint32_t height = 720;
	uint32_t frames = 0; // 0: until converged
	std::string camera; // node name or path; empty: the scene's current camera
	std::vector<std::string> settings; // 'NodePath:property=value'
	std::vector<std::string> aovs; // names of AOV_NAMES
	std::string stats;
	std::string device;
	std::string debug_view;
	std::string reload_shaders; // source root; empty: off
	bool quiet = false;
	bool verbose = false;
	bool strict = false; // a part that can't be read is an error
	bool validation = false;
};

// Frames drawn at most while waiting for convergence.
inline constexpr uint32_t MAX_FRAMES_TO_CONVERGE = 1024;
inline constexpr uint32_t MAX_IMAGE_SIZE = 16384; // an axis

inline constexpr const char *AOV_NAMES[] = { "direct", "indirect_diffuse", "indirect_specular", "emission", "albedo", "normal", "depth", "motion" };

// "1280x720" into width and height.
Status parse_size(const std::string &p_text, RenderOptions &r_options);

struct ParsedOptions {
	RenderOptions options;
	bool exit = false; // --help was printed
};
Result<ParsedOptions> parse_render_options(const std::vector<std::string> &p_args);

} // namespace lucent
