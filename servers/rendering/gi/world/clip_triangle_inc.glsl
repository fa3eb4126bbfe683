// SPDX-License-Identifier: MIT
// A triangle cut to a cell (Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974).
#ifndef CLIP_TRIANGLE_INC
#define CLIP_TRIANGLE_INC
#include "servers/rendering/gi/world/voxel_triangle_inc.glsl"

// A triangle cut by six planes has at most nine corners.
struct Polygon {
	vec3 v[9];
	uint count;
};

Polygon cut(Polygon polygon, uint axis, float limit, float side) {
	Polygon result;
	result.count = 0u;
	for (uint i = 0u; i < polygon.count; i++) {
		vec3 a = polygon.v[i];
		vec3 b = polygon.v[i + 1u == polygon.count ? 0u : i + 1u];
		float da = (a[axis] - limit) * side;
		float db = (b[axis] - limit) * side;
		if (da >= 0.0 && result.count < 9u) {
			result.v[result.count++] = a;
		}
		if ((da >= 0.0) != (db >= 0.0) && result.count < 9u) {
			result.v[result.count++] = mix(a, b, da / (da - db));
		}
	}
	return result;
}

// The part of the triangle in a cell and its touch distance, cell-local.
Polygon clip_triangle(VoxelTriangle triangle, ivec3 cell) {
	Polygon polygon;
	for (uint i = 0u; i < 3u; i++) {
		polygon.v[i] = triangle.v[i] - vec3(cell);
	}
	polygon.count = 3u;
	for (uint axis = 0u; axis < 3u && polygon.count > 0u; axis++) {
		polygon = cut(polygon, axis, -CELL_TOUCH, 1.0);
		polygon = cut(polygon, axis, 1.0 + CELL_TOUCH, -1.0);
	}
	return polygon;
}

#endif
