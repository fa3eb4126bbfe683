// SPDX-License-Identifier: MIT
// Sets the sub-voxel bits and the face masks of stored cells.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/material_sample_inc.glsl"
#include "servers/rendering/gi/world/visit_triangles_inc.glsl"

#define VOXELIZE_CELLS_WORDS 20

layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = WORLD_BRICK_CELL_BASE, scalar) readonly buffer BrickCellBaseBlock {
	uint brick_cell_base[];
};
layout(set = 0, binding = VOXELIZE_CELLS_WORDS, scalar) buffer CellWordsBlock {
	uint cell_words[]; // WorldCell as four words: bits, bits, records (here: the face mask only), triangles (here: their count)
};

void visit_cell(VoxelTriangle triangle, ivec3 cell) {
	uvec3 storage = storage_from_world_cell(cell + world.cascades[constants.cascade].origin_cells);
	uint brick = brick_of_cell(constants.cascade, storage);
	uint index = brick_cell_base[brick] + bits_below(occupancy[brick], bit_of_cell(storage));
	if (index >= cell_end(constants.cascade)) {
		return;
	}
	atomicAdd(cell_words[index * 4u + 3u], triangle.world_triangle < constants.stored_triangles ? 1u : WORLD_LISTED_TRIANGLES + 1u);
	MaterialData material = materials[surfaces[triangle.surface].material];
	bool alpha_tested = is_alpha_tested(material);
	const float size = 1.0 / float(WORLD_SUB_VOXELS);
	TriangleBoxTest test = make_box_test(triangle.v, size, CELL_TOUCH);
	uvec2 bits = uvec2(0u);
	// The sub-voxels in the triangle's box; rounding must not cost one, touches_box decides.
	const float ROUNDING = 1e-3;
	ivec3 first = ivec3(max(ceil((test.low + CELL_TOUCH - vec3(cell)) / size - ROUNDING), vec3(0.0)));
	ivec3 last = ivec3(min(floor((test.high + CELL_TOUCH - vec3(cell)) / size + ROUNDING), vec3(3.0)));
	for (int z = first.z; z <= last.z; z++) {
		for (int y = first.y; y <= last.y; y++) {
			for (int x = first.x; x <= last.x; x++) {
				vec3 low = vec3(cell) + vec3(float(x), float(y), float(z)) * size;
				if (!touches_box(test, low - CELL_TOUCH)) {
					continue;
				}
				if (alpha_tested) {
					vec3 w = clamped_barycentric(triangle.v, low + 0.5 * size);
					if (triangle_albedo(triangle, material, w).a < alpha_threshold(material)) {
						continue;
					}
				}
				uint bit = 1u << uint(x + 4 * y + 16 * (z & 1));
				bits.x |= z < 2 ? bit : 0u;
				bits.y |= z < 2 ? 0u : bit;
			}
		}
	}
	if ((bits.x | bits.y) == 0u) {
		return;
	}
	vec3 n = world_normal_from_cells(constants.cascade, front_normal(triangle, material));
	uint face = face_from_normal(n);
	uint faces = 1u << face;
	if ((material.flags & MATERIAL_FLAG_DOUBLE_SIDED) != 0u) {
		faces |= 1u << (face ^ 1u);
	}
	atomicOr(cell_words[index * 4u], bits.x);
	atomicOr(cell_words[index * 4u + 1u], bits.y);
	atomicOr(cell_words[index * 4u + 2u], faces);
}
