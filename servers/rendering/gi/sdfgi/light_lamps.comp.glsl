// SPDX-License-Identifier: MIT
// One turn of shadow rays from surface records to lamps, also to lamps whose shadow_enabled is off: that is the shadow maps'. The lanes share the lamps out, `slots` being their count rounded up to a power of
// two, so that each turn holds each lamp equally often: none is missing after a change.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/sdfgi/record_rays_inc.glsl"
#include "servers/rendering/shaders/light_falloff_inc.glsl"
#include "servers/rendering/shaders/scene_io.h"

layout(set = 0, binding = LIGHT_LAMPS_LIGHTS, scalar) readonly buffer LightsBlock {
	LightData lights[];
};

float light_attenuation(LightData light, vec3 to_light, float distance_m) {
	float attenuation = light_distance_falloff(distance_m, light.range, light.attenuation);
	if (light.type == LIGHT_TYPE_SPOT) {
		attenuation *= light_cone_falloff(dot(-to_light, light.direction), light.spot_cos, light.spot_exponent);
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

vec3 light_of_lane(WorldRecord record, uint i, uint lane) {
	uint seed = record_seed(record);
	uint sample_index = constants.turn * RECORD_LANES + lane;
	LaneOrigin origin = lane_origin(record, seed, sample_index);
	uint slots = 1u;
	for (uint i = 0u; i < 20u && slots < constants.light_count; i++) {
		slots *= 2u;
	}
	uint lane_slots = max(slots / RECORD_LANES, 1u);
	vec3 light = vec3(0.0);
	for (uint k = 0u; k < lane_slots; k++) {
		uint lamp = slots < RECORD_LANES ? lane % slots : lane * lane_slots + k;
		if (lamp >= constants.light_count) {
			continue;
		}
		count_fetch(92u);
		LightRay ray = ray_to_lamp(lights[lamp], origin.surface_m, origin.normal, r2_point(sample_index, seed + 7u));
		if (ray.light == vec3(0.0)) {
			continue;
		}
		float skipped_m;
		light += trace_from_record(origin, ray, skipped_m).hit ? vec3(0.0) : ray.light;
		atomicAdd(group_rays, 1u);
	}
	return light * (float(min(slots, RECORD_LANES)) / float(RECORD_LANES));
}

void main() {
	trace_lanes(1u, FETCHES_LIGHT_LAMPS);
}
