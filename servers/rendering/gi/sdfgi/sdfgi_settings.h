// SPDX-License-Identifier: MIT
#pragma once
// Every knob of SDFGI. The first group is Environment's, with Godot's names and (but for the three named) defaults.

#include <cstdint>
#include <string>

namespace lucent {

enum class SdfgiYScale : uint8_t {
	SCALE_50_PERCENT,
	SCALE_75_PERCENT,
	SCALE_100_PERCENT
};

// World y is multiplied by this before everything: cells are flatter than wide.
inline float sdfgi_y_multiplier(SdfgiYScale p_scale) {
	constexpr float MULTIPLIERS[] = { 2.0f, 1.5f, 1.0f };
	return MULTIPLIERS[uint32_t(p_scale)];
}

struct SdfgiSettings {
	bool enabled = false;
	uint32_t cascades = 4; // 1 to 8
	float min_cell_size_m = 0.2f; // 1e-6 to 1e6; cascade c has min_cell_size * 2^c
	SdfgiYScale y_scale = SdfgiYScale::SCALE_75_PERCENT;
	bool use_occlusion = true; // Godot: false. Visibility between shaded point and probe; without it walls leak
	float bounce_feedback = 1.0f; // Godot: 0.5. 1 is physical
	bool read_sky_light = true;
	float energy = 1.0f;
	float normal_bias = 1.1f; // in sub-voxels (quarter cells)
	float probe_bias = 1.1f; // in sub-voxels (quarter cells)

	// Ours: tunables without a property in Godot.
	uint32_t grid_size_cells = 128; // 64, 128 or 256; cells an axis of each cascade
	uint32_t probe_spacing_cells = 8; // 4, 8 or 16; at most 33 probes an axis
	uint32_t probe_rays = 16; // rays a probe and frame, a power of two; at most one a texel of its radiance
	uint32_t probe_radiance_texels = 8; // 4, 8 or 16; an axis of a probe's octahedral radiance, what rough reflections see
	uint32_t probe_irradiance_texels = 6; // 4 to 14; an axis of a probe's octahedral irradiance
	uint32_t frames_to_converge = 16; // frames in one full set of rays (8 rays a frame and surface record), a power of two, at most 32
	uint32_t ray_cache_mib = 96; // 1 to 1024; what gather rays met is kept, 4 bytes a ray: with less room than a full set needs, fewer are gathered from

	bool count_every_frame = false; // GiStats' rays are those of each frame; waits for the device after every frame
	bool count_fetches = false; // GiStats has fetches of each frame; slower, and waits too

	bool operator==(const SdfgiSettings &) const = default;
};

// What is wrong with settings: one sentence, or nothing.
std::string sdfgi_settings_error(const SdfgiSettings &p_settings);

} // namespace lucent
