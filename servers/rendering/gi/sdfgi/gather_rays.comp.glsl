// SPDX-License-Identifier: MIT
// The pixels that gather_gi listed: probes with visibility where no record answers, and one ray for the mirror direction of glossy
// surfaces.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/sdfgi/gather_inc.glsl"

vec3 traced_reflection(vec3 position_m, vec3 normal, vec3 view) {
	uint cascade = finest_cascade(position_m);
	if (cascade >= world.cascade_count) {
		return world_sky_radiance(reflect(-view, normal));
	}
	GiQuery query = GiQuery(position_m, normal, view, 0.0, position_m, false);
	find_query_start(query, cascade, true);
	vec3 direction = reflect(-view, normal);
	WorldHit hit = trace_world(query.start_m, direction, 1e6, cascade);
	return hit.hit ? hit_radiance(hit, direction) : world_sky_radiance(direction);
}

void gather_pixel(ivec2 pixel) {
	GatherSurface surface;
	if (!load_surface(pixel, surface)) {
		return;
	}
	GiSample gi = gi_sample(surface.position_m, surface.normal, surface.view, surface.roughness);
	if (reflection_is_traced(surface)) {
		float traced = 1.0 - smoothstep(GI_TRACED_ROUGHNESS, GI_UNTRACED_ROUGHNESS, surface.roughness);
		gi.radiance = mix(gi.radiance, traced_reflection(surface.position_m, surface.normal, surface.view) * probe_params.energy * gi.weight, traced);
	}
	store_gi(pixel, gi);
	if (gi.startless) {
		atomicAdd(gather_counts.startless, 1u);
	}
	if (gi.weight > 0.0 && gi.from_records == 0.0) {
		atomicAdd(gather_counts.recordless, 1u);
	}
}

void main() {
	uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
	if (i >= gather_counts.listed) {
		return;
	}
	gather_pixel(ivec2(uvec2(ray_pixels[i], ray_pixels[i] >> 16) & 0xFFFFu));
	count_fetch(4u);
	store_fetches(FETCHES_GATHER_RAYS);
}
