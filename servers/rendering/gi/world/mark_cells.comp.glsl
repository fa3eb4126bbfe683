// SPDX-License-Identifier: MIT
// Sets the occupancy bit of every cell that a triangle touches.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/visit_triangles_inc.glsl"

#define MARK_CELLS_OCCUPANCY WORLD_OCCUPANCY

layout(set = 0, binding = MARK_CELLS_OCCUPANCY, scalar) buffer OccupancyBlock {
	uint occupancy_words[]; // two a brick
};

void visit_cell(VoxelTriangle triangle, ivec3 cell) {
	uvec3 storage = storage_from_world_cell(cell + world.cascades[constants.cascade].origin_cells);
	uint bit = bit_of_cell(storage);
	uint word = brick_of_cell(constants.cascade, storage) * 2u + (bit >> 5);
	uint mask = 1u << (bit & 31u);
	if ((occupancy_words[word] & mask) == 0u) {
		atomicOr(occupancy_words[word], mask);
	}
}
