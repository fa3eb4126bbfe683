// SPDX-License-Identifier: MIT
// Rays from surface records, eight lanes a record, for trace_records and light_lamps: where they start, and the sums that they go into. The
// pass defines light_of_lane.
#ifndef RECORD_RAYS_INC
#define RECORD_RAYS_INC
#include "servers/rendering/gi/sdfgi/record_lanes_inc.glsl"
#include "servers/rendering/shaders/sampling_inc.glsl"

#define SLANT_MIN_COSINE 0.1

layout(set = 0, binding = RECORD_RAYS_STATISTICS, scalar) buffer StatisticsBlock {
	SdfgiStatistics statistics;
};
layout(set = 0, binding = RECORD_RAYS_STATE, scalar) buffer StateBlock {
	vec3 state[]; // two a record, sums over turns: light of emitters, light of lamps; irradiance / pi
};
layout(push_constant, scalar) uniform RecordRaysPush {
	RecordRaysConstants constants;
};

shared vec3 group_light[64];
shared uint group_rays;

// What a lane's rays leave from.
struct LaneOrigin {
	uint cascade;
	vec3 surface_m; // where the light falls
	vec3 start_m; // in the free space in front of it
	vec3 normal;
	float offset_m; // between the two
};

// A point of the record's surface within its cell: the centroid or, where a straight way from the centroid's start is free, a
// point over another column of the cell's sub-voxels.
LaneOrigin jittered_origin(WorldRecord record, uvec2 bits, vec2 u) {
	LaneOrigin origin;
	origin.cascade = record_cascade(record);
	origin.normal = record_normal(record);
	origin.surface_m = record_position_m(record);
	origin.start_m = record_start_m(record);
	origin.offset_m = dot(origin.start_m - origin.surface_m, origin.normal);
	uint axis = record_face(record) >> 1;
	uint a = (axis + 1u) % 3u;
	uint b = (axis + 2u) % 3u;
	vec3 cell_m = world.cascades[origin.cascade].cell_m;
	vec3 offset = vec3(0.0);
	vec3 center = record_position_in_cell(record);
	offset[a] = (u.x - center[a]) * cell_m[a];
	offset[b] = (u.y - center[b]) * cell_m[b];
	// Slide within the record's plane.
	offset[axis] = -(offset[a] * origin.normal[a] + offset[b] * origin.normal[b]) / origin.normal[axis];
	offset[axis] = clamp(offset[axis], -cell_m[axis], cell_m[axis]);
	uvec2 column = min(uvec2(u * 4.0), uvec2(3u));
	bool surface = ((columns_of_bits(bits, axis) >> (column.x + 4u * column.y)) & 1u) != 0u;
	if (surface && short_way_is_free(origin.cascade, origin.start_m, origin.start_m + offset)) {
		origin.surface_m += offset;
		origin.start_m += offset;
	}
	return origin;
}

// The point where a ray from the surface is as far off it as the start, if a straight way leads there from the start; else the
// start. A ray from the start itself would run beside the true one: light that falls at a slant would be lost or gained.
vec3 ray_start_m(LaneOrigin origin, vec3 direction) {
	float way_m = origin.offset_m / max(dot(direction, origin.normal), SLANT_MIN_COSINE);
	vec3 on_ray_m = origin.surface_m + direction * way_m;
	return short_way_is_free(origin.cascade, origin.start_m, on_ray_m) ? on_ray_m : origin.start_m;
}

struct LightRay {
	vec3 direction;
	float t_max_m;
	vec3 light; // irradiance / pi if nothing is in the way
};

WorldHit trace_from_record(LaneOrigin origin, LightRay ray, out float skipped_m) {
	vec3 from_m = ray_start_m(origin, ray.direction);
	skipped_m = dot(from_m - origin.surface_m, ray.direction);
	return trace_world(from_m, ray.direction, ray.t_max_m - skipped_m, finest_cascade(from_m));
}

LaneOrigin lane_origin(WorldRecord record, uint seed, uint sample_index) {
	uint index = find_cell(record_cascade(record), storage_from_world_cell(record_world_cell(record)));
	uvec2 bits = index < WORLD_LOST_CELL ? stored_cell(index).bits : uvec2(0u);
	return jittered_origin(record, bits, r2_point(sample_index, seed + 5u));
}

// Adds the eight lanes' light to a record's sum; a first turn starts it anew. All lanes of the group must come here.
void add_to_state(uint place, vec3 light, bool active_record) {
	group_light[gl_LocalInvocationIndex] = light;
	barrier();
	if (gl_LocalInvocationIndex % RECORD_LANES == 0u && active_record) {
		vec3 sum = vec3(0.0);
		if (constants.turn > 0u) {
			count_fetch(12u);
			sum = state[place];
		}
		for (uint k = 0u; k < RECORD_LANES; k++) {
			sum += group_light[gl_LocalInvocationIndex + k];
		}
		state[place] = sum;
	}
	barrier();
}

// What a lane's rays of this turn add to the record's sum. `i`: the record's number in its cascade.
vec3 light_of_lane(WorldRecord record, uint i, uint lane);

// All records of the cascade. `state_slot`: which of a record's sums. `pass`: FETCHES_*.
void trace_lanes(uint state_slot, uint pass) {
	uint count = records_of(constants.cascade);
	if (gl_LocalInvocationIndex == 0u) {
		group_rays = 0u;
	}
	barrier();
	for (uint group = gl_WorkGroupID.x; group < (count + 7u) / 8u; group += gl_NumWorkGroups.x) {
		uint i = group * 8u + gl_LocalInvocationIndex / RECORD_LANES;
		uint index = record_base(constants.cascade) + min(i, count - 1u);
		WorldRecord record = stored_record(index);
		bool active_record = i < count && record_is_active(record);
		vec3 light = vec3(0.0);
		if (active_record) {
			light = light_of_lane(record, i, gl_LocalInvocationIndex % RECORD_LANES);
		}
		add_to_state(index * 2u + state_slot, light, active_record);
	}
	if (gl_LocalInvocationIndex == 0u) {
		atomicAdd(statistics.rays, group_rays);
	}
	store_fetches(pass);
}

#endif
