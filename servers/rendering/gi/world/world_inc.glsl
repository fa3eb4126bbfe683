// SPDX-License-Identifier: MIT
// Addressing of the world's cells (world_io.h) and unpacking of its records. Needs no binding but WORLD_PARAMS.
#ifndef WORLD_INC
#define WORLD_INC
#include "servers/rendering/gi/world/world_io.h"
#include "servers/rendering/shaders/color_encoding_inc.glsl"
#include "servers/rendering/shaders/octahedral_inc.glsl"

#ifndef WORLD_BINDING
#define WORLD_BINDING(m_index) m_index
#endif

// Loads from buffers and textures are counted in passes that are specialised for it, a structure or a bilinear lookup as one.
layout(constant_id = COUNT_FETCHES_ID) const uint COUNT_FETCHES = 0u;
uint fetch_count = 0u;
uint fetch_bytes = 0u;
void count_fetch(uint bytes) {
	if (COUNT_FETCHES != 0u) {
		fetch_count++;
		fetch_bytes += bytes;
	}
}

layout(set = 0, binding = WORLD_BINDING(WORLD_PARAMS), scalar) uniform WorldParamsBlock {
	GiWorldParams world;
};

// First brick, stored cell and record of a cascade: every cascade has the same room.
uint brick_base(uint cascade) {
	uint bricks = world.grid_size / WORLD_BRICK_CELLS;
	return cascade * bricks * bricks * bricks;
}
uint cell_base(uint cascade) {
	return cascade * world.cell_capacity;
}
uint record_base(uint cascade) {
	return cascade * world.record_capacity;
}
uint cell_end(uint cascade) {
	return (cascade + 1u) * world.cell_capacity;
}
uint record_end(uint cascade) {
	return (cascade + 1u) * world.record_capacity;
}

// Brick index and bit of a cell given by wrapped storage coordinates.
uint brick_of_cell(uint cascade, uvec3 storage) {
	uint bricks = world.grid_size / WORLD_BRICK_CELLS;
	uvec3 brick = storage >> 2;
	return ((cascade * bricks + brick.z) * bricks + brick.y) * bricks + brick.x;
}
uint bit_of_cell(uvec3 storage) {
	uvec3 local = storage & 3u;
	return local.x + 4u * local.y + 16u * local.z;
}
uvec3 storage_from_world_cell(ivec3 cell) {
	return uvec3(cell & ivec3(int(world.grid_size) - 1));
}
// The world-fixed cell of a cascade's present window that lives at storage coordinates.
ivec3 world_cell_from_storage(uint cascade, uvec3 storage) {
	ivec3 origin = world.cascades[cascade].origin_cells;
	return origin + ((ivec3(storage) - origin) & ivec3(int(world.grid_size) - 1));
}
uint bits_below(uvec2 mask, uint bit) {
	return bit < 32u ? uint(bitCount(mask.x & ((1u << bit) - 1u))) : uint(bitCount(mask.x) + bitCount(mask.y & ((1u << (bit - 32u)) - 1u)));
}
bool bit_is_set(uvec2 mask, uint bit) {
	return ((bit < 32u ? mask.x >> bit : mask.y >> (bit - 32u)) & 1u) != 0u;
}

// The 4 x 4 columns along an axis that hold a set bit: bit s[axis + 1] + 4 s[axis + 2].
uint columns_of_bits(uvec2 bits, uint axis) {
	uint layers[4] = uint[](bits.x & 0xFFFFu, bits.x >> 16, bits.y & 0xFFFFu, bits.y >> 16);
	if (axis == 2u) {
		return layers[0] | layers[1] | layers[2] | layers[3];
	}
	uint mask = 0u;
	for (uint z = 0u; z < 4u; z++) {
		uint l = layers[z];
		if (axis == 1u) {
			uint x = (l | (l >> 4) | (l >> 8) | (l >> 12)) & 15u;
			mask |= ((x & 1u) | ((x & 2u) << 3) | ((x & 4u) << 6) | ((x & 8u) << 9)) << z;
		} else {
			uint y = (l | (l >> 1) | (l >> 2) | (l >> 3)) & 0x1111u;
			mask |= ((y & 1u) | ((y >> 3) & 2u) | ((y >> 6) & 4u) | ((y >> 9) & 8u)) << (4u * z);
		}
	}
	return mask;
}

uint face_from_normal(vec3 n) {
	vec3 a = abs(n);
	uint axis = a.x >= a.y && a.x >= a.z ? 0u : (a.y >= a.z ? 1u : 2u);
	return axis * 2u + (n[axis] < 0.0 ? 1u : 0u);
}

uint cell_first_record(uint packed_records) {
	return (packed_records & ~WORLD_CELL_FLAT) >> 6;
}

uint record_cascade(WorldRecord record) {
	return record.cell >> 27;
}
uint record_face(WorldRecord record) {
	return (record.cell >> 24) & 7u;
}
ivec3 record_world_cell(WorldRecord record) {
	uvec3 storage = uvec3(record.cell, record.cell >> 8, record.cell >> 16) & 255u;
	return world_cell_from_storage(record_cascade(record), storage);
}
vec3 record_position_in_cell(WorldRecord record) {
	return vec3(uvec3(record.position, record.position >> 9, record.position >> 18) & 511u) / 511.0;
}
vec3 record_position_m(WorldRecord record) {
	return (vec3(record_world_cell(record)) + record_position_in_cell(record)) * world.cascades[record_cascade(record)].cell_m;
}
float record_area_m2(WorldRecord record) {
	return uintBitsToFloat(record.area & ~255u);
}
// Surfaces on the border of two cells are stored in both; as light sources they count once.
float record_emitting_area_m2(WorldRecord record) {
	return record_area_m2(record) * float(record.area & 255u) / 255.0;
}
vec3 record_normal(WorldRecord record) {
	// Sign-extended by the shifts.
	ivec2 p = ivec2(int(record.normal << 19) >> 19, int(record.normal << 6) >> 19);
	return direction_from_octahedral(vec2(p) / 4095.0);
}
// The step in metres along a direction that certainly leaves a sub-voxel through a face of the direction's main axis.
float sub_voxel_along_m(uint cascade, vec3 direction) {
	vec3 rate = abs(direction) * float(WORLD_SUB_VOXELS) / world.cascades[cascade].cell_m;
	return 1.0 / max(rate.x, max(rate.y, rate.z));
}
// Faces in front of whose records the record's surface goes on, within a flat cell.
uint record_spill(WorldRecord record) {
	return record.normal >> 26;
}
bool record_has_start(WorldRecord record) {
	return (record.position >> 27) != 0u;
}
// The point in the free space in front of the record that its rays start from.
vec3 record_start_m(WorldRecord record) {
	vec3 n = record_normal(record);
	return record_position_m(record) + n * (float(record.position >> 27) * 0.25 * sub_voxel_along_m(record_cascade(record), n));
}

// The cell is at least `margin` cells inside the next finer cascade.
bool cell_in_finer(uint cascade, ivec3 cell, int margin) {
	if (cascade == 0u) {
		return false;
	}
	ivec3 low = (world.cascades[cascade - 1u].origin_cells >> 1) + margin;
	ivec3 high = ((world.cascades[cascade - 1u].origin_cells + int(world.grid_size)) >> 1) - margin;
	return all(greaterThanEqual(cell, low)) && all(lessThan(cell, high));
}

// The cell is so deep inside the next finer cascade that nothing reads it.
bool cell_in_hole(uint cascade, ivec3 cell) {
	return cell_in_finer(cascade, cell, world.hole_margin_cells);
}

#endif
