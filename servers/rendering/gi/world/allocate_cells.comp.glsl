// SPDX-License-Identifier: MIT
// Gives every brick of a cascade its first stored cell: a running sum over the occupancy, by one work group.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_inc.glsl"
#include "servers/rendering/gi/world/group_scan_inc.glsl"

#define ALLOCATE_CELLS_BRICK_CELL_BASE 20
#define ALLOCATE_CELLS_COUNTS 21

layout(local_size_x = 256) in;
layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = ALLOCATE_CELLS_BRICK_CELL_BASE, scalar) writeonly buffer BrickCellBaseBlock {
	uint brick_cell_base[];
};
layout(set = 0, binding = ALLOCATE_CELLS_COUNTS, scalar) buffer CountsBlock {
	CascadeCounts counts[];
};
layout(push_constant, scalar) uniform AllocatePush {
	VoxelizeConstants constants;
};

void main() {
	uint axis = world.grid_size / WORLD_BRICK_CELLS;
	uint bricks = axis * axis * axis; // a multiple of 256: the grid has at least 32 cells an axis
	uint each = bricks / 256u;
	uint first = brick_base(constants.cascade) + gl_LocalInvocationIndex * each;
	uint sum = 0u;
	for (uint i = 0u; i < each; i++) {
		uvec2 mask = occupancy[first + i];
		sum += uint(bitCount(mask.x) + bitCount(mask.y));
	}
	uint index = cell_base(constants.cascade) + scan_group(sum);
	for (uint i = 0u; i < each; i++) {
		brick_cell_base[first + i] = index;
		uvec2 mask = occupancy[first + i];
		index += uint(bitCount(mask.x) + bitCount(mask.y));
	}
	if (gl_LocalInvocationIndex == 0u) {
		counts[constants.cascade].cells = group_total;
	}
}
