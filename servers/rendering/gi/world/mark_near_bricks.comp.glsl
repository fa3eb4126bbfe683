// SPDX-License-Identifier: MIT
// Which bricks have a stored cell within WORLD_SDF_RADIUS_BRICKS bricks an axis, one axis a pass, the last one lists them: the distance field is only computed there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_inc.glsl"

#define MARK_NEAR_BRICKS_FROM 20 // uint a brick of the window, 0 or 1
#define MARK_NEAR_BRICKS_TO 21
#define MARK_NEAR_BRICKS_LIST 22

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = MARK_NEAR_BRICKS_FROM, scalar) readonly buffer FromBlock {
	uint from_near[];
};
layout(set = 0, binding = MARK_NEAR_BRICKS_TO, scalar) writeonly buffer ToBlock {
	uint to_near[];
};
layout(set = 0, binding = MARK_NEAR_BRICKS_LIST, scalar) buffer ListBlock {
	NearBrickHeader header;
	uint near_list[];
};
layout(push_constant, scalar) uniform MarkNearPush {
	BuildSdfConstants constants;
};

void main() {
	ivec3 brick = ivec3(gl_GlobalInvocationID);
	int bricks = int(world.grid_size) / WORLD_BRICK_CELLS;
	uint axis = constants.axis;
	uint near = 0u;
	int low = max(brick[axis] - WORLD_SDF_RADIUS_BRICKS, 0);
	int high = min(brick[axis] + WORLD_SDF_RADIUS_BRICKS, bricks - 1);
	for (int i = low; i <= high; i++) {
		ivec3 other = brick;
		other[axis] = i;
		if (axis == 0u) {
			uvec2 mask = occupancy[brick_of_cell(constants.cascade, storage_from_world_cell(other * WORLD_BRICK_CELLS + world.cascades[constants.cascade].origin_cells))];
			near |= mask.x | mask.y;
		} else {
			near |= from_near[(other.z * bricks + other.y) * bricks + other.x];
		}
	}
	if (axis == 2u && near != 0u) {
		uint slot = atomicAdd(header.count, 1u);
		atomicMax(header.groups.x, min(slot + 1u, NEAR_BRICKS_A_ROW));
		atomicMax(header.groups.y, slot / NEAR_BRICKS_A_ROW + 1u);
		atomicMax(header.groups.z, 1u);
		near_list[slot] = uint(brick.x) | (uint(brick.y) << 10) | (uint(brick.z) << 20);
	}
	to_near[(brick.z * bricks + brick.y) * bricks + brick.x] = near != 0u ? 1u : 0u;
}
