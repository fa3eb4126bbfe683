// SPDX-License-Identifier: MIT
#include "servers/rendering/gi/sdfgi/sdfgi_passes.h"

#include "servers/rendering/gi/world/world_io.h"

#include <cstddef>

namespace lucent {

namespace {

// Bindings that these passes' shaders declare for themselves.
constexpr uint32_t OUT_0 = 20;
constexpr uint32_t OUT_1 = 21;
constexpr uint32_t OUT_2 = 22;

} // namespace

void place_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade) {
	const shader::ClearWordsConstants clear = { .first = p_in.probe_list_words(p_cascade), .count = PROBE_LIST_HEADER_WORDS, .value = 0 };
	r_recorder.compute("sdfgi.clear_probe_list", Shader::CLEAR_WORDS).write(0, p_in.probe_list).constants(clear).dispatch_groups(1);
	const shader::TraceProbesConstants constants = { .cascade = p_cascade, .far = 0 };
	ComputePass pass = r_recorder.compute("sdfgi.place_probes", Shader::PLACE_PROBES);
	p_in.world.bind_trace(pass);
	pass.uniform(GI_PROBE_PARAMS, p_in.probe_params).write(OUT_0, p_in.probe_places).read_write(PROBE_LIST, p_in.probe_list).constants(constants).dispatch_threads(p_in.probes_in_cascade);
}

namespace {

// Binds what all passes over records share.
ComputePass record_pass(PassRecorder &r_recorder, const char *p_name, Shader p_shader, const SdfgiPassInputs &p_in) {
	ComputePass pass = r_recorder.compute(p_name, p_shader);
	p_in.world.bind_light(pass, p_in.sky);
	pass.read(RECORD_RAYS_COUNTS, p_in.world.counts_handle()).read_write(RECORD_RAYS_STATISTICS, p_in.statistics);
	bind_fetch_counts(pass, p_in);
	return pass;
}

void dispatch_records(ComputePass &r_pass, const SdfgiPassInputs &p_in, uint32_t p_cascade) {
	r_pass.dispatch_indirect(p_in.world.counts_handle(), p_cascade * sizeof(shader::CascadeCounts) + offsetof(shader::CascadeCounts, light_groups));
}

} // namespace

void trace_records(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, const shader::RecordRaysConstants &p_constants) {
	ComputePass pass = record_pass(r_recorder, "sdfgi.trace_records", Shader::TRACE_RECORDS, p_in);
	pass.read(TRACE_RECORDS_EMITTERS, p_in.world.emitters_handle())
			.read(TRACE_RECORDS_EMITTER_COUNT, p_in.world.emitter_count_handle())
			.read_write(RECORD_RAYS_STATE, p_in.world.record_state_handle())
			.write(RECORD_RAYS_CACHE, p_in.ray_cache)
			.constants(p_constants);
	dispatch_records(pass, p_in, p_constants.cascade);
}

void light_lamps(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, const shader::RecordRaysConstants &p_constants) {
	ComputePass pass = record_pass(r_recorder, "sdfgi.light_lamps", Shader::LIGHT_LAMPS, p_in);
	pass.read(LIGHT_LAMPS_LIGHTS, p_in.lights).read_write(RECORD_RAYS_STATE, p_in.world.record_state_handle()).constants(p_constants);
	dispatch_records(pass, p_in, p_constants.cascade);
}

void light_records(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, const shader::LightRecordsConstants &p_constants) {
	ComputePass pass = record_pass(r_recorder, "sdfgi.light_records", Shader::LIGHT_RECORDS, p_in);
	pass.read(RECORD_RAYS_STATE, p_in.world.record_state_handle()).read(RECORD_RAYS_CACHE, p_in.ray_cache).write(LIGHT_RECORDS_OUT, p_in.world.next_light_handle()).constants(p_constants);
	dispatch_records(pass, p_in, p_constants.cascade);
}

void trace_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade, bool p_far) {
	const shader::TraceProbesConstants constants = { .cascade = p_cascade, .far = p_far ? 1u : 0u };
	ComputePass pass = r_recorder.compute(p_far ? "sdfgi.trace_far_probes" : "sdfgi.trace_probes", Shader::TRACE_PROBES);
	p_in.world.bind_light(pass, p_in.sky);
	pass.uniform(GI_PROBE_PARAMS, p_in.probe_params).read(GI_PROBE_OFFSETS, p_in.probe_places).read(PROBE_LIST, p_in.probe_list).read_write(OUT_1, p_in.radiance_atlas).read_write(OUT_2, p_in.statistics).constants(constants);
	bind_fetch_counts(pass, p_in);
	if (p_far) {
		pass.dispatch_threads(p_in.far_slice() * p_in.probe_rays);
	} else {
		pass.dispatch_indirect(p_in.probe_list, 4 * p_in.probe_list_words(p_cascade) + offsetof(shader::ProbeListHeader, trace_groups));
	}
}

void filter_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade, bool p_far) {
	const shader::TraceProbesConstants constants = { .cascade = p_cascade, .far = p_far ? 1u : 0u };
	ComputePass pass = r_recorder.compute(p_far ? "sdfgi.filter_far_probes" : "sdfgi.filter_probes", Shader::FILTER_PROBES);
	pass.uniform(WORLD_PARAMS, p_in.world.params_handle()).uniform(GI_PROBE_PARAMS, p_in.probe_params).read(GI_PROBE_OFFSETS, p_in.probe_places).read(PROBE_LIST, p_in.probe_list).read_write(OUT_0, p_in.radiance_atlas).write(OUT_1, p_in.irradiance_atlas).constants(constants);
	pass.specialize(PROBE_RADIANCE_TEXELS_ID, p_in.probe_radiance_texels).specialize(PROBE_IRRADIANCE_TEXELS_ID, p_in.probe_irradiance_texels).specialize(PROBE_FILTER_LANES_ID, p_in.probe_irradiance_texels + PROBE_BORDER_TEXELS);
	bind_fetch_counts(pass, p_in);
	if (p_far) {
		pass.dispatch_groups(p_in.far_slice());
	} else {
		pass.dispatch_indirect(p_in.probe_list, 4 * p_in.probe_list_words(p_cascade) + offsetof(shader::ProbeListHeader, filter_groups));
	}
}

} // namespace lucent
