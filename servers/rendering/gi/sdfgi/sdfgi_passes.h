// SPDX-License-Identifier: MIT
#pragma once
// SDFGI's own passes in execution order; the world's build passes are in gi/world/gi_world.cpp.

#include "servers/rendering/device/pass_recorder.h"
#include "servers/rendering/gi/sdfgi/sdfgi_io.h"
#include "servers/rendering/gi/world/gi_world.h"

namespace lucent {

// What the passes share. Handles of one frame.
struct SdfgiPassInputs {
	const GiWorld &world;
	BufferHandle probe_params; // uniform ProbeParams
	BufferHandle probe_places;
	BufferHandle probe_list; // by cascade: ProbeListHeader, then places
	TextureHandle radiance_atlas;
	TextureHandle irradiance_atlas;
	SamplerHandle probe_sampler;
	TextureHandle sky;
	BufferHandle lights;
	BufferHandle statistics;
	BufferHandle ray_cache; // a word a ray
	uint32_t probes_in_cascade = 0;
	BufferHandle fetch_counts; // FetchCounts a pass
	bool counts_fetches = false;
	uint32_t probe_rays = 0; // of a probe in a frame
	uint32_t probe_radiance_texels = 0; // an axis
	uint32_t probe_irradiance_texels = 0;

	uint32_t probe_list_words(uint32_t p_cascade) const { return p_cascade * (PROBE_LIST_HEADER_WORDS + probes_in_cascade); }
	uint32_t far_slice() const { return (probes_in_cascade + PROBE_FAR_PERIOD - 1) / PROBE_FAR_PERIOD; }
};

// Binds the fetches' counts for a pass that includes fetch_counts_inc.glsl.
inline void bind_fetch_counts(ComputePass &r_pass, const SdfgiPassInputs &p_in) {
	r_pass.read_write(WORLD_FETCH_COUNTS, p_in.fetch_counts);
	if (p_in.counts_fetches) {
		r_pass.specialize(COUNT_FETCHES_ID, 1);
	}
}

void place_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade);
void trace_records(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, const shader::RecordRaysConstants &p_constants);
void light_lamps(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, const shader::RecordRaysConstants &p_constants);
void light_records(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, const shader::LightRecordsConstants &p_constants);
void trace_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade, bool p_far);
void filter_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade, bool p_far);

// Binds what gi_sample_inc.glsl declares.
template <typename Pass>
void bind_gi_sampling(Pass &r_pass, const SdfgiPassInputs &p_in, uint32_t p_base = 0) {
	p_in.world.bind_light(r_pass, p_in.sky, p_base);
	r_pass.uniform(p_base + GI_PROBE_PARAMS, p_in.probe_params).read(p_base + GI_PROBE_IRRADIANCE, p_in.irradiance_atlas).read(p_base + GI_PROBE_RADIANCE, p_in.radiance_atlas).read(p_base + GI_PROBE_OFFSETS, p_in.probe_places).sampler(p_base + GI_PROBE_SAMPLER, p_in.probe_sampler);
}

} // namespace lucent
