// SPDX-License-Identifier: MIT
// Light on surface records: eight lanes a record, each traces one gather ray, one lamp's shadow ray and one ray to an emissive
// record. A record's output is irradiance / pi, averaged over a full set of rays ("epoch"); within an epoch the new mean takes
// over from the old one in proportion to the rays done, so that change shows at once and a still scene stands still.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/sdfgi/sdfgi_io.h"
#include "servers/rendering/gi/world/surface_light_inc.glsl"
#include "servers/rendering/shaders/sampling_inc.glsl"
#include "servers/rendering/shaders/scene_io.h"

#define LANES 8u
#define SLANT_MIN_COSINE 0.1

layout(local_size_x = 64) in;
layout(set = 0, binding = LIGHT_RECORDS_LIGHTS, scalar) readonly buffer LightsBlock {
	LightData lights[];
};
layout(set = 0, binding = LIGHT_RECORDS_COUNTS, scalar) readonly buffer CountsBlock {
	CascadeCounts counts[];
};
layout(set = 0, binding = LIGHT_RECORDS_EMITTERS, scalar) readonly buffer EmittersBlock {
	Emitter emitters[];
};
layout(set = 0, binding = LIGHT_RECORDS_EMITTER_COUNT, scalar) readonly buffer EmitterCountBlock {
	uint emitter_count;
};
layout(set = 0, binding = LIGHT_RECORDS_STATE, scalar) buffer StateBlock {
	vec3 state[]; // four a record: last epoch's mean and this epoch's sum of all light, then of light other than lamps'
};
layout(set = 0, binding = LIGHT_RECORDS_OUT, scalar) writeonly buffer OutBlock {
	uvec4 new_light[];
};
layout(set = 0, binding = LIGHT_RECORDS_STATISTICS, scalar) buffer StatisticsBlock {
	SdfgiStatistics statistics;
};
layout(push_constant, scalar) uniform LightRecordsPush {
	LightRecordsConstants constants;
};

#include "servers/rendering/gi/sdfgi/emitter_sample_inc.glsl"

shared vec3 group_indirect[64];
shared vec3 group_lamps[64];
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

float light_attenuation(LightData light, vec3 to_light, float distance_m) {
	float window = distance_m / light.range;
	window = max(1.0 - window * window * window * window, 0.0);
	float attenuation = window * window * pow(max(distance_m, 1e-4), -light.attenuation);
	if (light.type == LIGHT_TYPE_SPOT) {
		float cosine = dot(-to_light, light.direction);
		if (cosine <= light.spot_cos) {
			return 0.0;
		}
		float rim = max(1e-4, (1.0 - cosine) / (1.0 - light.spot_cos));
		attenuation *= 1.0 - pow(rim, light.spot_attenuation);
	}
	return attenuation;
}

LightRay ray_to_lamp(LightData light, vec3 from_m, vec3 normal, vec2 u) {
	LightRay ray;
	ray.t_max_m = 1e6;
	ray.light = light.color * light.indirect_energy;
	if (light.type == LIGHT_TYPE_DIRECTIONAL) {
		ray.direction = -light.direction;
		if (light.angular_radius > 0.0) {
			float radius = tan(light.angular_radius) * sqrt(u.x);
			ray.direction = normalize(basis_from_normal(ray.direction) * vec3(radius * cos(2.0 * PI * u.y), radius * sin(2.0 * PI * u.y), 1.0));
		}
	} else {
		vec3 way = light.position - from_m;
		float distance_m = max(length(way), 1e-4);
		ray.direction = way / distance_m;
		ray.t_max_m = distance_m;
		ray.light *= light_attenuation(light, ray.direction, distance_m);
	}
	ray.light *= max(dot(normal, ray.direction), 0.0);
	return ray;
}

struct LaneLight {
	vec3 indirect; // from surfaces, emitters and the sky
	vec3 lamps;
	uint rays;
};

