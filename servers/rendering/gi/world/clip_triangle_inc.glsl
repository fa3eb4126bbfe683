// SPDX-License-Identifier: MIT
// A triangle cut to a cell.
#ifndef CLIP_TRIANGLE_INC
#define CLIP_TRIANGLE_INC
#include "servers/rendering/gi/world/clip_polygon_inc.glsl"
#include "servers/rendering/gi/world/voxel_triangle_inc.glsl"

// The part of the triangle in a cell and `margin` around it, cell-local.
Polygon clip_triangle(VoxelTriangle triangle, ivec3 cell, float margin) {
	vec3 corner = vec3(cell);
	return clip_to_unit_cube(triangle.v[0] - corner, triangle.v[1] - corner, triangle.v[2] - corner, margin);
}

#endif
