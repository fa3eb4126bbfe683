// SPDX-License-Identifier: MIT
// Finds the free point that a record's rays start from, and with it the place in the record's plane that stands for the record.
//
// A cell's part of a surface may be hidden in places: a floor goes on under a box, a wall behind the one that it meets. Where a cell has
// several records, the centroid is taken only if rays from its start see fronts of surfaces; else the sub-voxel column that
// sees the fewest backs.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/trace_world_inc.glsl"
#include "servers/rendering/shaders/sampling_inc.glsl"

#define PLACE_STARTS_COUNTS 20
#define PLACE_STARTS_OUT 21

#define TEST_RAYS 4u
#define TEST_REACH_CELLS 16.0

layout(local_size_x = 64) in;
layout(set = 0, binding = PLACE_STARTS_COUNTS, scalar) readonly buffer CountsBlock {
	CascadeCounts counts[];
};
layout(set = 0, binding = PLACE_STARTS_OUT, scalar) writeonly buffer PositionsBlock {
	uvec2 new_places[]; // WorldRecord.position and .area, from the cascade's first record
};
layout(push_constant, scalar) uniform PlacePush {
	VoxelizeConstants constants;
};

#define MAX_START 29u

// How many steps along the normal are free, by triangles and the planes of flat cells: less than MAX_START where another surface faces this one.
uint free_steps(uint cascade, vec3 position_m, vec3 normal, float step_m) {
	float off_m = 0.1 * step_m;
	WorldHit hit = trace_world(position_m + normal * off_m, normal, float(MAX_START) * step_m, cascade);
	return hit.hit ? uint((hit.t_m + off_m) / step_m) : MAX_START;
}

// Quarter sub-voxels along the normal to the first free sub-voxel; 0: none within seven sub-voxels. In a gap without a free sub-voxel, where
// the cell knows its surfaces, half way through.
uint find_start(uint cascade, vec3 position_m, vec3 normal, bool is_exact) {
	float step_m = 0.25 * sub_voxel_along_m(cascade, normal);
	uint steps = is_exact ? free_steps(cascade, position_m, normal, step_m) : MAX_START;
	for (uint i = 3u; i < MAX_START && i < steps; i++) {
		if (!sub_voxel_is_solid(cascade, position_m + normal * (float(i) * step_m))) {
			// A little further, so that the point isn't on the solid's face; still in the sub-voxel or the next one.
			uint further = min(i + 1u, steps - 1u);
			return sub_voxel_is_solid(cascade, position_m + normal * (float(further) * step_m)) ? i : further;
		}
	}
	// In the open within solid sub-voxels: as far off as a free one would be.
	return is_exact ? min((steps + 1u) / 2u, 4u) : 0u;
}

// How many of the test rays from the start end at the back of a surface, or within a sub-voxel: in the inside of a thin solid.
uint backs_seen(uint cascade, WorldRecord record) {
	vec3 normal = record_normal(record);
	vec3 start_m = record_start_m(record);
	uint backs = 0u;
	for (uint i = 0u; i < TEST_RAYS; i++) {
		vec3 direction = cosine_direction(r2_point(i, 0u), normal);
		WorldHit hit = trace_world(start_m, direction, TEST_REACH_CELLS * world.cascades[cascade].cell_m.x, cascade);
		if (!hit.hit || hit.cell >= WORLD_LOST_CELL) {
			continue;
		}
		if (hit.face == HIT_BACK || hit.t_m < sub_voxel_along_m(cascade, direction)) {
			backs++;
			continue;
		}
		if (hit.face != HIT_BITS) {
			continue;
		}
		uint packed_records = world_cells[hit.cell].records;
		uint index = cell_first_record(packed_records);
		uint end = record_end(hit.cascade);
		bool front = false;
		for (uint faces = packed_records & 63u; faces != 0u && index < end; faces &= faces - 1u, index++) {
			front = front || dot(record_normal(world_records[index]), direction) < 0.0;
		}
		backs += front ? 0u : 1u;
	}
	return backs;
}

// The record's place moved within its plane to the middle of a sub-voxel column; false: the plane leaves the cell there.
bool move_to_column(inout WorldRecord record, uint column) {
	uint axis = record_face(record) >> 1;
	uint a = (axis + 1u) % 3u;
	uint b = (axis + 2u) % 3u;
	vec3 normal = record_normal(record) * world.cascades[record_cascade(record)].cell_m;
	vec3 center = record_position_in_cell(record);
	vec3 moved = center;
	moved[a] = (float(column & 3u) + 0.5) / 4.0;
	moved[b] = (float(column >> 2) + 0.5) / 4.0;
	moved[axis] -= ((moved[a] - center[a]) * normal[a] + (moved[b] - center[b]) * normal[b]) / normal[axis];
	if (moved[axis] < 0.0 || moved[axis] > 1.0) {
		return false;
	}
	uvec3 p = uvec3(moved * 511.0 + 0.5);
	record.position = p.x | (p.y << 9) | (p.z << 18);
	return true;
}

