// SPDX-License-Identifier: MIT
// Triangles cut to a cell (Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974). Needs no binding.
#ifndef CLIP_POLYGON_INC
#define CLIP_POLYGON_INC

// A triangle cut by six planes has at most nine corners.
struct Polygon {
	vec3 v[9];
	uint count;
};

// Keeps what lies on `side` (1: above, -1: below) of the limit, and with `closed` what lies on it.
Polygon cut(Polygon polygon, uint axis, float limit, float side, bool closed) {
	Polygon result;
	result.count = 0u;
	for (uint i = 0u; i < polygon.count; i++) {
		vec3 a = polygon.v[i];
		vec3 b = polygon.v[i + 1u == polygon.count ? 0u : i + 1u];
		float da = (a[axis] - limit) * side;
		float db = (b[axis] - limit) * side;
		bool keeps_a = da > 0.0 || (closed && da == 0.0);
		bool keeps_b = db > 0.0 || (closed && db == 0.0);
		if (keeps_a && result.count < 9u) {
			result.v[result.count++] = a;
		}
		if (keeps_a != keeps_b && result.count < 9u) {
			result.v[result.count++] = mix(a, b, da / (da - db));
		}
	}
	return result;
}

// The part of a triangle in the unit cube and `margin` around it. Without a margin each point is in one of all cubes side by side.
Polygon clip_to_unit_cube(vec3 a, vec3 b, vec3 c, float margin) {
	Polygon polygon;
	polygon.v[0] = a;
	polygon.v[1] = b;
	polygon.v[2] = c;
	polygon.count = 3u;
	for (uint axis = 0u; axis < 3u && polygon.count > 0u; axis++) {
		polygon = cut(polygon, axis, -margin, 1.0, true);
		polygon = cut(polygon, axis, 1.0 + margin, -1.0, margin > 0.0);
	}
	return polygon;
}

float polygon_area(Polygon polygon) {
	float area = 0.0;
	for (uint i = 2u; i < polygon.count; i++) {
		area += 0.5 * length(cross(polygon.v[i - 1u] - polygon.v[0], polygon.v[i] - polygon.v[0]));
	}
	return area;
}

#endif
