// SPDX-License-Identifier: MIT
// Gives every stored cell its first record and every record its cell: a running sum over the face masks, by one work group.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_inc.glsl"
#include "servers/rendering/gi/world/group_scan_inc.glsl"

#define ALLOCATE_RECORDS_COUNTS 20
#define ALLOCATE_RECORDS_CELLS 21
#define ALLOCATE_RECORDS_RECORDS 22

layout(local_size_x = 256) in;
layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = WORLD_BRICK_CELL_BASE, scalar) readonly buffer BrickCellBaseBlock {
	uint brick_cell_base[];
};
layout(set = 0, binding = ALLOCATE_RECORDS_COUNTS, scalar) buffer CountsBlock {
	CascadeCounts counts[];
};
layout(set = 0, binding = ALLOCATE_RECORDS_CELLS, scalar) buffer CellsBlock {
	WorldCell cells[];
};
layout(set = 0, binding = ALLOCATE_RECORDS_RECORDS, scalar) buffer RecordsBlock {
	WorldRecord records[];
};
layout(push_constant, scalar) uniform AllocatePush {
	VoxelizeConstants constants;
};

// Walks the brick's stored cells; with `write`, gives them records from `index` on. Returns the count.
uint walk_brick(uint brick_in_cascade, uint index, bool write) {
	uint last_cell = cell_end(constants.cascade);
	uint last_record = record_end(constants.cascade);
	uint brick = brick_base(constants.cascade) + brick_in_cascade;
	uint axis = world.grid_size / WORLD_BRICK_CELLS;
	uvec3 corner = 4u * uvec3(brick_in_cascade % axis, (brick_in_cascade / axis) % axis, brick_in_cascade / (axis * axis));
	uint cell = brick_cell_base[brick];
	uint total = 0u;
	for (uint word = 0u; word < 2u; word++) {
		uint mask = occupancy[brick][word];
		while (mask != 0u && cell < last_cell) {
			uint bit = uint(findLSB(mask)) + 32u * word;
			mask &= mask - 1u;
			uint faces = cells[cell].records & 63u;
			if (write) {
				uvec3 storage = corner + uvec3(bit & 3u, (bit >> 2) & 3u, bit >> 4);
				uint record = index + total;
				// Flat until mark_flat_cells finds otherwise; a cell whose records have no room is not.
				cells[cell].records = (record << 6) | faces | (record + uint(bitCount(faces)) <= last_record ? WORLD_CELL_FLAT : 0u);
				for (uint left = faces; left != 0u && record < last_record; left &= left - 1u) {
					records[record].cell = (constants.cascade << 27) | (uint(findLSB(left)) << 24) | (storage.z << 16) | (storage.y << 8) | storage.x;
					record++;
				}
			}
			total += uint(bitCount(faces));
			cell++;
		}
	}
	return total;
}

void main() {
	uint axis = world.grid_size / WORLD_BRICK_CELLS;
	uint each = axis * axis * axis / 256u;
	uint first = gl_LocalInvocationIndex * each;
	uint sum = 0u;
	for (uint i = 0u; i < each; i++) {
		sum += walk_brick(first + i, 0u, false);
	}
	uint index = record_base(constants.cascade) + scan_group(sum);
	for (uint i = 0u; i < each; i++) {
		index += walk_brick(first + i, index, true);
	}
	if (gl_LocalInvocationIndex == 0u) {
		counts[constants.cascade].records = group_total;
		counts[constants.cascade].light_groups = uvec3(clamp((min(group_total, world.record_capacity) + 7u) / 8u, 1u, 65535u), 1u, 1u);
	}
}
