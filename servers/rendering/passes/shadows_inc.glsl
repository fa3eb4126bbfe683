// SPDX-License-Identifier: MIT
// Filtered lookups of the shadow maps (standard z: 0 near the light).
#ifndef SHADOWS_INC
#define SHADOWS_INC
layout(set = 0, binding = SHADE_SHADOW_VIEWS, scalar) readonly buffer ShadowViews { ShadowView shadow_views[]; };
layout(set = 0, binding = SHADE_SUN_SHADOWS) uniform texture2DArray sun_shadows;
layout(set = 0, binding = SHADE_LIGHT_SHADOWS) uniform texture2DArray light_shadows;
layout(set = 0, binding = SHADE_SHADOW_SAMPLER) uniform samplerShadow shadow_sampler;

// Godot's constants scaled to what this filter needs: its taps reach 1.5 texels.
const float SUN_NORMAL_BIAS_SCALE = 1.0;
const float LIGHT_NORMAL_BIAS_SCALE = 2.0;

// Moves the receiver off its surface by normal_bias texels where the map sees it edge-on, not at all where it lies parallel
// to the map, and towards the light by bias texels. axis: of the map, towards the light.
vec3 biased_position(vec3 position, vec3 normal, vec3 axis, float texel_m, float normal_bias, float bias) {
	float cosine = clamp(dot(normal, axis), 0.0, 1.0);
	return position + normal * (texel_m * normal_bias * sqrt(1.0 - cosine * cosine)) + axis * (texel_m * bias);
}

// Four bilinear comparisons half a texel off: a 3x3 tent.
float filter_shadow(texture2DArray map, vec3 uv_depth, uint layer) {
	vec2 half_texel = 0.5 / vec2(textureSize(map, 0).xy);
	float depth = clamp(uv_depth.z, 0.0, 1.0);
	float sum = texture(sampler2DArrayShadow(map, shadow_sampler), vec4(uv_depth.xy + vec2(-half_texel.x, -half_texel.y), layer, depth));
	sum += texture(sampler2DArrayShadow(map, shadow_sampler), vec4(uv_depth.xy + vec2(half_texel.x, -half_texel.y), layer, depth));
	sum += texture(sampler2DArrayShadow(map, shadow_sampler), vec4(uv_depth.xy + vec2(-half_texel.x, half_texel.y), layer, depth));
	sum += texture(sampler2DArrayShadow(map, shadow_sampler), vec4(uv_depth.xy + vec2(half_texel.x, half_texel.y), layer, depth));
	return 0.25 * sum;
}

// 1: lit. view_distance_m: along the camera's -z.
float sun_visibility(LightData light, vec3 position, vec3 normal, float view_distance_m) {
	for (uint split = 0u; split < SUN_SPLITS; split++) {
		ShadowView view = shadow_views[light.shadow_index + int(split)];
		if (view_distance_m < view.end_m) {
			vec3 moved = biased_position(position, normal, -light.direction, view.texel_size, light.shadow_normal_bias * SUN_NORMAL_BIAS_SCALE, light.shadow_bias);
			vec4 projected = view.shadow_from_world * vec4(moved, 1.0);
			// Outside of the map there are no casters: it holds the scene's bounds.
			if (any(lessThan(projected.xy, vec2(0.0))) || any(greaterThan(projected.xy, vec2(1.0)))) {
				return 1.0;
			}
			return mix(1.0, filter_shadow(sun_shadows, projected.xyz, view.layer), light.shadow_opacity);
		}
	}
	return 1.0;
}

// +x, -x, +y, -y, +z, -z
uint cube_face(vec3 direction) {
	vec3 size = abs(direction);
	if (size.x >= size.y && size.x >= size.z) {
		return direction.x > 0.0 ? 0u : 1u;
	}
	if (size.y >= size.z) {
		return direction.y > 0.0 ? 2u : 3u;
	}
	return direction.z > 0.0 ? 4u : 5u;
}

vec3 cube_axis(uint face) {
	vec3 axis = vec3(0.0);
	axis[face >> 1u] = (face & 1u) == 0u ? 1.0 : -1.0;
	return axis;
}

float positional_visibility(LightData light, vec3 position, vec3 normal) {
	bool omni = light.type == LIGHT_TYPE_OMNI;
	vec3 axis = omni ? cube_axis(cube_face(position - light.position)) : light.direction;
	ShadowView view = shadow_views[light.shadow_index];
	float texel_m = view.texel_size * dot(position - light.position, axis);
	vec3 moved = biased_position(position, normal, -axis, texel_m, light.shadow_normal_bias * LIGHT_NORMAL_BIAS_SCALE, light.shadow_bias);
	if (omni) {
		view = shadow_views[light.shadow_index + int(cube_face(moved - light.position))];
	}
	vec4 projected = view.shadow_from_world * vec4(moved, 1.0);
	if (projected.w <= 0.0) {
		return 1.0;
	}
	return mix(1.0, filter_shadow(light_shadows, projected.xyz / projected.w, view.layer), light.shadow_opacity);
}
#endif
