// SPDX-License-Identifier: MIT
#pragma once
// What a viewport keeps between frames: screen targets, sky maps, shadow maps, buffers.

#include "servers/rendering/frame_setup.h"
#include "servers/rendering/passes/screen_passes.h"
#include "servers/rendering/passes/surface_passes.h"
#include "servers/rendering/shadow_maps.h"

namespace lucent {

struct ScreenTargets {
	OwnedTexture depth, normal_roughness, motion, gi_irradiance, gi_radiance, color, display;
	OwnedTexture direct, indirect_diffuse, indirect_specular, emission, albedo; // only with p_aov
	uint32_t width = 0;
	uint32_t height = 0;
	bool aov = false;
	// Remakes what does not fit.
	void resize(RenderingDevice &p_device, uint32_t p_width, uint32_t p_height, bool p_aov);
	AovTargets aov_targets() const { return { direct, indirect_diffuse, indirect_specular, emission, albedo }; }
};

// The sky by direction, made anew only when it changes.
class SkyMaps {
public:
	static constexpr uint32_t OCTAHEDRAL_SIZE_TEXELS = 128;
	static constexpr uint32_t IRRADIANCE_SIZE_TEXELS = 32;
	static constexpr uint32_t RADIANCE_SIZE_TEXELS = 64;

	explicit SkyMaps(RenderingDevice &p_device);
	// Uploads the sky's data; true: the maps must be drawn again.
	bool update(const shader::SkyData &p_sky, TextureHandle p_panorama);
	void draw(PassRecorder &r_recorder);

	SkyInputs inputs() const;
	TextureHandle octahedral() const { return octahedral_map; }
	TextureHandle irradiance() const { return irradiance_map; }
	TextureHandle radiance() const { return radiance_map; }

private:
	RenderingDevice &device;
	OwnedBuffer data_buffer;
	OwnedTexture octahedral_map, irradiance_map, radiance_map;
	TextureHandle panorama;
	shader::SkyData uploaded{};
	bool drawn = false;
};

struct ViewportState {
	explicit ViewportState(RenderingDevice &p_device);
	ScreenTargets targets;
	SkyMaps sky;
	ShadowMaps shadows;
	OwnedBuffer frame_buffer;
	GrowingBuffer draw_instances, cluster_masks;
	std::vector<uint32_t> uploaded_instances;
	// Of the last drawn frame.
	Transform3D previous_camera; // world
	Projection previous_clip_from_view{ 1.0f };
	bool drawn = false;
};

} // namespace lucent
