// SPDX-License-Identifier: MIT
// The triangles of all surfaces in the world's metres, for rays (WORLD_TRIANGLES), a thread a triangle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/material_sample_inc.glsl"

#define STORE_TRIANGLES_OUT 20

layout(local_size_x = 64) in;
layout(set = 0, binding = STORE_TRIANGLES_OUT, std430) writeonly buffer TrianglesBlock {
	vec4 world_triangles[];
};

void main() {
	uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
	if (i >= min(constants.triangle_count, constants.stored_triangles)) {
		return;
	}
	VoxelTriangle triangle = load_triangle(i); // in cells
	GiSurface surface = surfaces[triangle.surface];
	MaterialData material = materials[surface.material];
	vec3 front = front_normal(triangle, material);
	bool flipped = dot(front, cross(triangle.v[1] - triangle.v[0], triangle.v[2] - triangle.v[0])) < 0.0;
	uint flags = face_from_normal(world_normal_from_cells(constants.cascade, front));
	flags |= (material.flags & MATERIAL_FLAG_DOUBLE_SIDED) != 0u ? WORLD_TRIANGLE_DOUBLE_SIDED : 0u;
	flags |= is_alpha_tested(material) ? WORLD_TRIANGLE_ALPHA_TESTED : 0u;
	flags |= material.emission != vec3(0.0) || material.gi_emission_layer >= 0 ? WORLD_TRIANGLE_EMISSIVE : 0u;
	vec3 corners_m[3];
	for (uint k = 0u; k < 3u; k++) {
		uint corner = flipped && k > 0u ? 3u - k : k;
		corners_m[k] = world_from_local(instances[surface.instance], positions[triangle.vertex[corner]]);
		world_triangles[i * 4u + 1u + k] = vec4(corners_m[k], k == 0u ? uintBitsToFloat(flags) : 0.0);
	}
	// Without area: no plane, no ray meets it.
	vec3 n = cross(corners_m[1] - corners_m[0], corners_m[2] - corners_m[0]);
	n = dot(n, n) > 1e-30 ? normalize(n) : vec3(0.0);
	world_triangles[i * 4u] = vec4(n, dot(n, corners_m[0]));
}
