// SPDX-License-Identifier: MIT
// The light of surface records: what trace_records and light_lamps have summed, and one bounce from what the cached gather rays met. Reads
// the last frame's light and writes the next one's, so each frame adds a bounce and a still scene comes to stand still.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/sdfgi/record_lanes_inc.glsl"

layout(set = 0, binding = RECORD_RAYS_STATE, scalar) readonly buffer StateBlock {
	vec3 state[]; // two a record, sums over turns: light of emitters, light of lamps; irradiance / pi
};
layout(set = 0, binding = LIGHT_RECORDS_OUT, scalar) writeonly buffer OutBlock {
	uvec4 new_light[];
};
layout(set = 0, binding = RECORD_RAYS_STATISTICS, scalar) buffer StatisticsBlock {
	SdfgiStatistics statistics;
};
layout(set = 0, binding = RECORD_RAYS_CACHE, scalar) readonly buffer RayCacheBlock {
	uint ray_cache[];
};
layout(push_constant, scalar) uniform LightRecordsPush {
	LightRecordsConstants constants;
};

// Steps of halves below 2^-14, where they lose precision, three times and doubled.
#define DIMMEST_CHANGE 4e-7

shared vec3 group_light[64];

// Irradiance / pi that a lane's cached rays bring, as a sum.
vec3 gathered_by_lane(WorldRecord record, RayCache cache, uint turns, uint i, uint lane) {
	uint seed = record_seed(record);
	vec3 normal = record_normal(record);
	vec3 reflected = vec3(0.0);
	uint sky_turns = 0u;
	for (uint turn = 0u; turn < turns; turn++) {
		count_fetch(4u);
		uint met = ray_cache[ray_cache_place(cache, turn, i, lane)];
		if (met < RAY_MET_SKY) {
			reflected += light_from_record(met);
		}
		sky_turns |= met == RAY_MET_SKY ? 1u << turn : 0u;
	}
	// In a loop of its own: a CPU's lanes run all code of a loop's body.
	vec3 sky = vec3(0.0);
	for (; sky_turns != 0u; sky_turns &= sky_turns - 1u) {
		sky += world_sky_radiance(gather_direction(uint(findLSB(sky_turns)) * RECORD_LANES + lane, seed, normal));
	}
	return reflected * constants.feedback + sky;
}

void store(uint index, WorldRecord record, vec3 bounced) {
	count_fetch(12u);
	vec3 still = bounced + state[index * 2u] / float(constants.turns_done);
	vec3 lamps = vec3(0.0);
	if (constants.lamp_turns_done > 0u) {
		count_fetch(12u);
		lamps = state[index * 2u + 1u] / float(constants.lamp_turns_done);
	}
	uvec4 result;
	// Negative lamps take no more than the others give: light isn't negative.
	result.xy = half4_from_vec4(vec4((still + max(lamps, vec3(0.0))) * color_from_unorm111110(record.albedo), 1.0));
	result.zw = half4_from_vec4(vec4(still, 1.0));
	new_light[index] = result;
	vec3 before = light_onto_record(index);
	float brightness = dot(still, vec3(1.0));
	if (brightness > 1e-6) {
		atomicAdd(statistics.lit_records, 1u);
		if (dot(abs(still - before), vec3(1.0)) > SETTLED_CHANGE * brightness + DIMMEST_CHANGE) {
			atomicAdd(statistics.changed_records, 1u);
		}
	}
}

void main() {
	uint lane = gl_LocalInvocationIndex % RECORD_LANES;
	uint count = records_of(constants.cascade);
	RayCache cache = ray_cache_of(constants.cascade, constants.cache_capacity, constants.turns);
	uint turns = min(constants.turns_done, cache.turns);
	for (uint group = gl_WorkGroupID.x; group < (count + 7u) / 8u; group += gl_NumWorkGroups.x) {
		uint i = group * 8u + gl_LocalInvocationIndex / RECORD_LANES;
		uint index = record_base(constants.cascade) + min(i, count - 1u);
		WorldRecord record = stored_record(index);
		bool active_record = i < count && record_is_active(record);
		group_light[gl_LocalInvocationIndex] = active_record ? gathered_by_lane(record, cache, turns, i, lane) : vec3(0.0);
		barrier();
		if (lane == 0u && i < count) {
			if (active_record) {
				vec3 sum = vec3(0.0);
				for (uint k = 0u; k < RECORD_LANES; k++) {
					sum += group_light[gl_LocalInvocationIndex + k];
				}
				store(index, record, sum / float(max(turns, 1u) * RECORD_LANES));
			} else {
				new_light[index] = uvec4(0u);
			}
		}
		barrier();
	}
	store_fetches(FETCHES_LIGHT_RECORDS);
}
