// SPDX-License-Identifier: MIT
// Traces the probes of one cascade, one ray a lane. A probe's octahedral radiance has one stratum a texel; each frame takes the
// next `rays` of them, each ray is jittered within its texel and goes into the texel's running mean.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/sdfgi/probe_list_inc.glsl"
#include "servers/rendering/gi/world/fetch_counts_inc.glsl"
#include "servers/rendering/gi/world/surface_light_inc.glsl"
#include "servers/rendering/shaders/sampling_inc.glsl"

#define TRACE_PROBES_RADIANCE 21
#define TRACE_PROBES_STATISTICS 22

layout(local_size_x = 64) in;
layout(set = 0, binding = TRACE_PROBES_RADIANCE, rgba16f) uniform image2D radiance_atlas;
layout(set = 0, binding = TRACE_PROBES_STATISTICS, scalar) buffer StatisticsBlock {
	SdfgiStatistics statistics;
};
shared uint group_rays;

void trace_ray(uint place, uint ray) {
	uint index = constants.cascade * probes_in_cascade() + place;
	ivec3 probe = probe_at_place(constants.cascade, place);
	uint across = probe_params.radiance_texels;
	uint texels = across * across;
	count_fetch(4u);
	ProbePlace probe_place = places[index];
	uint texel_index = (probe_turn(probe_place, probe_params.running_frame) * probe_params.rays + ray) % texels;
	uint visit = (probe_turn(probe_place, probe_params.frame) * probe_params.rays + ray) / texels;
	ivec2 texel = ivec2(int(texel_index % across), int(texel_index / across));
	ivec2 at = probe_tile(index, int(across) + 2) + 1 + texel;
	if (!probe_is_free(probe_place)) {
		imageStore(radiance_atlas, at, vec4(0.0));
		return;
	}
	uint seed = hash_uint(uint(probe.x) * 73856093u ^ hash_uint(uint(probe.y) * 19349663u ^ hash_uint(uint(probe.z) * 83492791u ^ texel_index)));
	vec3 direction = direction_of_texel(texel, int(across), r2_point(visit % probe_params.average_frames, seed));
	vec3 origin_m = probe_position_m(constants.cascade, probe, probe_place);
	atomicAdd(group_rays, 1u);
	WorldHit hit = trace_world(origin_m, direction, 1e6, finest_cascade(origin_m));
	vec3 radiance = hit.hit ? hit_radiance(hit, direction) : world_sky_radiance(direction);
	count_fetch(8u);
	vec3 mean = imageLoad(radiance_atlas, at).rgb;
	float weight = 1.0 / float(min(visit, probe_params.average_frames - 1u) + 1u);
	imageStore(radiance_atlas, at, vec4(min(mix(mean, radiance, weight), vec3(65000.0)), 1.0));
}

void main() {
	if (gl_LocalInvocationIndex == 0u) {
		group_rays = 0u;
	}
	barrier();
	uint id = gl_GlobalInvocationID.x;
	uint place = place_of_slot(id / probe_params.rays);
	if (place != NO_PLACE) {
		trace_ray(place, id % probe_params.rays);
	}
	barrier();
	if (gl_LocalInvocationIndex == 0u && group_rays > 0u) {
		atomicAdd(statistics.rays, group_rays);
	}
	store_fetches(constants.far == 0u ? FETCHES_TRACE_PROBES : FETCHES_TRACE_FAR_PROBES);
}
