// SPDX-License-Identifier: MIT
// What the world holds at a point: stored cells, their solid bits, the distance field.
#ifndef WORLD_LOOKUP_INC
#define WORLD_LOOKUP_INC
#include "servers/rendering/gi/world/world_inc.glsl"

layout(set = 0, binding = WORLD_BINDING(WORLD_OCCUPANCY), scalar) readonly buffer WorldOccupancyBlock {
	uvec2 world_occupancy[];
};
layout(set = 0, binding = WORLD_BINDING(WORLD_BRICK_CELL_BASE), scalar) readonly buffer WorldBrickCellBaseBlock {
	uint world_brick_cell_base[];
};
layout(set = 0, binding = WORLD_BINDING(WORLD_CELLS), scalar) readonly buffer WorldCellsBlock {
	WorldCell world_cells[];
};
layout(set = 0, binding = WORLD_BINDING(WORLD_SDF), scalar) readonly buffer WorldSdfBlock {
	uint world_sdf[];
};

layout(set = 0, binding = WORLD_BINDING(WORLD_CELL_TRIANGLES), scalar) readonly buffer WorldCellTrianglesBlock {
	uint world_cell_triangles[];
};
layout(set = 0, binding = WORLD_BINDING(WORLD_TRIANGLES), std430) readonly buffer WorldTrianglesBlock {
	vec4 world_triangles[];
};

#define WORLD_NO_CELL 0xFFFFFFFFu
// A stored cell without memory for its content (capacity reached): solid and black.
#define WORLD_LOST_CELL 0xFFFFFFFEu

uint find_cell(uint cascade, uvec3 storage) {
	uint brick = brick_of_cell(cascade, storage);
	uvec2 mask = world_occupancy[brick];
	count_fetch(8u);
	uint bit = bit_of_cell(storage);
	if (!bit_is_set(mask, bit)) {
		return WORLD_NO_CELL;
	}
	uint index = world_brick_cell_base[brick] + bits_below(mask, bit);
	count_fetch(4u);
	return index < cell_end(cascade) ? index : WORLD_LOST_CELL;
}

WorldCell stored_cell(uint index) {
	count_fetch(16u);
	return world_cells[index];
}

// The content of a world-fixed cell: no bits where nothing is stored, all bits and no records where it has no memory.
WorldCell load_cell(uint cascade, ivec3 cell) {
	uint index = find_cell(cascade, storage_from_world_cell(cell));
	if (index >= WORLD_LOST_CELL) {
		return WorldCell(uvec2(index == WORLD_NO_CELL ? 0u : 0xFFFFFFFFu), 0u, WORLD_NOT_LISTED);
	}
	return stored_cell(index);
}

// Distance in cells to the nearest stored cell's centre, rounded down to a sixteenth.
float sdf_cells(uint cascade, uvec3 storage) {
	uint bit = bit_of_cell(storage);
	uint word = world_sdf[brick_of_cell(cascade, storage) * 16u + (bit >> 2)];
	count_fetch(4u);
	return float((word >> ((bit & 3u) * 8u)) & 255u) / WORLD_SDF_SCALE;
}

bool sub_voxel_is_solid(uint cascade, vec3 position_m) {
	vec3 p = position_m / world.cascades[cascade].cell_m;
	ivec3 cell = ivec3(floor(p));
	uint index = find_cell(cascade, storage_from_world_cell(cell));
	if (index == WORLD_NO_CELL) {
		return false;
	}
	if (index == WORLD_LOST_CELL) {
		return true;
	}
	uvec3 s = uvec3(clamp(floor((p - vec3(cell)) * float(WORLD_SUB_VOXELS)), vec3(0.0), vec3(3.0)));
	return bit_is_set(stored_cell(index).bits, s.x + 4u * s.y + 16u * s.z);
}

#endif
