// SPDX-License-Identifier: MIT
// Lists in each cell that has room for it the triangles that touch it, in any order: who reads them takes the nearest, of equally near ones
// the one of the lowest face.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/visit_triangles_inc.glsl"

#define LIST_TRIANGLES_WORDS 20
#define LIST_TRIANGLES_LIST 21

layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = WORLD_BRICK_CELL_BASE, scalar) readonly buffer BrickCellBaseBlock {
	uint brick_cell_base[];
};
layout(set = 0, binding = LIST_TRIANGLES_WORDS, scalar) buffer CellWordsBlock {
	uint cell_words[]; // WorldCell as four words
};
layout(set = 0, binding = LIST_TRIANGLES_LIST, scalar) writeonly buffer CellTrianglesBlock {
	uint cell_triangles[];
};

void visit_cell(VoxelTriangle triangle, ivec3 cell) {
	uvec3 storage = storage_from_world_cell(cell + world.cascades[constants.cascade].origin_cells);
	uint brick = brick_of_cell(constants.cascade, storage);
	uint index = brick_cell_base[brick] + bits_below(occupancy[brick], bit_of_cell(storage));
	if (index >= cell_end(constants.cascade) || cell_words[index * 4u + 3u] == WORLD_NOT_LISTED) {
		return;
	}
	TriangleBoxTest test = make_box_test(triangle.v, 0.5, CELL_TOUCH);
	uint octants = 0u;
	for (uint i = 0u; i < 8u; i++) {
		vec3 low = vec3(cell) + 0.5 * vec3(float(i & 1u), float((i >> 1) & 1u), float(i >> 2));
		octants |= touches_box(test, low - CELL_TOUCH) ? 1u << i : 0u;
	}
	// Rounding must not lose a triangle that touches the cell.
	octants = octants == 0u ? 255u : octants;
	uint list = atomicAdd(cell_words[index * 4u + 3u], 1u);
	cell_triangles[(list >> 6) + (list & 63u)] = triangle.world_triangle | (octants << WORLD_TRIANGLE_NUMBER_BITS);
}
