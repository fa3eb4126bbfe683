// SPDX-License-Identifier: MIT
#include "servers/rendering/gi/sdfgi/sdfgi_passes.h"

#include <cstddef>

namespace lucent {

namespace {

// Bindings that these passes' shaders declare for themselves.
constexpr uint32_t OUT_0 = 20;
constexpr uint32_t OUT_1 = 21;
constexpr uint32_t OUT_2 = 22;

} // namespace

void place_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade) {
	const shader::TraceProbesConstants constants = { .cascade = p_cascade };
	ComputePass pass = r_recorder.compute("sdfgi.place_probes", Shader::PLACE_PROBES);
	p_in.world.bind_trace(pass);
	pass.uniform(GI_PROBE_PARAMS, p_in.probe_params).write(OUT_0, p_in.probe_places).constants(constants).dispatch_threads(p_in.probes_in_cascade);
}

void light_records(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, const shader::LightRecordsConstants &p_constants) {
	ComputePass pass = r_recorder.compute("sdfgi.light_records", Shader::LIGHT_RECORDS);
	p_in.world.bind_light(pass, p_in.sky);
	pass.read(LIGHT_RECORDS_LIGHTS, p_in.lights)
			.read(LIGHT_RECORDS_COUNTS, p_in.world.counts_handle())
			.read(LIGHT_RECORDS_EMITTERS, p_in.world.emitters_handle())
			.read(LIGHT_RECORDS_EMITTER_COUNT, p_in.world.emitter_count_handle())
			.read_write(LIGHT_RECORDS_STATE, p_in.world.record_state_handle())
			.write(LIGHT_RECORDS_OUT, p_in.world.next_light_handle())
			.read_write(LIGHT_RECORDS_STATISTICS, p_in.statistics)
			.constants(p_constants)
			.dispatch_indirect(p_in.world.counts_handle(), p_constants.cascade * sizeof(shader::CascadeCounts) + offsetof(shader::CascadeCounts, light_groups));
}

void trace_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade) {
	const shader::TraceProbesConstants constants = { .cascade = p_cascade };
	ComputePass pass = r_recorder.compute("sdfgi.trace_probes", Shader::TRACE_PROBES);
	p_in.world.bind_light(pass, p_in.sky);
	pass.uniform(GI_PROBE_PARAMS, p_in.probe_params).read(OUT_0, p_in.probe_places).read_write(OUT_1, p_in.radiance_atlas).read_write(OUT_2, p_in.statistics).constants(constants).dispatch_threads(p_in.probes_in_cascade * p_in.probe_rays);
}

void filter_probes(PassRecorder &r_recorder, const SdfgiPassInputs &p_in, uint32_t p_cascade) {
	const shader::TraceProbesConstants constants = { .cascade = p_cascade };
	r_recorder.compute("sdfgi.filter_probes", Shader::FILTER_PROBES)
			.uniform(WORLD_PARAMS, p_in.world.params_handle())
			.uniform(GI_PROBE_PARAMS, p_in.probe_params)
			.read_write(OUT_0, p_in.radiance_atlas)
			.write(OUT_1, p_in.irradiance_atlas)
			.read(OUT_2, p_in.probe_places)
			.constants(constants)
			.dispatch_groups(256, (p_in.probes_in_cascade + 255) / 256);
}

} // namespace lucent
