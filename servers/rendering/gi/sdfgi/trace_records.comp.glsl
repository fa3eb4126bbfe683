// SPDX-License-Identifier: MIT
// One turn of rays from surface records that only geometry and materials decide on. Each lane traces a gather ray, whose hit is cached
// for light_records, and a ray to an emissive record, whose light goes into the record's sum.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/sdfgi/record_rays_inc.glsl"
#include "servers/rendering/shaders/scene_io.h"

layout(set = 0, binding = TRACE_RECORDS_EMITTERS, scalar) readonly buffer EmittersBlock {
	Emitter emitters[];
};
layout(set = 0, binding = TRACE_RECORDS_EMITTER_COUNT, scalar) readonly buffer EmitterCountBlock {
	uint emitter_count;
};
layout(set = 0, binding = RECORD_RAYS_CACHE, scalar) writeonly buffer RayCacheBlock {
	uint ray_cache[];
};

#include "servers/rendering/gi/sdfgi/emitter_sample_inc.glsl"

shared uint group_met[GATHER_MET_KINDS];

uint kind_of_met(WorldHit hit, uint met) {
	if (!hit.hit) {
		return GATHER_MET_SKY;
	}
	if (hit.cell >= WORLD_LOST_CELL) {
		return GATHER_MET_LOST_CELL;
	}
	if (met == RAY_MET_NOTHING) {
		return hit.face == HIT_BACK ? GATHER_MET_BACK : GATHER_MET_NOTHING;
	}
	return record_world_cell(stored_record(met)) == hit.world_cell ? GATHER_MET_RECORD : GATHER_MET_NEIGHBOUR;
}

// What a gather ray meets, and the emission that reaches it from near by.
uint met_by_ray(WorldHit hit, vec3 direction, float way_m, uint seed, out vec3 emission) {
	emission = vec3(0.0);
	if (!hit.hit) {
		return RAY_MET_SKY;
	}
	uint met = pick_record(hit, direction, seed);
	if (met != RAY_MET_NOTHING && stored_record(met).emission != 0u && (emitter_count == 0u || way_m < near_emitters_m())) {
		emission = visible_emission(stored_record(met), stored_cell(hit.cell));
	}
	return met;
}

vec3 light_of_lane(WorldRecord record, uint i, uint lane) {
	RayCache cache = ray_cache_of(constants.cascade, constants.cache_capacity, constants.turns);
	uint seed = record_seed(record);
	uint sample_index = constants.turn * RECORD_LANES + lane;
	LaneOrigin origin = lane_origin(record, seed, sample_index);
	LightRay gather = LightRay(gather_direction(sample_index, seed, origin.normal), 1e6, vec3(1.0));
	EmitterSample emitter = resample_emitter(origin.surface_m, origin.normal, sample_index, seed + 3u);
	bool to_emitter = emitter.ray.light != vec3(0.0);
	// One loop for both rays, so that the tracing code is there once; what comes of them is after it, for lanes run all code in a loop.
	WorldHit gather_hit;
	WorldHit emitter_hit;
	for (uint k = 0u; k < (to_emitter ? 2u : 1u); k++) {
		LightRay ray = gather;
		if (k == 1u) {
			ray = emitter.ray;
		}
		float skipped_m;
		WorldHit hit = trace_from_record(origin, ray, skipped_m);
		if (k == 0u) {
			gather_hit = hit;
			gather.t_max_m = hit.t_m + skipped_m;
		} else {
			emitter_hit = hit;
			emitter.ray.t_max_m -= skipped_m;
		}
	}
	vec3 light;
	uint met = met_by_ray(gather_hit, gather.direction, gather.t_max_m, seed ^ hash_uint(sample_index), light);
	atomicAdd(group_met[kind_of_met(gather_hit, met)], 1u);
	if (constants.turn < cache.turns) {
		ray_cache[ray_cache_place(cache, constants.turn, i, lane)] = met;
	}
	if (to_emitter && (!emitter_hit.hit || hit_is_emitter(emitter_hit, emitter.record, emitter.ray))) {
		light += emitter.ray.light;
	}
	atomicAdd(group_rays, to_emitter ? 2u : 1u);
	return light / float(RECORD_LANES);
}

void main() {
	if (gl_LocalInvocationIndex < GATHER_MET_KINDS) {
		group_met[gl_LocalInvocationIndex] = 0u;
	}
	barrier();
	trace_lanes(0u, FETCHES_TRACE_RECORDS);
	barrier();
	if (gl_LocalInvocationIndex < GATHER_MET_KINDS) {
		atomicAdd(statistics.met[gl_LocalInvocationIndex], group_met[gl_LocalInvocationIndex]);
	}
}
