// SPDX-License-Identifier: MIT
// The triangles that a cell lists, met by rays and crossed by short ways.
#ifndef MEET_TRIANGLES_INC
#define MEET_TRIANGLES_INC
#include "servers/rendering/gi/world/world_lookup_inc.glsl"

// Instead of a face that was met
#define HIT_BACK 6u // of a one-sided surface
#define HIT_BITS 7u // the cell lists no triangles: any of its surfaces may have been met

bool cell_is_listed(WorldCell cell) {
	return cell.triangles != WORLD_NOT_LISTED;
}

// Is a point of a triangle's plane inside of it, or no further than `growth` outside of an edge?
bool is_in_triangle(vec3 a, vec3 b, vec3 c, vec3 n, vec3 p, float growth) {
	vec3 ab = b - a;
	vec3 bc = c - b;
	vec3 ca = a - c;
	// Distances from the edges, times the edges' lengths.
	vec3 inside = vec3(dot(cross(ab, p - a), n), dot(cross(bc, p - b), n), dot(cross(ca, p - c), n));
	return all(greaterThanEqual(inside, -growth * sqrt(vec3(dot(ab, ab), dot(bc, bc), dot(ca, ca)))));
}

// Where the line o + t * d meets a listed triangle within t's range; negative: it does not. Triangles are larger by `growth` all around.
// r_along: of d along the normal; r_flags: WORLD_TRIANGLE_*.
float meet_triangle(uint number, vec3 o, vec3 d, vec2 range, float growth, out float r_along, out uint r_flags) {
	count_fetch(16u);
	r_flags = 0u;
	vec4 plane = world_triangles[number * 4u];
	r_along = dot(plane.xyz, d);
	// Far from the origin the plane's distance is rounded: it only tells which triangles are out of the question.
	float off = plane.w - dot(plane.xyz, o);
	float slack = growth + 1e-6 * abs(plane.w);
	vec2 span = r_along * range;
	if (off < min(span.x, span.y) - slack || off > max(span.x, span.y) + slack || abs(r_along) < 1e-12) {
		return -1.0;
	}
	count_fetch(48u);
	vec4 first = world_triangles[number * 4u + 1u];
	vec3 a = first.xyz - o;
	vec3 b = world_triangles[number * 4u + 2u].xyz - o;
	vec3 c = world_triangles[number * 4u + 3u].xyz - o;
	r_flags = floatBitsToUint(first.w);
	float t = dot(plane.xyz, a) / r_along;
	return t >= max(range.x, 0.0) && t <= range.y && is_in_triangle(a, b, c, plane.xyz, d * t, growth) ? t : -1.0;
}

float triangle_growth_m(uint cascade) {
	return WORLD_TRIANGLE_GROWTH_CELLS * world.cascades[cascade].cell_m.y;
}

// A point of an alpha-tested triangle counts where its sub-voxel of the cell at `at` (world-fixed) is solid.
bool is_solid_in_cell(uint cascade, WorldCell cell, ivec3 at, vec3 position_m) {
	vec3 p = (position_m / world.cascades[cascade].cell_m - vec3(at)) * float(WORLD_SUB_VOXELS);
	uvec3 s = uvec3(clamp(floor(p), vec3(0.0), vec3(3.0)));
	return bit_is_set(cell.bits, s.x + 4u * s.y + 16u * s.z);
}

#define WORLD_TRIANGLE_NUMBER_MASK ((1u << WORLD_TRIANGLE_NUMBER_BITS) - 1u)

// Bit of the octant that a sub-voxel (0..3) lies in.
uint octant_of_sub_voxel(ivec3 at) {
	return 1u << uint((at.x >> 1) + 2 * (at.y >> 1) + 4 * (at.z >> 1));
}

// The nearest of a listed cell's triangles that the ray meets between two ways, of those that touch `octants`; `at` is the cell, world-fixed.
// Returns the way to it, or a negative number.
float meet_triangles(uint cascade, WorldCell cell, uint octants, ivec3 at, vec3 origin_m, vec3 d, vec2 between_m, out uint r_face) {
	float growth = triangle_growth_m(cascade);
	uint first = cell.triangles >> 6;
	uint count = cell.triangles & 63u;
	float way_m = -1.0;
	r_face = HIT_BACK;
	for (uint i = 0u; i < count; i++) {
		count_fetch(4u);
		uint listed = world_cell_triangles[first + i];
		if (((listed >> WORLD_TRIANGLE_NUMBER_BITS) & octants) == 0u) {
			continue;
		}
		uint number = listed & WORLD_TRIANGLE_NUMBER_MASK;
		float along;
		uint flags;
		float t = meet_triangle(number, origin_m, d, between_m, growth, along, flags);
		if (t < 0.0) {
			continue;
		}
		if ((flags & WORLD_TRIANGLE_ALPHA_TESTED) != 0u && !is_solid_in_cell(cascade, cell, at, origin_m + d * t)) {
			continue;
		}
		uint front = flags & WORLD_TRIANGLE_FACE;
		uint face = along < 0.0 ? front : ((flags & WORLD_TRIANGLE_DOUBLE_SIDED) != 0u ? front ^ 1u : HIT_BACK);
		// Of equally near ones the lowest face: neither the list's order nor the triangles' matters.
		r_face = t == way_m ? min(r_face, face) : face;
		between_m.y = t;
		way_m = t;
	}
	return way_m;
}

// Does the stretch from `from_m` to `to_m` cross any of a listed cell's triangles that touch `octants`?
bool crosses_triangles(uint cascade, WorldCell cell, uint octants, ivec3 at, vec3 from_m, vec3 to_m) {
	float growth = triangle_growth_m(cascade);
	uint first = cell.triangles >> 6;
	uint count = cell.triangles & 63u;
	bool crosses = false;
	for (uint i = 0u; i < count && !crosses; i++) {
		count_fetch(4u);
		uint listed = world_cell_triangles[first + i];
		if (((listed >> WORLD_TRIANGLE_NUMBER_BITS) & octants) == 0u) {
			continue;
		}
		float along;
		uint flags;
		float t = meet_triangle(listed & WORLD_TRIANGLE_NUMBER_MASK, from_m, to_m - from_m, vec2(0.0, 1.0), growth, along, flags);
		crosses = t >= 0.0 && ((flags & WORLD_TRIANGLE_ALPHA_TESTED) == 0u || is_solid_in_cell(cascade, cell, at, mix(from_m, to_m, t)));
	}
	return crosses;
}

#endif
