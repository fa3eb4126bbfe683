// SPDX-License-Identifier: MIT
// Exact Euclidean distance between cells' centres, one axis a pass: minimum over a line of (distance so far)^2 + offset^2.
// Pass x reads the occupancy, pass z writes the packed result; between them squared distances are 16-bit words.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_inc.glsl"

#define BUILD_SDF_FROM 20 // uint a cell: squared distance in cells^2
#define BUILD_SDF_TO 21
#define BUILD_SDF_PACKED 22

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
layout(push_constant, scalar) uniform BuildSdfPush {
	BuildSdfConstants constants;
};

shared uint group_bytes[64];

#define FAR_SQUARED 4096u // more than (WORLD_SDF_RADIUS_CELLS + 1)^2

uint line_index(uvec3 cell) {
	return (cell.z * world.grid_size + cell.y) * world.grid_size + cell.x;
}

// Squared distance along the earlier axes at a cell of the window (0 .. grid_size - 1 from the cascade's origin).
uint earlier(uvec3 cell) {
	if (constants.axis == 0u) {
		uvec3 storage = storage_from_world_cell(ivec3(cell) + world.cascades[constants.cascade].origin_cells);
		return bit_is_set(occupancy[brick_of_cell(constants.cascade, storage)], bit_of_cell(storage)) ? 0u : FAR_SQUARED;
	}
	return from_squared[line_index(cell)];
}

void main() {
	uvec3 cell = gl_GlobalInvocationID;
	uint axis = constants.axis;
	uint here = cell[axis];
	uint best = earlier(cell);
	for (uint offset = 1u; offset <= WORLD_SDF_RADIUS_CELLS + 1u && offset * offset < best; offset++) {
		uvec3 other = cell;
		if (here >= offset) {
			other[axis] = here - offset;
			best = min(best, earlier(other) + offset * offset);
		}
		if (here + offset < world.grid_size) {
			other[axis] = here + offset;
			best = min(best, earlier(other) + offset * offset);
		}
	}
	if (axis < 2u) {
		to_squared[line_index(cell)] = best;
		return;
	}
	// The group is a 4 x 4 x 4 block of the window; origins are multiples of 4 cells, so it is a brick.
	uvec3 storage = storage_from_world_cell(ivec3(cell) + world.cascades[constants.cascade].origin_cells);
	group_bytes[bit_of_cell(storage)] = min(255u, uint(floor(sqrt(float(best)) * WORLD_SDF_SCALE)));
	barrier();
	uint lane = gl_LocalInvocationIndex;
	if (lane < 16u) {
		uint word = group_bytes[lane * 4u] | (group_bytes[lane * 4u + 1u] << 8) | (group_bytes[lane * 4u + 2u] << 16) | (group_bytes[lane * 4u + 3u] << 24);
		sdf[brick_of_cell(constants.cascade, storage) * 16u + lane] = word;
	}
}
