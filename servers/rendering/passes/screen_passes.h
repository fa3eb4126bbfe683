// SPDX-License-Identifier: MIT
#pragma once
// Compute passes over the screen and the sky's maps.

#include "servers/rendering/device/pass_recorder.h"
#include "servers/rendering/passes/light_clusters_io.h"
#include "servers/rendering/passes/sky_io.h"
#include "servers/rendering/passes/tonemap_io.h"

namespace lucent {

struct SkyInputs {
	BufferHandle sky; // shader::SkyData
	TextureHandle panorama; // any texture where there is none
	SamplerHandle sampler; // linear, u repeats
};
// target: RGBA16_FLOAT, square.
void sky_octahedral(PassRecorder &r_recorder, const SkyInputs &p_in, TextureHandle p_target, uint32_t p_size_texels);
void sky_irradiance(PassRecorder &r_recorder, TextureHandle p_octahedral, TextureHandle p_target, uint32_t p_size_texels);
// One layer of the target for each roughness.
void sky_radiance(PassRecorder &r_recorder, TextureHandle p_octahedral, SamplerHandle p_linear_clamp, TextureHandle p_target, uint32_t p_size_texels);
void draw_sky(PassRecorder &r_recorder, const SkyInputs &p_in, TextureHandle p_depth, TextureHandle p_color, uint32_t p_width, uint32_t p_height);

struct LightClustersInputs {
	BufferHandle frame, lights;
	BufferHandle masks; // out
	shader::LightClustersConstants constants;
	uint32_t mask_count = 0;
};
void light_clusters(PassRecorder &r_recorder, const LightClustersInputs &p_in);

void tonemap(PassRecorder &r_recorder, TextureHandle p_color, TextureHandle p_display, const shader::TonemapConstants &p_constants, uint32_t p_width, uint32_t p_height);

} // namespace lucent
