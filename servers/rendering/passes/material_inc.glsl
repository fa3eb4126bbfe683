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

// The gradients come from varyings alone: buffer loads may answer zeros in helper invocations (llvmpipe of Mesa 22.3), which would
// pick the smallest mip level along the edges of triangles.
vec4 sample_slot(sampler2D image, uint material, uint slot, MaterialUvs uvs) {
	vec4 dx = vec4(dFdx(uvs.uv), dFdx(uvs.uv2));
	vec4 dy = vec4(dFdy(uvs.uv), dFdy(uvs.uv2));
	bool second = (materials[material].uv2_mask & (1u << slot)) != 0u;
	vec3 row0 = materials[material].uv_transforms[slot].row0;
	vec3 row1 = materials[material].uv_transforms[slot].row1;
	vec2 uv = second ? uvs.uv2 : uvs.uv;
	vec2 uv_dx = second ? dx.zw : dx.xy;
	vec2 uv_dy = second ? dy.zw : dy.xy;
	mat2 transform = mat2(row0.x, row1.x, row0.y, row1.y);
	return textureGrad(image, transform * uv + vec2(row0.z, row1.z), transform * uv_dx, transform * uv_dy);
}

float slot_channel(uint material, uint slot, vec4 texel) {
	uint channel = (materials[material].channels >> (4u * slot)) & 15u;
	return channel < 4u ? texel[channel] : dot(texel.rgb, vec3(1.0 / 3.0));
}

vec4 material_albedo(uint material, MaterialUvs uvs, vec4 vertex_color) {
	vec4 albedo = materials[material].albedo * sample_slot(albedo_texture, material, MATERIAL_SLOT_ALBEDO, uvs);
	return (materials[material].flags & MATERIAL_FLAG_VERTEX_COLOR) != 0u ? albedo * vertex_color : albedo;
}

float material_roughness(uint material, MaterialUvs uvs) {
	vec4 texel = sample_slot(roughness_texture, material, MATERIAL_SLOT_ROUGHNESS, uvs);
	return clamp(materials[material].roughness * slot_channel(material, MATERIAL_SLOT_ROUGHNESS, texel), 0.0, 1.0);
}

float material_metallic(uint material, MaterialUvs uvs) {
	vec4 texel = sample_slot(metallic_texture, material, MATERIAL_SLOT_METALLIC, uvs);
	return clamp(materials[material].metallic * slot_channel(material, MATERIAL_SLOT_METALLIC, texel), 0.0, 1.0);
}

float material_occlusion(uint material, MaterialUvs uvs) {
	vec4 texel = sample_slot(occlusion_texture, material, MATERIAL_SLOT_OCCLUSION, uvs);
	return mix(1.0, slot_channel(material, MATERIAL_SLOT_OCCLUSION, texel), materials[material].occlusion_strength);
}

vec3 material_emission(uint material, MaterialUvs uvs) {
	vec3 texel = sample_slot(emission_texture, material, MATERIAL_SLOT_EMISSION, uvs).rgb;
	vec3 emission = materials[material].emission;
	return (materials[material].flags & MATERIAL_FLAG_EMISSION_ADD) != 0u ? emission + texel * materials[material].emission_energy : emission * texel;
}

// z is rebuilt, as Godot does: two-channel maps work.
vec3 material_normal(uint material, MaterialUvs uvs, vec3 normal, vec4 tangent) {
	vec3 texel = sample_slot(normal_texture, material, MATERIAL_SLOT_NORMAL, uvs).xyz * 2.0 - (256.0 / 255.0);
	vec2 xy = texel.xy * materials[material].normal_scale;
	float z = sqrt(max(1.0 - dot(texel.xy, texel.xy), 0.0));
	vec3 bitangent = cross(normal, tangent.xyz) * tangent.w;
	vec3 mapped = xy.x * tangent.xyz + xy.y * bitangent + z * normal;
	float squared = dot(mapped, mapped);
	return squared > 1e-12 ? mapped * inversesqrt(squared) : normal;
}
#endif
