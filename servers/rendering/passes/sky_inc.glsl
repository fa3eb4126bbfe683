// SPDX-License-Identifier: MIT
// Radiance of the background by direction: Godot's ProceduralSkyMaterial and PanoramaSkyMaterial.
#ifndef SKY_INC
#define SKY_INC
#include "servers/rendering/passes/sky_io.h"

layout(set = 0, binding = SKY_DATA, scalar) uniform Sky { SkyData sky; };
layout(set = 0, binding = SKY_PANORAMA) uniform texture2D sky_panorama;
layout(set = 0, binding = SKY_PANORAMA_SAMPLER) uniform sampler sky_panorama_sampler;

const float SKY_PI = 3.14159265358979;

vec3 procedural_sky(vec3 direction, bool with_suns) {
	float height = clamp(direction.y, -1.0, 1.0);
	vec3 ground = mix(sky.ground_bottom, sky.ground_horizon, clamp(pow(1.0 + min(height, 0.0), sky.inverse_ground_curve), 0.0, 1.0));
	vec3 upper = mix(sky.sky_top, sky.sky_horizon, clamp(pow(1.0 - max(height, 0.0), sky.inverse_sky_curve), 0.0, 1.0));
	for (uint i = 0u; i < min(sky.sun_count, MAX_SKY_SUNS) && with_suns; i++) {
		float cosine = dot(sky.suns[i].to_sun, direction);
		if (cosine > sky.suns[i].cos_size) {
			upper = sky.suns[i].color;
		} else if (cosine > sky.cos_sun_angle_max) {
			float halo = (cosine - sky.cos_sun_angle_max) / max(sky.suns[i].cos_size - sky.cos_sun_angle_max, 1e-6);
			upper = mix(upper, sky.suns[i].color, clamp(pow(halo, sky.inverse_sun_curve), 0.0, 1.0));
		}
	}
	return height < 0.0 ? ground : upper;
}

// footprint: solid angle's diameter in radians, picks the panorama's level.
vec3 sky_light(vec3 world_direction, bool with_suns, float footprint) {
	if (sky.kind == SKY_KIND_COLOR) {
		return sky.color;
	}
	vec3 direction = mat3(sky.sky_from_world) * world_direction;
	vec3 light;
	if (sky.kind == SKY_KIND_PANORAMA) {
		vec2 uv = vec2(0.5 + atan(direction.x, -direction.z) / (2.0 * SKY_PI), acos(clamp(direction.y, -1.0, 1.0)) / SKY_PI);
		float texels = footprint / SKY_PI * float(textureSize(sky_panorama, 0).y);
		light = textureLod(sampler2D(sky_panorama, sky_panorama_sampler), uv, max(log2(max(texels, 1.0)), 0.0)).rgb;
	} else {
		light = procedural_sky(world_direction, with_suns);
	}
	return light * sky.energy;
}
#endif
