// SPDX-License-Identifier: MIT
// Finds the cells that one plane passes through from side to side, covered by their triangles without a gap: rays meet the plane there and need neither
// lists, nor edges, nor solid bits. A thread a record; the first record of a cell asks for all of it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/clip_polygon_inc.glsl"
#include "servers/rendering/gi/world/world_inc.glsl"

#define MARK_PLAIN_COUNTS 20
#define MARK_PLAIN_CELLS 21

// Of the plane's part in the cell: more is missing at an edge or crack that rays would miss, or lies there twice, so that a sum can't tell.
#define PLAIN_AREA_TOLERANCE 0.002

layout(local_size_x = 64) in;
layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = WORLD_BRICK_CELL_BASE, scalar) readonly buffer BrickCellBaseBlock {
	uint brick_cell_base[];
};
layout(set = 0, binding = WORLD_RECORDS, scalar) readonly buffer RecordsBlock {
	WorldRecord records[];
};
layout(set = 0, binding = WORLD_CELL_TRIANGLES, scalar) readonly buffer CellTrianglesBlock {
	uint cell_triangles[];
};
layout(set = 0, binding = WORLD_TRIANGLES, std430) readonly buffer TrianglesBlock {
	vec4 triangles[];
};
layout(set = 0, binding = MARK_PLAIN_COUNTS, scalar) buffer CountsBlock {
	CascadeCounts counts[];
};
layout(set = 0, binding = MARK_PLAIN_CELLS, scalar) buffer CellsBlock {
	WorldCell cells[];
};
layout(push_constant, scalar) uniform PlainPush {
	VoxelizeConstants constants;
};

// The corner of a stored triangle, cell-local.
vec3 corner_in_cell(uint number, uint corner, ivec3 at) {
	return triangles[number * 4u + 1u + corner].xyz / world.cascades[constants.cascade].cell_m - vec3(at);
}

uint flags_of(uint number) {
	return floatBitsToUint(triangles[number * 4u + 1u].w);
}

// Area of the plane's part in the cell, in cells^2: of a triangle around the whole cell, whose inscribed circle has a radius of three cells.
float area_of_plane(vec3 normal, vec3 point) {
	vec3 center = vec3(0.5) - normal * dot(vec3(0.5) - point, normal);
	vec3 u = normalize(abs(normal.x) < 0.6 ? cross(normal, vec3(1.0, 0.0, 0.0)) : cross(normal, vec3(0.0, 1.0, 0.0)));
	vec3 v = cross(normal, u);
	return polygon_area(clip_to_unit_cube(center + 6.0 * v, center - 5.1961524 * u - 3.0 * v, center + 5.1961524 * u - 3.0 * v, WORLD_TRIANGLE_GROWTH_CELLS));
}

// The triangle whose plane stands for the cell, or WORLD_NOT_LISTED.
uint plane_of_cell(WorldCell cell, ivec3 at) {
	uint first = constants.cascade * world.triangle_capacity + (cell.triangles >> WORLD_LIST_COUNT_BITS);
	uint count = cell.triangles & WORLD_LIST_COUNT_MASK;
	uint plane = WORLD_NOT_LISTED;
	// The lowest of those that have a plane: lists are in any order.
	for (uint i = 0u; i < count; i++) {
		uint number = cell_triangles[first + i] & WORLD_TRIANGLE_NUMBER_MASK;
		plane = triangles[number * 4u].xyz != vec3(0.0) ? min(plane, number) : plane;
	}
	if (plane == WORLD_NOT_LISTED || (flags_of(plane) & WORLD_TRIANGLE_ALPHA_TESTED) != 0u) {
		return WORLD_NOT_LISTED;
	}
	vec3 normal = normalize(triangles[plane * 4u].xyz * world.cascades[constants.cascade].cell_m);
	vec3 point = corner_in_cell(plane, 0u, at);
	uint area = 0u; // fixed-point: lists are in any order
	for (uint i = 0u; i < count; i++) {
		uint number = cell_triangles[first + i] & WORLD_TRIANGLE_NUMBER_MASK;
		vec3 own_normal = triangles[number * 4u].xyz;
		if (own_normal == vec3(0.0)) {
			continue;
		}
		if (flags_of(number) != flags_of(plane) || dot(own_normal, triangles[plane * 4u].xyz) < 0.9) {
			return WORLD_NOT_LISTED;
		}
		Polygon polygon = clip_to_unit_cube(corner_in_cell(number, 0u, at), corner_in_cell(number, 1u, at), corner_in_cell(number, 2u, at), WORLD_TRIANGLE_GROWTH_CELLS);
		for (uint k = 0u; k < polygon.count; k++) {
			if (abs(dot(polygon.v[k] - point, normal)) > WORLD_PLAIN_CELLS) {
				return WORLD_NOT_LISTED;
			}
		}
		area += uint(polygon_area(polygon) * WORLD_FIXED_AREA);
	}
	float whole = area_of_plane(normal, point);
	return abs(float(area) / WORLD_FIXED_AREA - whole) <= PLAIN_AREA_TOLERANCE * whole ? plane : WORLD_NOT_LISTED;
}

void main() {
	uint count = min(counts[constants.cascade].records, world.record_capacity);
	uint stride = gl_NumWorkGroups.x * 64u;
	for (uint i = gl_GlobalInvocationID.x; i < count; i += stride) {
		uint index = record_base(constants.cascade) + i;
		ivec3 at = record_world_cell(records[index]);
		uvec3 storage = storage_from_world_cell(at);
		uint brick = brick_of_cell(constants.cascade, storage);
		uint cell_index = brick_cell_base[brick] + bits_below(occupancy[brick], bit_of_cell(storage));
		if (cell_index >= cell_end(constants.cascade)) {
			continue;
		}
		WorldCell cell = cells[cell_index];
		if (cell_first_record(cell.records) != index) {
			continue;
		}
		if (cell.triangles == WORLD_NOT_LISTED) {
			atomicAdd(counts[constants.cascade].unlisted_cells, 1u);
		} else if ((cell.records & WORLD_CELL_FLAT) != 0u) {
			uint plane = plane_of_cell(cell, at);
			if (plane != WORLD_NOT_LISTED) {
				cells[cell_index].triangles = (plane << WORLD_LIST_COUNT_BITS) | WORLD_PLAIN;
				atomicAdd(counts[constants.cascade].plain_cells, 1u);
			}
		}
	}
}
