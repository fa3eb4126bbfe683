// SPDX-License-Identifier: MIT
// Gives every stored cell its first record and room for its list of triangles, and every record its cell: running sums by one work group.
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

// Walks the brick's stored cells; with `write`, gives them records and triangles from `next` on. Returns the counts of both.
uvec2 walk_brick(uint brick_in_cascade, uvec2 next, bool write) {
	uint last_cell = cell_end(constants.cascade);
	uint last_record = record_end(constants.cascade);
	uint last_triangle = (constants.cascade + 1u) * world.triangle_capacity;
	uint brick = brick_base(constants.cascade) + brick_in_cascade;
	uint axis = world.grid_size / WORLD_BRICK_CELLS;
	uvec3 corner = 4u * uvec3(brick_in_cascade % axis, (brick_in_cascade / axis) % axis, brick_in_cascade / (axis * axis));
	uint cell = brick_cell_base[brick];
	uvec2 total = uvec2(0u);
	for (uint word = 0u; word < 2u; word++) {
		uint mask = occupancy[brick][word];
		while (mask != 0u && cell < last_cell) {
			uint bit = uint(findLSB(mask)) + 32u * word;
			mask &= mask - 1u;
			uint faces = cells[cell].records & 63u;
			uint triangles = cells[cell].triangles;
			bool listed = triangles <= WORLD_LISTED_TRIANGLES;
			if (write) {
				uvec3 storage = corner + uvec3(bit & 3u, (bit >> 2) & 3u, bit >> 4);
				uint record = next.x + total.x;
				uint triangle = next.y + total.y;
				// Flat until mark_flat_cells finds otherwise; a cell whose records have no room is not.
				cells[cell].records = (record << 6) | faces | (record + uint(bitCount(faces)) <= last_record ? WORLD_CELL_FLAT : 0u);
				// list_triangles counts up.
				cells[cell].triangles = listed && triangle + triangles <= last_triangle ? triangle << 6 : WORLD_NOT_LISTED;
				for (uint left = faces; left != 0u && record < last_record; left &= left - 1u) {
					records[record].cell = (constants.cascade << 27) | (uint(findLSB(left)) << 24) | (storage.z << 16) | (storage.y << 8) | storage.x;
					record++;
				}
			}
			total += uvec2(uint(bitCount(faces)), listed ? triangles : 0u);
			cell++;
		}
	}
	return total;
}

void main() {
	uint axis = world.grid_size / WORLD_BRICK_CELLS;
	uint each = axis * axis * axis / 256u;
	uint first = gl_LocalInvocationIndex * each;
	uvec2 sum = uvec2(0u);
	for (uint i = 0u; i < each; i++) {
		sum += walk_brick(first + i, uvec2(0u), false);
	}
	uvec2 next;
	next.x = record_base(constants.cascade) + scan_group(sum.x);
	uint record_total = group_total;
	next.y = constants.cascade * world.triangle_capacity + scan_group(sum.y);
	uint triangle_total = group_total;
	for (uint i = 0u; i < each; i++) {
		next += walk_brick(first + i, next, true);
	}
	if (gl_LocalInvocationIndex == 0u) {
		counts[constants.cascade].records = record_total;
		counts[constants.cascade].triangles = triangle_total;
		counts[constants.cascade].light_groups = uvec3(clamp((min(record_total, world.record_capacity) + 7u) / 8u, 1u, 65535u), 1u, 1u);
	}
}