// The outermost of a listed cell's triangles that show a face on the line through a place along its axis, in cells from the cell's lowest side;
// y: how many such there are, z: how many of these are emissive.
vec3 outermost_triangle(uint cascade, WorldCell cell, ivec3 at, uint face, vec3 place) {
	uint axis = face >> 1;
	vec3 cell_m = world.cascades[cascade].cell_m;
	place[axis] = -0.001;
	vec3 d = vec3(0.0);
	d[axis] = cell_m[axis];
	float sign_out = (face & 1u) == 0u ? 1.0 : -1.0;
	vec3 result = vec3(0.0);
	for (uint i = 0u; i < (cell.triangles & 63u); i++) {
		uint number = world_cell_triangles[(cell.triangles >> 6) + i] & WORLD_TRIANGLE_NUMBER_MASK;
		float along;
		uint flags;
		float t = meet_triangle(number, (vec3(at) + place) * cell_m, d, vec2(0.0, 1.002), 0.0, along, flags);
		uint front = flags & WORLD_TRIANGLE_FACE;
		if (t >= 0.0 && (front == face || ((flags & WORLD_TRIANGLE_DOUBLE_SIDED) != 0u && (front ^ 1u) == face))) {
			result.x = result.y == 0.0 || (t - result.x - 0.001) * sign_out > 0.0 ? t - 0.001 : result.x;
			result.y += 1.0;
			result.z += (flags & WORLD_TRIANGLE_EMISSIVE) != 0u ? 1.0 : 0.0;
		}
	}
	return result;
}

// Puts a record's place onto the outermost of its triangles along its axis, in a cell that lists them; false: there is none. The mean of two
// surfaces lies on neither, and the inner ones are the insides of solids more often than not.
bool move_to_triangle(inout WorldRecord record, WorldCell cell) {
	uint axis = record_face(record) >> 1;
	vec3 place = record_position_in_cell(record);
	vec3 outermost = outermost_triangle(record_cascade(record), cell, record_world_cell(record), record_face(record), place);
	if (outermost.y == 0.0) {
		return false;
	}
	place[axis] = clamp(outermost.x, 0.0, 1.0);
	uvec3 p = uvec3(place * 511.0 + 0.5);
	record.position = p.x | (p.y << 9) | (p.z << 18);
	return true;
}

// WorldRecord.area with the share of the emission that can leave the cell: of emissive surfaces one behind the other the outermost gives light.
uint seen_area(uint cascade, WorldRecord record) {
	WorldCell cell = world_cells[find_cell(cascade, storage_from_world_cell(record_world_cell(record)))];
	if (record.emission == 0u || !cell_is_listed(cell) || (cell.records & WORLD_CELL_FLAT) != 0u) {
		return record.area;
	}
	uint axis = record_face(record) >> 1;
	vec2 seen = vec2(0.0);
	for (uint i = 0u; i < 16u; i++) {
		vec3 place = vec3(0.0);
		place[(axis + 1u) % 3u] = (float(i & 3u) + 0.5) / 4.0;
		place[(axis + 2u) % 3u] = (float(i >> 2) + 0.5) / 4.0;
		float surfaces = outermost_triangle(cascade, cell, record_world_cell(record), record_face(record), place).z;
		seen += vec2(min(surfaces, 1.0), surfaces);
	}
	float share = seen.y > 0.0 ? seen.x / seen.y : 1.0;
	return (record.area & ~255u) | uint(float(record.area & 255u) * share + 0.5);
}

uint placed(uint cascade, WorldRecord record) {
	vec3 normal = record_normal(record);
	WorldCell cell = world_cells[find_cell(cascade, storage_from_world_cell(record_world_cell(record)))];
	bool is_flat = (cell.records & WORLD_CELL_FLAT) != 0u;
	bool is_listed = cell_is_listed(cell);
	if (is_listed && !is_flat) {
		move_to_triangle(record, cell);
	}
	uint best = record.position | (find_start(cascade, record_position_m(record), normal, is_flat || is_listed) << 27);
	uint faces = cell.records & 63u;
	if ((faces & (faces - 1u)) == 0u) {
		return best;
	}
	WorldRecord at = record;
	at.position = best;
	uint fewest = record_has_start(at) ? backs_seen(cascade, at) : TEST_RAYS + 1u;
	uint columns = columns_of_bits(cell.bits, record_face(record) >> 1);
	for (uint k = 0u; k < 16u && fewest > 0u; k++) {
		uint column = (k * 7u) & 15u;
		at = record;
		if (((columns >> column) & 1u) == 0u || !move_to_column(at, column)) {
			continue;
		}
		if (is_listed && !is_flat && !move_to_triangle(at, cell)) {
			continue;
		}
		uint start = find_start(cascade, record_position_m(at), normal, is_flat || is_listed);
		at.position |= start << 27;
		uint backs = start != 0u ? backs_seen(cascade, at) : TEST_RAYS + 1u;
		if (backs < fewest) {
			fewest = backs;
			best = at.position;
		}
	}
	return best;
}

void main() {
	uint count = min(counts[constants.cascade].records, world.record_capacity);
	uint stride = gl_NumWorkGroups.x * 64u;
	for (uint i = gl_GlobalInvocationID.x; i < count; i += stride) {
		WorldRecord record = world_records[record_base(constants.cascade) + i];
		new_places[i] = uvec2(placed(constants.cascade, record), seen_area(constants.cascade, record));
	}
}
