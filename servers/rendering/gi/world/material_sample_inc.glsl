// SPDX-License-Identifier: MIT
// A triangle's material for the voxelizer: albedo, emission and alpha from the small copies of its textures.
#ifndef MATERIAL_SAMPLE_INC
#define MATERIAL_SAMPLE_INC
#include "servers/rendering/gi/world/voxel_triangle_inc.glsl"

layout(set = 0, binding = VOXEL_MATERIALS, scalar) readonly buffer MaterialsBlock {
	MaterialData materials[];
};
layout(set = 0, binding = VOXEL_ATTRIBUTES, scalar) readonly buffer AttributesBlock {
	VertexAttributes attributes[];
};
layout(set = 0, binding = VOXEL_TEXTURES) uniform texture2DArray gi_textures;
layout(set = 0, binding = VOXEL_SAMPLER) uniform sampler gi_sampler;

// Barycentric coordinates of the point of the triangle's plane nearest to p, clamped into the triangle.
vec3 clamped_barycentric(vec3 v[3], vec3 p) {
	vec3 a = v[1] - v[0];
	vec3 b = v[2] - v[0];
	vec3 c = p - v[0];
	float aa = dot(a, a);
	float ab = dot(a, b);
	float bb = dot(b, b);
	float ca = dot(c, a);
	float cb = dot(c, b);
	float determinant = max(aa * bb - ab * ab, 1e-30);
	vec2 yz = vec2(bb * ca - ab * cb, aa * cb - ab * ca) / determinant;
	vec3 w = max(vec3(1.0 - yz.x - yz.y, yz), vec3(0.0));
	return w / max(w.x + w.y + w.z, 1e-20);
}

vec2 triangle_uv(VoxelTriangle triangle, MaterialData material, uint slot, vec3 w) {
	VertexAttributes a = attributes[triangle.vertex.x];
	VertexAttributes b = attributes[triangle.vertex.y];
	VertexAttributes c = attributes[triangle.vertex.z];
	bool second = ((material.uv2_mask >> slot) & 1u) != 0u;
	vec2 uv = second ? w.x * a.uv2 + w.y * b.uv2 + w.z * c.uv2 : w.x * a.uv + w.y * b.uv + w.z * c.uv;
	UvTransform t = material.uv_transforms[slot];
	return vec2(dot(t.row0.xy, uv) + t.row0.z, dot(t.row1.xy, uv) + t.row1.z);
}

vec4 triangle_albedo(VoxelTriangle triangle, MaterialData material, vec3 w) {
	vec4 albedo = material.albedo;
	if (material.gi_albedo_layer >= 0) {
		albedo *= textureLod(sampler2DArray(gi_textures, gi_sampler), vec3(triangle_uv(triangle, material, MATERIAL_SLOT_ALBEDO, w), float(material.gi_albedo_layer)), 0.0);
	}
	if ((material.flags & MATERIAL_FLAG_VERTEX_COLOR) != 0u) {
		albedo *= w.x * unpackUnorm4x8(attributes[triangle.vertex.x].color) + w.y * unpackUnorm4x8(attributes[triangle.vertex.y].color) + w.z * unpackUnorm4x8(attributes[triangle.vertex.z].color);
	}
	return albedo;
}

// What the surface sends on of the light that falls on it.
vec3 triangle_reflectance(MaterialData material, vec4 albedo) {
	return min(albedo.rgb * material.gi_of_albedo + material.gi_added, vec3(1.0));
}

vec3 triangle_emission(VoxelTriangle triangle, MaterialData material, vec3 w) {
	if (material.gi_emission_layer < 0) {
		return material.emission;
	}
	vec3 texel = textureLod(sampler2DArray(gi_textures, gi_sampler), vec3(triangle_uv(triangle, material, MATERIAL_SLOT_EMISSION, w), float(material.gi_emission_layer)), 0.0).rgb;
	return (material.flags & MATERIAL_FLAG_EMISSION_ADD) != 0u ? material.emission + texel * material.emission_energy : material.emission * texel;
}

// Scissored surfaces by their threshold, blended ones where they are at least half opaque: glass lets light through, a
// blended panel of alpha 1 stops it as an opaque one does.
float alpha_threshold(MaterialData material) {
	return (material.flags & MATERIAL_FLAG_ALPHA_SCISSOR) != 0u ? material.alpha_scissor_threshold : 0.5;
}
bool is_alpha_tested(MaterialData material) {
	return (material.flags & (MATERIAL_FLAG_ALPHA_SCISSOR | MATERIAL_FLAG_ALPHA_BLEND)) != 0u;
}

// The direction that the triangle's front faces, in cells; its length is twice the area.
vec3 front_normal(VoxelTriangle triangle, MaterialData material) {
	vec3 n = cross(triangle.v[1] - triangle.v[0], triangle.v[2] - triangle.v[0]);
	bool flip = (instances[surfaces[triangle.surface].instance].flags & INSTANCE_FLAG_MIRRORED) != 0u;
	if ((material.flags & MATERIAL_FLAG_CULL_FRONT) != 0u) {
		flip = !flip;
	}
	return flip ? -n : n;
}

// From a normal in cells to the unit normal in the world: a plane's normal scales with the inverse of the cell.
vec3 world_normal_from_cells(uint cascade, vec3 n) {
	return normalize(n / world.cascades[cascade].cell_m);
}

#endif
