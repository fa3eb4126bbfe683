// SPDX-License-Identifier: MIT
// Adds what each triangle shows in each cell to the records of the faces that it belongs to, weighted by area.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/clip_triangle_inc.glsl"
#include "servers/rendering/gi/world/material_sample_inc.glsl"
#include "servers/rendering/gi/world/visit_triangles_inc.glsl"

#define ACCUMULATE_RECORDS_WORDS 20

layout(set = 0, binding = WORLD_OCCUPANCY, scalar) readonly buffer OccupancyBlock {
	uvec2 occupancy[];
};
layout(set = 0, binding = WORLD_BRICK_CELL_BASE, scalar) readonly buffer BrickCellBaseBlock {
	uint brick_cell_base[];
};
layout(set = 0, binding = WORLD_CELLS, scalar) readonly buffer CellsBlock {
	WorldCell cells[];
};
layout(set = 0, binding = ACCUMULATE_RECORDS_WORDS, scalar) buffer AccumulatorsBlock {
	uint accumulator_words[]; // RecordAccumulator as 14 words, from the cascade's first record
};

// own_area: without what neighbouring cells have too.
void add_to_record(uint record, float area, float own_area, vec3 albedo, vec3 emission, vec3 area_normal, vec3 position) {
	uint base = (record - record_base(constants.cascade)) * 14u;
	float scaled = area * WORLD_FIXED_AREA;
	atomicAdd(accumulator_words[base], max(1u, uint(scaled + 0.5)));
	vec3 fixed_emission = min(emission, vec3(60000.0)) * WORLD_FIXED_EMISSION;
	vec3 emission_sum = fixed_emission * area;
	atomicAdd(accumulator_words[base + 13u], uint(dot(fixed_emission, vec3(1.0 / 3.0)) * own_area + 0.5));
	for (uint i = 0u; i < 3u; i++) {
		atomicAdd(accumulator_words[base + 1u + i], uint(clamp(albedo[i], 0.0, 1.0) * scaled + 0.5));
		atomicAdd(accumulator_words[base + 4u + i], uint(emission_sum[i] + 0.5));
		atomicAdd(accumulator_words[base + 7u + i], uint(int(round(area_normal[i] * WORLD_FIXED_AREA))));
		atomicAdd(accumulator_words[base + 10u + i], uint(clamp(position[i], 0.0, 1.0) * scaled + 0.5));
	}
}

void visit_cell(VoxelTriangle triangle, ivec3 cell) {
	uvec3 storage = storage_from_world_cell(cell + world.cascades[constants.cascade].origin_cells);
	uint brick = brick_of_cell(constants.cascade, storage);
	uint index = brick_cell_base[brick] + bits_below(occupancy[brick], bit_of_cell(storage));
	if (index >= cell_end(constants.cascade)) {
		return;
	}
	Polygon polygon = clip_triangle(triangle, cell, CELL_TOUCH);
	vec3 center = vec3(0.0);
	float area_sum = 0.0;
	for (uint i = 2u; i < polygon.count; i++) {
		vec3 part = 0.5 * cross(polygon.v[i - 1u] - polygon.v[0], polygon.v[i] - polygon.v[0]);
		float part_area = length(part);
		center += part_area * (polygon.v[0] + polygon.v[i - 1u] + polygon.v[i]) / 3.0;
		area_sum += part_area;
	}
	if (!(area_sum > 0.0)) {
		return;
	}
	center /= area_sum;
	MaterialData material = materials[surfaces[triangle.surface].material];
	vec3 w = clamped_barycentric(triangle.v, center + vec3(cell));
	vec4 albedo = triangle_albedo(triangle, material, w);
	if (is_alpha_tested(material) && albedo.a < alpha_threshold(material)) {
		return;
	}
	vec3 emission = triangle_emission(triangle, material, w);
	vec3 front = front_normal(triangle, material);
	float own_area = emission != vec3(0.0) ? polygon_area(clip_triangle(triangle, cell, 0.0)) : 0.0;
	vec3 area_normal = normalize(front) * area_sum;
	uint face = face_from_normal(world_normal_from_cells(constants.cascade, front));
	uint packed_records = cells[index].records;
	uint mask = packed_records & 63u;
	for (uint side = 0u; side < 2u; side++) {
		uint record = cell_first_record(packed_records) + uint(bitCount(mask & ((1u << face) - 1u)));
		if ((mask & (1u << face)) != 0u && record < record_end(constants.cascade)) {
			add_to_record(record, area_sum, own_area, triangle_reflectance(material, albedo), emission, area_normal, center);
		}
		if ((material.flags & MATERIAL_FLAG_DOUBLE_SIDED) == 0u) {
			return;
		}
		face ^= 1u;
		area_normal = -area_normal;
	}
}
