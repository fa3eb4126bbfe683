// SPDX-License-Identifier: MIT
// The light of a surface's pixel: lamps, and GI or ambient light, by the BRDF of brdf_inc.glsl under Godot's units (a light of energy 1
// gives albedo * cos).
#ifndef SHADING_INC
#define SHADING_INC
#include "servers/rendering/passes/material_inc.glsl"
#include "servers/rendering/shaders/brdf_inc.glsl"
#include "servers/rendering/shaders/light_falloff_inc.glsl"
#include "servers/rendering/shaders/octahedral_inc.glsl"

layout(set = 0, binding = RASTER_FRAME, scalar) uniform Frame { FrameData frame; };
layout(set = 0, binding = SHADE_LIGHTS, scalar) readonly buffer Lights { LightData lights[]; };
layout(set = 0, binding = SHADE_CLUSTERS, scalar) readonly buffer Clusters { uint cluster_masks[]; };
layout(set = 0, binding = SHADE_SKY_IRRADIANCE) uniform texture2D sky_irradiance;
layout(set = 0, binding = SHADE_SKY_RADIANCE) uniform texture2DArray sky_radiance;
layout(set = 0, binding = SHADE_ENVIRONMENT_BRDF) uniform texture2D environment_brdf;
layout(set = 0, binding = SHADE_LINEAR_SAMPLER) uniform sampler linear_sampler;
#include "servers/rendering/passes/shadows_inc.glsl"

struct Surface {
	vec3 position; // world, m
	vec3 normal; // with its map
	vec3 geometric_normal;
	vec3 view; // towards the camera
	vec3 albedo;
	BrdfLobes lobes;
	float roughness;
	float occlusion;
	vec3 emission;
};

struct Lighting {
	vec3 direct;
	vec3 indirect_diffuse;
	vec3 indirect_specular;
};

// Indirect light that reaches a surface, before its BRDF. a: 1 where GI knows, 0 where ambient light must serve.
struct GiLight {
	vec4 irradiance; // over pi
	vec4 radiance;
};

// normal: of the front; side: -1 where the back is seen.
Surface make_surface(uint material, MaterialUvs uvs, vec3 albedo, vec3 position, vec3 normal, vec4 tangent, float side) {
	Surface s;
	s.position = position;
	s.geometric_normal = normal * side;
	s.normal = material_normal(material, uvs, normal, tangent) * side;
	s.view = frame.views[0].orthogonal != 0u ? frame.views[0].camera_back : normalize(frame.views[0].camera_position - position);
	s.albedo = albedo;
	s.roughness = material_roughness(material, uvs);
	s.lobes = brdf_lobes(albedo, material_metallic(material, uvs), s.roughness, materials[material].specular, materials[material].specular_tint);
	s.occlusion = material_occlusion(material, uvs);
	s.emission = material_emission(material, uvs);
	return s;
}

// Reflected light for light that arrives from to_light, cosine included, with a light of 1.
vec3 reflect_light(Surface s, vec3 to_light, float specular_scale) {
	float n_l = dot(s.normal, to_light);
	if (n_l <= 0.0) {
		return vec3(0.0);
	}
	return (s.lobes.diffuse + brdf_specular(s.lobes, s.normal, s.view, to_light) * (BRDF_PI * specular_scale)) * n_l;
}

vec3 shade_positional(Surface s, uint index) {
	LightData light = lights[index];
	vec3 offset = light.position - s.position;
	float distance_m = length(offset);
	if (distance_m >= light.range) {
		return vec3(0.0);
	}
	vec3 to_light = offset / max(distance_m, 1e-6);
	float attenuation = light_distance_falloff(distance_m, light.range, light.attenuation);
	if (light.type == LIGHT_TYPE_SPOT) {
		attenuation *= light_cone_falloff(dot(-to_light, light.direction), light.spot_cos, light.spot_exponent);
	}
	vec3 reflected = reflect_light(s, to_light, light.specular) * attenuation;
	if (light.shadow_index >= 0 && dot(reflected, vec3(1.0)) > 0.0) {
		reflected *= positional_visibility(light, s.position, s.geometric_normal);
	}
	return reflected * light.color;
}

