// SPDX-License-Identifier: MIT
// Takes the flat mark from every cell in which a triangle leaves the plane of its record, and notes in front of which of the cell's other
// records it goes on: a surface that doesn't ends at their edge, and its plane beyond is open.
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
layout(set = 0, binding = WORLD_RECORDS, scalar) buffer RecordWordsBlock {
	uint record_words[]; // WorldRecord as six words
};
layout(set = 0, binding = MARK_FLAT_CELLS_WORDS, scalar) buffer CellWordsBlock {
	uint cell_words[]; // WorldCell as four words
};

// A record's plane: unit normal times cell size, so that distances of cell-local points from `center` are in metres.
void record_plane(uint index, out vec3 normal, out vec3 center) {
	WorldRecord record;
	record.position = record_words[index * 6u];
	record.normal = record_words[index * 6u + 1u];
	normal = record_normal(record) * world.cascades[constants.cascade].cell_m;
	center = record_position_in_cell(record);
}

void visit_cell(VoxelTriangle triangle, ivec3 cell) {
	uvec3 storage = storage_from_world_cell(cell + world.cascades[constants.cascade].origin_cells);
	uint brick = brick_of_cell(constants.cascade, storage);
	uint index = brick_cell_base[brick] + bits_below(occupancy[brick], bit_of_cell(storage));
	if (index >= cell_end(constants.cascade)) {
		return;
	}
	MaterialData material = materials[surfaces[triangle.surface].material];
	uint face = face_from_normal(world_normal_from_cells(constants.cascade, front_normal(triangle, material)));
	uint packed_records = cell_words[index * 4u + 2u];
	uint faces = packed_records & 63u;
	uint record_index = cell_first_record(packed_records) + uint(bitCount(faces & ((1u << face) - 1u)));
	bool is_flat = !is_alpha_tested(material) && (faces & (1u << face)) != 0u && record_index < record_end(constants.cascade);
	uint spill = 0u;
	if (is_flat) {
		float limit_m = WORLD_FLAT_SUB_VOXELS * world.cascades[constants.cascade].cell_m.y / float(WORLD_SUB_VOXELS);
		Polygon polygon = clip_triangle(triangle, cell, CELL_TOUCH);
		uint other = cell_first_record(packed_records);
		for (uint left = faces; left != 0u; left &= left - 1u, other++) {
			vec3 normal;
			vec3 center;
			record_plane(other, normal, center);
			for (uint i = 0u; i < polygon.count; i++) {
				float off = dot(polygon.v[i] - center, normal);
				if (other == record_index) {
					is_flat = is_flat && abs(off) < limit_m;
				} else if (off > limit_m) {
					spill |= 1u << uint(findLSB(left));
				}
			}
		}
		if (spill != 0u) {
			atomicOr(record_words[record_index * 6u + 1u], spill << 26);
			uint back = face ^ 1u;
			uint back_index = cell_first_record(packed_records) + uint(bitCount(faces & ((1u << back) - 1u)));
			if ((material.flags & MATERIAL_FLAG_DOUBLE_SIDED) != 0u && (faces & (1u << back)) != 0u && back_index < record_end(constants.cascade)) {
				atomicOr(record_words[back_index * 6u + 1u], spill << 26);
			}
		}
	}
	if (!is_flat) {
		atomicAnd(cell_words[index * 4u + 2u], ~WORLD_CELL_FLAT);
	}
}
