// SPDX-License-Identifier: MIT
// Exact Euclidean distance between cells' centres, one axis a pass: minimum over a line of (distance so far)^2 + offset^2.
// Pass x reads the occupancy, pass z writes the packed result; between them squared distances are words. A work group is a listed brick; elsewhere everything is far already.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_inc.glsl"

#define BUILD_SDF_FROM 20 // uint a cell: squared distance in cells^2
#define BUILD_SDF_TO 21
#define BUILD_SDF_PACKED 22
#define BUILD_SDF_LIST 23 // mark_near_bricks

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = BUILD_SDF_FROM, scalar) readonly buffer FromBlock {
	uint from_squared[];
};
layout(set = 0, binding = BUILD_SDF_TO, scalar) writeonly buffer ToBlock {
	uint to_squared[];
};
layout(set = 0, binding = BUILD_SDF_PACKED, scalar) writeonly buffer PackedBlock {
	uint sdf[];
};
layout(set = 0, binding = BUILD_SDF_LIST, scalar) readonly buffer ListBlock {
	NearBrickHeader header;
	uint near_list[];
};
layout(push_constant, scalar) uniform BuildSdfPush {
	BuildSdfConstants constants;
};

shared uint group_bytes[64];

uint line_index(uvec3 cell) {
	return (cell.z * world.grid_size + cell.y) * world.grid_size + cell.x;
}

// The bits of the four cells along x of a brick's row, at their place in the line; none outside of the window.
uint row_bits(ivec3 cell, int brick_x) {
	if (brick_x < 0 || brick_x * WORLD_BRICK_CELLS >= int(world.grid_size)) {
		return 0u;
	}
	uvec3 storage = storage_from_world_cell(ivec3(brick_x * WORLD_BRICK_CELLS, cell.yz) + world.cascades[constants.cascade].origin_cells);
	uint bit = bit_of_cell(storage); // x part is 0: origins are multiples of a brick
	return (occupancy[brick_of_cell(constants.cascade, storage)][bit >> 5] >> (bit & 31u)) & 15u;
}

// Squared distance to the nearest stored cell of the same line along x.
uint distance_along_x(ivec3 cell) {
	int brick_x = cell.x / WORLD_BRICK_CELLS;
	int best = 1 << 12;
	for (int i = 0; i <= WORLD_SDF_RADIUS_BRICKS; i++) {
		uint right = row_bits(cell, brick_x + i);
		uint left = row_bits(cell, brick_x - i);
		int at_or_right = i == 0 ? cell.x & 3 : 0;
		right &= 15u << at_or_right;
		left &= i == 0 ? 15u >> (3 - (cell.x & 3)) : 15u;
		if (right != 0u) {
			best = min(best, (brick_x + i) * WORLD_BRICK_CELLS + findLSB(right) - cell.x);
		}
		if (left != 0u) {
			best = min(best, cell.x - (brick_x - i) * WORLD_BRICK_CELLS - findMSB(left));
		}
		if (best <= 4 * i) {
			break;
		}
	}
	return min(uint(best * best), WORLD_SDF_FAR_SQUARED);
}

uint distance_along_line(uvec3 cell) {
	uint axis = constants.axis;
	uint here = cell[axis];
	uint best = from_squared[line_index(cell)];
	for (uint offset = 1u; offset <= WORLD_SDF_RADIUS_CELLS + 1u && offset * offset < best; offset++) {
		uvec3 other = cell;
		if (here >= offset) {
			other[axis] = here - offset;
			best = min(best, from_squared[line_index(other)] + offset * offset);
		}
		if (here + offset < world.grid_size) {
			other[axis] = here + offset;
			best = min(best, from_squared[line_index(other)] + offset * offset);
		}
	}
	return best;
}

void main() {
	uint slot = gl_WorkGroupID.y * NEAR_BRICKS_A_ROW + gl_WorkGroupID.x;
	if (slot >= header.count) {
		return;
	}
	uint brick = near_list[slot];
	uvec3 cell = (uvec3(brick, brick >> 10, brick >> 20) & 1023u) * WORLD_BRICK_CELLS + gl_LocalInvocationID;
	uint best = constants.axis == 0u ? distance_along_x(ivec3(cell)) : distance_along_line(cell);
	if (constants.axis < 2u) {
		to_squared[line_index(cell)] = best;
		return;
	}
	uvec3 storage = storage_from_world_cell(ivec3(cell) + world.cascades[constants.cascade].origin_cells);
	group_bytes[bit_of_cell(storage)] = min(255u, uint(floor(sqrt(float(best)) * WORLD_SDF_SCALE)));
	barrier();
	uint lane = gl_LocalInvocationIndex;
	if (lane < 16u) {
		uint word = group_bytes[lane * 4u] | (group_bytes[lane * 4u + 1u] << 8) | (group_bytes[lane * 4u + 2u] << 16) | (group_bytes[lane * 4u + 3u] << 24);
		sdf[brick_of_cell(constants.cascade, storage) * 16u + lane] = word;
	}
}