vec3 shade_direct(Surface s, vec2 pixel) {
	vec3 sum = vec3(0.0);
	float view_distance_m = -(frame.views[0].view_from_world * vec4(s.position, 1.0)).z;
	for (uint i = 0u; i < min(frame.directional_count, MAX_DIRECTIONAL_LIGHTS); i++) {
		LightData light = lights[frame.directional_lights[i]];
		vec3 reflected = reflect_light(s, -light.direction, light.specular);
		if (light.shadow_index >= 0 && dot(reflected, vec3(1.0)) > 0.0) {
			reflected *= sun_visibility(light, s.position, s.geometric_normal, view_distance_m);
		}
		sum += reflected * light.color;
	}
	uvec2 tile = min(uvec2(pixel) / CLUSTER_TILE_PIXELS, frame.cluster_count.xy - 1u);
	float slice = log2(max(view_distance_m, 1e-6) / frame.cluster_near_m) * frame.cluster_slices_per_log2;
	uint layer = uint(clamp(slice, 0.0, float(frame.cluster_count.z - 1u)));
	uint first_word = ((layer * frame.cluster_count.y + tile.y) * frame.cluster_count.x + tile.x) * frame.cluster_words;
	for (uint word = 0u; word < min(frame.cluster_words, MAX_CLUSTER_WORDS); word++) {
		uint mask = cluster_masks[first_word + word];
		for (uint k = 0u; k < 32u && mask != 0u; k++) {
			uint bit = uint(findLSB(mask));
			mask &= mask - 1u;
			sum += shade_positional(s, 32u * word + bit);
		}
	}
	return sum;
}

// What the specular lobe reflects of light that is the same from all directions.
vec3 environment_reflectance(Surface s) {
	vec2 place = clamp(vec2(dot(s.normal, s.view), s.roughness), 0.0, 1.0);
	vec2 size = vec2(textureSize(environment_brdf, 0));
	return brdf_environment(s.lobes, textureLod(sampler2D(environment_brdf, linear_sampler), (place * (size - 1.0) + 0.5) / size, 0.0).rg);
}

vec3 ambient_irradiance(vec3 normal) {
	vec3 ambient = frame.ambient_color;
	if (frame.ambient_sky_mix > 0.0) {
		vec3 sky = textureLod(sampler2D(sky_irradiance, linear_sampler), octahedral_from_direction(normal) * 0.5 + 0.5, 0.0).rgb;
		ambient = mix(ambient, sky * frame.ambient_sky_energy, frame.ambient_sky_mix);
	}
	return ambient;
}

vec3 ambient_radiance(vec3 direction, float roughness) {
	vec3 ambient = frame.ambient_color;
	if (frame.ambient_sky_mix > 0.0) {
		vec2 uv = octahedral_from_direction(direction) * 0.5 + 0.5;
		float layer = roughness * float(SKY_RADIANCE_LAYERS - 1);
		vec3 low = textureLod(sampler2DArray(sky_radiance, linear_sampler), vec3(uv, floor(layer)), 0.0).rgb;
		vec3 high = textureLod(sampler2DArray(sky_radiance, linear_sampler), vec3(uv, min(floor(layer) + 1.0, float(SKY_RADIANCE_LAYERS - 1))), 0.0).rgb;
		ambient = mix(ambient, mix(low, high, fract(layer)) * frame.ambient_sky_energy, frame.ambient_sky_mix);
	}
	return ambient;
}

Lighting shade(Surface s, vec2 pixel, GiLight gi) {
	Lighting result;
	result.direct = shade_direct(s, pixel);
	vec3 irradiance = gi.irradiance.rgb;
	if (gi.irradiance.a < 1.0) {
		irradiance = mix(ambient_irradiance(s.normal), irradiance, gi.irradiance.a);
	}
	result.indirect_diffuse = irradiance * s.lobes.diffuse * s.occlusion;
	result.indirect_specular = vec3(0.0);
	if (s.lobes.f90 > 0.0) {
		vec3 radiance = gi.radiance.rgb;
		if (gi.radiance.a < 1.0) {
			radiance = mix(ambient_radiance(reflect(-s.view, s.normal), s.roughness), radiance, gi.radiance.a);
		}
		// Specular occlusion (Lagarde, de Rousiers 2014).
		float n_v = clamp(dot(s.normal, s.view), 0.0, 1.0);
		float occlusion = clamp(pow(n_v + s.occlusion, exp2(-16.0 * s.roughness - 1.0)) - 1.0 + s.occlusion, 0.0, 1.0);
		result.indirect_specular = radiance * environment_reflectance(s) * occlusion;
	}
	return result;
}
#endif
