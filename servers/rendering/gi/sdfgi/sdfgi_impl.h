// SPDX-License-Identifier: MIT
#pragma once
// What Sdfgi holds: for sdfgi.cpp, which records frames, and sdfgi_read_back.cpp, which reads what they counted.

#include "servers/rendering/device/rendering_device.h"
#include "servers/rendering/gi/sdfgi/sdfgi.h"
#include "servers/rendering/gi/sdfgi/sdfgi_passes.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <vector>

namespace lucent {

inline constexpr uint32_t MAX_TURNS = 32; // light_records.comp.glsl keeps a bit a turn
inline constexpr uint32_t CHECK_PERIOD_FRAMES = 4; // each check waits for the device
// After a change the first frames' bounces are missing: the probes start their means anew after this many.
inline constexpr uint32_t PROBE_RESTART_FRAMES = 8;
// Rounds of each probe's texels before all counts as settled; probes that are not near take PROBE_FAR_PERIOD frames for one frame's share.
inline constexpr uint32_t PROBE_LEAST_ROUNDS = std::max(5, PROBE_FAR_PERIOD);

struct Sdfgi::Impl {
	explicit Impl(RenderingDevice &p_device) :
			device(p_device) {}

	RenderingDevice &device;
	SdfgiSettings settings;
	std::unique_ptr<GiWorld> world;
	OwnedBuffer probe_params;
	OwnedBuffer probe_places;
	OwnedBuffer probe_list;
	OwnedBuffer statistics;
	OwnedBuffer fetch_counts;
	OwnedBuffer ray_cache;
	uint32_t ray_cache_words = 0;
	OwnedBuffer ray_pixels; // of the largest picture so far
	uint32_t ray_pixel_capacity = 0;
	OwnedTexture radiance_atlas;
	OwnedTexture irradiance_atlas;
	SamplerHandle probe_sampler;
	uint32_t probes_axis = 0;
	bool cascades_placed = false;
	uint64_t geometry_version = 0;
	uint64_t light_version = 0;
	TextureHandle sky;
	BufferHandle lights;
	uint32_t light_count = 0;
	uint32_t frame = 0; // since anything changed
	uint32_t running_frame = 0;
	uint32_t turns_done = 0; // by trace_records since the geometry changed
	uint32_t lamp_turns_done = 0; // by light_lamps since anything changed
	bool light_settled = false;
	bool converged = false; // the probes too
	bool gathered = false; // in the frame that was last recorded
	bool picture_counted = false; // of a picture at rest the pixels that lack records
	uint64_t peak_rays = 0; // in a frame, since anything changed
	// Of the frame that was last recorded:
	bool checks_light = false; // its counts are to be read
	bool checks_room = false; // whether the world holds a scene that is new to it
	GiWorldRoom least_room; // what the scene has needed
	bool needs_room = false; // more than the world has
	bool may_settle = false; // it traced no more than the probes' rays
	GiStats stats;

	uint32_t turns() const { return std::clamp(settings.frames_to_converge, 1u, MAX_TURNS); }
	// Each turn traces all lamps, so many lamps have fewer turns.
	uint32_t lamp_turns() const { return std::max(turns() / std::max(std::bit_ceil(light_count) / 8, 1u), 1u); }
	// After which every texel of every probe has been traced since the first frames.
	uint32_t frames_of_probes() const { return PROBE_RESTART_FRAMES + PROBE_LEAST_ROUNDS * probe_texels() / probe_rays(); }
	uint32_t probe_texels() const { return settings.probe_radiance_texels * settings.probe_radiance_texels; }
	uint32_t probe_rays() const { return std::min(settings.probe_rays, probe_texels()); }
	uint32_t probes_in_cascade() const { return probes_axis * probes_axis * probes_axis; }
	void create(const SdfgiSettings &p_settings);
	SdfgiPassInputs pass_inputs() const;
	bool place_cascades(const Vector3 &p_camera_m, std::vector<uint32_t> &r_moved);
	void upload_probe_params(PassRecorder &r_recorder, const Vector3 &p_camera_m);
	void light_frame(PassRecorder &r_recorder);
	void restart(bool p_geometry);
	void read_fetches();
	void read_gather_counts();
	void check_room(const std::vector<shader::CascadeCounts> &p_counts);
};

} // namespace lucent
