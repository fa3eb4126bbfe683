// SPDX-License-Identifier: MIT
#include "servers/rendering/passes/screen_passes.h"

#include "servers/rendering/passes/frame_io.h"

namespace lucent {

void sky_octahedral(PassRecorder &r_recorder, const SkyInputs &p_in, TextureHandle p_target, uint32_t p_size_texels) {
	r_recorder.compute("sky_octahedral", Shader::SKY_OCTAHEDRAL)
			.uniform(SKY_DATA, p_in.sky)
			.read(SKY_PANORAMA, p_in.panorama)
			.sampler(SKY_PANORAMA_SAMPLER, p_in.sampler)
			.write(SKY_TARGET, p_target)
			.dispatch_threads(p_size_texels, p_size_texels);
}

void sky_irradiance(PassRecorder &r_recorder, TextureHandle p_octahedral, TextureHandle p_target, uint32_t p_size_texels) {
	r_recorder.compute("sky_irradiance", Shader::SKY_IRRADIANCE)
			.read(SKY_SOURCE, p_octahedral)
			.write(SKY_TARGET, p_target)
			.dispatch_threads(p_size_texels, p_size_texels);
}

void sky_radiance(PassRecorder &r_recorder, TextureHandle p_octahedral, SamplerHandle p_linear_clamp, TextureHandle p_target, uint32_t p_size_texels) {
	for (uint32_t layer = 0; layer < SKY_RADIANCE_LAYERS; layer++) {
		r_recorder.compute("sky_radiance", Shader::SKY_RADIANCE)
				.read(SKY_SOURCE, p_octahedral)
				.sampler(SKY_PANORAMA_SAMPLER, p_linear_clamp)
				.write(SKY_TARGET, TextureView{ p_target, 0, layer })
				.constants(shader::SkyRadianceConstants{ float(layer) / float(SKY_RADIANCE_LAYERS - 1) })
				.dispatch_threads(p_size_texels, p_size_texels);
	}
}

void draw_sky(PassRecorder &r_recorder, const SkyInputs &p_in, TextureHandle p_depth, TextureHandle p_color, uint32_t p_width, uint32_t p_height) {
	r_recorder.compute("draw_sky", Shader::DRAW_SKY)
			.uniform(SKY_DATA, p_in.sky)
			.read(SKY_PANORAMA, p_in.panorama)
			.sampler(SKY_PANORAMA_SAMPLER, p_in.sampler)
			.read(SKY_DEPTH, p_depth)
			.write(SKY_TARGET, p_color)
			.dispatch_threads(p_width, p_height);
}

void light_clusters(PassRecorder &r_recorder, const LightClustersInputs &p_in) {
	r_recorder.compute("light_clusters", Shader::LIGHT_CLUSTERS)
			.uniform(LIGHT_CLUSTERS_FRAME, p_in.frame)
			.read(LIGHT_CLUSTERS_LIGHTS, p_in.lights)
			.write(LIGHT_CLUSTERS_MASKS, p_in.masks)
			.constants(p_in.constants)
			.dispatch_threads(p_in.mask_count);
}

void tonemap(PassRecorder &r_recorder, TextureHandle p_color, TextureHandle p_display, const shader::TonemapConstants &p_constants, uint32_t p_width, uint32_t p_height) {
	r_recorder.compute("tonemap", Shader::TONEMAP)
			.read(TONEMAP_SOURCE, p_color)
			.write(TONEMAP_TARGET, p_display)
			.constants(p_constants)
			.dispatch_threads(p_width, p_height);
}

} // namespace lucent
