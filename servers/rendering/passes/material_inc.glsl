// SPDX-License-Identifier: MIT
// Reads a material's parameters and textures (set 1).
#ifndef MATERIAL_INC
#define MATERIAL_INC
#include "servers/rendering/passes/frame_io.h"
#include "servers/rendering/shaders/scene_io.h"

layout(set = 0, binding = RASTER_MATERIALS, scalar) readonly buffer Materials { MaterialData materials[]; };
layout(set = 1, binding = MATERIAL_SLOT_ALBEDO) uniform sampler2D albedo_texture;
layout(set = 1, binding = MATERIAL_SLOT_NORMAL) uniform sampler2D normal_texture;
layout(set = 1, binding = MATERIAL_SLOT_METALLIC) uniform sampler2D metallic_texture;
layout(set = 1, binding = MATERIAL_SLOT_ROUGHNESS) uniform sampler2D roughness_texture;
layout(set = 1, binding = MATERIAL_SLOT_OCCLUSION) uniform sampler2D occlusion_texture;
layout(set = 1, binding = MATERIAL_SLOT_EMISSION) uniform sampler2D emission_texture;

struct MaterialUvs {
	vec2 uv;
	vec2 uv2;
};

vec2 slot_uv(uint material, uint slot, MaterialUvs uvs) {
	vec2 uv = (materials[material].uv2_mask & (1u << slot)) != 0u ? uvs.uv2 : uvs.uv;
	vec3 row0 = materials[material].uv_transforms[slot].row0;
	vec3 row1 = materials[material].uv_transforms[slot].row1;
	return vec2(dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z);
}

float slot_channel(uint material, uint slot, vec4 texel) {
	uint channel = (materials[material].channels >> (4u * slot)) & 15u;
	return channel < 4u ? texel[channel] : dot(texel.rgb, vec3(1.0 / 3.0));
}

vec4 material_albedo(uint material, MaterialUvs uvs, vec4 vertex_color) {
	vec4 albedo = materials[material].albedo * texture(albedo_texture, slot_uv(material, MATERIAL_SLOT_ALBEDO, uvs));
	return (materials[material].flags & MATERIAL_FLAG_VERTEX_COLOR) != 0u ? albedo * vertex_color : albedo;
}

float material_roughness(uint material, MaterialUvs uvs) {
	vec4 texel = texture(roughness_texture, slot_uv(material, MATERIAL_SLOT_ROUGHNESS, uvs));
	return clamp(materials[material].roughness * slot_channel(material, MATERIAL_SLOT_ROUGHNESS, texel), 0.0, 1.0);
}

float material_metallic(uint material, MaterialUvs uvs) {
	vec4 texel = texture(metallic_texture, slot_uv(material, MATERIAL_SLOT_METALLIC, uvs));
	return clamp(materials[material].metallic * slot_channel(material, MATERIAL_SLOT_METALLIC, texel), 0.0, 1.0);
}

float material_occlusion(uint material, MaterialUvs uvs) {
	vec4 texel = texture(occlusion_texture, slot_uv(material, MATERIAL_SLOT_OCCLUSION, uvs));
	return mix(1.0, slot_channel(material, MATERIAL_SLOT_OCCLUSION, texel), materials[material].occlusion_strength);
}

vec3 material_emission(uint material, MaterialUvs uvs) {
	vec3 texel = texture(emission_texture, slot_uv(material, MATERIAL_SLOT_EMISSION, uvs)).rgb;
	vec3 emission = materials[material].emission;
	return (materials[material].flags & MATERIAL_FLAG_EMISSION_ADD) != 0u ? emission + texel * materials[material].emission_energy : emission * texel;
}

// z is rebuilt, as Godot does: two-channel maps work.
vec3 material_normal(uint material, MaterialUvs uvs, vec3 normal, vec4 tangent) {
	vec3 texel = texture(normal_texture, slot_uv(material, MATERIAL_SLOT_NORMAL, uvs)).xyz * 2.0 - (256.0 / 255.0);
	vec2 xy = texel.xy * materials[material].normal_scale;
	float z = sqrt(max(1.0 - dot(texel.xy, texel.xy), 0.0));
	vec3 bitangent = cross(normal, tangent.xyz) * tangent.w;
	vec3 mapped = xy.x * tangent.xyz + xy.y * bitangent + z * normal;
	float squared = dot(mapped, mapped);
	return squared > 1e-12 ? mapped * inversesqrt(squared) : normal;
}
#endif
