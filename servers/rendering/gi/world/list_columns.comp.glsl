// SPDX-License-Identifier: MIT
// Lists what of large triangles lies beyond their first WORLD_COLUMN_STRETCH columns of cells, a thread a triangle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/voxel_triangle_inc.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = VOXEL_STRETCHES, scalar) buffer ColumnStretchesBlock {
	uint stretches_wanted; // more than the list holds: nobody reads it
	ColumnStretch stretches[];
};

void main() {
	uint triangle = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
	if (triangle >= constants.triangle_count) {
		return;
	}
	uint columns = columns_of_triangle(load_triangle(triangle)).count;
	if (columns <= WORLD_COLUMN_STRETCH) {
		return;
	}
	uint count = (columns - 1u) / WORLD_COLUMN_STRETCH;
	uint first = atomicAdd(stretches_wanted, count);
	for (uint i = 0u; i < count && first + i < uint(stretches.length()); i++) {
		stretches[first + i] = ColumnStretch(triangle, (i + 1u) * WORLD_COLUMN_STRETCH);
	}
}