LaneLight light_of_lane(WorldRecord record, uint lane) {
	uint cascade = record_cascade(record);
	ivec3 cell = record_world_cell(record);
	uint seed = hash_uint(uint(cell.x) * 73856093u ^ hash_uint(uint(cell.y) * 19349663u ^ hash_uint(uint(cell.z) * 83492791u ^ (record.cell >> 24))));
	uint sample_index = constants.epoch_turn * LANES + lane;

	uint index = find_cell(cascade, storage_from_world_cell(cell));
	uvec2 bits = index < WORLD_LOST_CELL ? world_cells[index].bits : uvec2(0u);
	LaneOrigin origin = jittered_origin(record, bits, r2_point(sample_index, seed + 5u));

	// Lamps take turns: `slots` is their count rounded up to a power of two, so that an epoch holds each equally often.
	uint slots = 1u;
	for (uint i = 0u; i < 20u && slots < constants.light_count; i++) {
		slots *= 2u;
	}
	uint lane_slots = max(slots / LANES, 1u);
	uint lamp_rays = constants.light_count == 0u ? 0u : max(lane_slots / constants.epoch_frames, 1u);
	// Ray 0 gathers, ray 1 goes to an emitter, the others to lamps. One loop, so that the tracing code is there once.
	LaneLight light = LaneLight(vec3(0.0), vec3(0.0), 0u);
	for (uint k = 0u; k < 2u + lamp_rays; k++) {
		LightRay ray;
		uint target = 0u;
		if (k == 0u) {
			ray.direction = cosine_direction(r2_point(sample_index, seed), origin.normal);
			ray.t_max_m = 1e6;
			ray.light = vec3(1.0 / float(LANES));
		} else if (k == 1u) {
			if (emitter_count == 0u) {
				continue;
			}
			EmitterSample emitter = resample_emitter(origin.surface_m, origin.normal, sample_index, seed + 3u);
			ray = emitter.ray;
			ray.light /= float(LANES);
			target = emitter.record;
		} else {
			uint turn = constants.frame * lamp_rays + k - 2u;
			uint lamp = slots < LANES ? lane % slots : lane * lane_slots + turn % lane_slots;
			if (lamp >= constants.light_count) {
				continue;
			}
			ray = ray_to_lamp(lights[lamp], origin.surface_m, origin.normal, r2_point(sample_index, seed + 7u));
			ray.light *= float(slots) / float(LANES * lamp_rays);
		}
		if (ray.light == vec3(0.0)) {
			continue;
		}
		light.rays++;
		vec3 from_m = ray_start_m(origin, ray.direction);
		float skipped_m = dot(from_m - origin.surface_m, ray.direction);
		ray.t_max_m -= skipped_m;
		WorldHit hit = trace_world(from_m, ray.direction, ray.t_max_m, cascade);
		if (k == 0u) {
			light.indirect += ray.light * (hit.hit ? hit_radiance(hit, ray.direction, constants.feedback, emitter_count == 0u || hit.t_m + skipped_m < near_emitters_m()) : world_sky_radiance(ray.direction));
		} else if (k == 1u) {
			light.indirect += !hit.hit || hit_is_emitter(hit, target, ray) ? ray.light : vec3(0.0);
		} else {
			light.lamps += hit.hit ? vec3(0.0) : ray.light;
		}
	}
	return light;
}

// Takes one frame's light into an epoch's mean; returns what shows.
vec3 advance(uint base, vec3 light, out float change) {
	vec3 mean = state[base];
	vec3 sum = state[base + 1u] + light;
	float total = float(constants.epoch_frames);
	float done = float(constants.epoch_turn + 1u);
	vec3 shown = constants.first_epoch != 0u ? sum / done : mean + (sum - done * mean) / total;
	change = 0.0;
	if (constants.epoch_turn == constants.epoch_frames - 1u) {
		shown = sum / total;
		change = dot(abs(shown - mean), vec3(1.0)) / max(dot(shown, vec3(1.0)), 1e-6);
		mean = shown;
		sum = vec3(0.0);
	}
	state[base] = mean;
	state[base + 1u] = sum;
	return max(shown, vec3(0.0));
}

void main() {
	uint lane = gl_LocalInvocationIndex % LANES;
	uint count = min(counts[constants.cascade].records, world.record_capacity);
	uint groups = (count + 7u) / 8u;
	if (gl_LocalInvocationIndex == 0u) {
		group_rays = 0u;
	}
	barrier();
	for (uint group = gl_WorkGroupID.x; group < groups; group += gl_NumWorkGroups.x) {
		uint i = group * 8u + gl_LocalInvocationIndex / LANES;
		uint index = record_base(constants.cascade) + min(i, count - 1u);
		WorldRecord record = world_records[index];
		bool active_record = i < count && record_has_start(record) && !cell_in_hole(constants.cascade, record_world_cell(record));
		LaneLight light = LaneLight(vec3(0.0), vec3(0.0), 0u);
		if (active_record) {
			light = light_of_lane(record, lane);
			atomicAdd(group_rays, light.rays);
		}
		group_indirect[gl_LocalInvocationIndex] = light.indirect;
		group_lamps[gl_LocalInvocationIndex] = light.lamps;
		barrier();
		if (lane == 0u && i < count) {
			vec3 indirect = vec3(0.0);
			vec3 lamps = vec3(0.0);
			for (uint k = 0u; k < LANES; k++) {
				indirect += group_indirect[gl_LocalInvocationIndex + k];
				lamps += group_lamps[gl_LocalInvocationIndex + k];
			}
			uvec4 result = uvec4(0u);
			if (active_record) {
				float change;
				vec3 shown = advance(index * 4u, indirect + lamps, change);
				result.xy = half4_from_vec4(vec4(shown, 1.0));
				if (constants.epoch_turn == constants.epoch_frames - 1u) {
					atomicAdd(statistics.lit_records, dot(shown, vec3(1.0)) > 1e-6 ? 1u : 0u);
					atomicAdd(statistics.changed_records, change > 0.02 ? 1u : 0u);
				}
				float unused;
				result.zw = half4_from_vec4(vec4(advance(index * 4u + 2u, indirect, unused), 1.0));
			}
			new_light[index] = result;
		}
		barrier();
	}
	if (gl_LocalInvocationIndex == 0u) {
		atomicAdd(statistics.rays, group_rays);
	}
}
