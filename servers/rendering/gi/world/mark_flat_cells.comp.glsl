// SPDX-License-Identifier: MIT
// Takes the flat mark from every cell in which a triangle leaves the plane of its record.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/clip_triangle_inc.glsl"
#include "servers/rendering/gi/world/material_sample_inc.glsl"
#include "servers/rendering/gi/world/visit_triangles_inc.glsl"

#define MARK_FLAT_CELLS_WORDS 20

layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = WORLD_BRICK_CELL_BASE, scalar) readonly buffer BrickCellBaseBlock {
	uint brick_cell_base[];
};
layout(set = 0, binding = WORLD_RECORDS, scalar) readonly buffer RecordsBlock {
	WorldRecord records[];
};
layout(set = 0, binding = MARK_FLAT_CELLS_WORDS, scalar) buffer CellWordsBlock {
	uint cell_words[]; // WorldCell as three words
};

void visit_cell(VoxelTriangle triangle, ivec3 cell) {
	uvec3 storage = storage_from_world_cell(cell + world.cascades[constants.cascade].origin_cells);
	uint brick = brick_of_cell(constants.cascade, storage);
	uint index = brick_cell_base[brick] + bits_below(occupancy[brick], bit_of_cell(storage));
	if (index >= cell_end(constants.cascade)) {
		return;
	}
	MaterialData material = materials[surfaces[triangle.surface].material];
	uint face = face_from_normal(world_normal_from_cells(constants.cascade, front_normal(triangle, material)));
	uint packed_records = cell_words[index * 3u + 2u];
	uint faces = packed_records & 63u;
	uint record_index = cell_first_record(packed_records) + uint(bitCount(faces & ((1u << face) - 1u)));
	bool is_flat = !is_alpha_tested(material) && (faces & (1u << face)) != 0u && record_index < record_end(constants.cascade);
	if (is_flat) {
		vec3 cell_m = world.cascades[constants.cascade].cell_m;
		vec3 normal = record_normal(records[record_index]) * cell_m;
		vec3 center = record_position_in_cell(records[record_index]);
		float limit_m = WORLD_FLAT_SUB_VOXELS * cell_m.y / float(WORLD_SUB_VOXELS);
		Polygon polygon = clip_triangle(triangle, cell);
		for (uint i = 0u; i < polygon.count; i++) {
			is_flat = is_flat && abs(dot(polygon.v[i] - center, normal)) < limit_m;
		}
	}
	if (!is_flat) {
		atomicAnd(cell_words[index * 3u + 2u], ~WORLD_CELL_FLAT);
	}
}
