// SPDX-License-Identifier: MIT
// The lit world that every GI technique shares: nested grids ("cascades") of cells around the camera. Shared by C++ and GLSL.
//
// Addressing. Cascade c has grid_size cells an axis; a cell is named by its world-fixed integer coordinates
// floor(position / cell_size). Storage is wrapped: cell w lives at w & (grid_size - 1), so a cascade that moves keeps what stays.
// Cells are grouped in bricks of 4 x 4 x 4; arrays are in brick order, so that a brick's 64 cells are neighbours in memory.
//
// Only cells that a triangle touches have storage of their own: their index is the brick's cell base + the count of set occupancy
// bits below. Such a cell keeps 4 x 4 x 4 solid bits ("sub-voxels"), and one record for each of the six axis directions that
// some of its surface mostly faces: record index = base + count of set face bits below.
#ifndef WORLD_IO_H
#define WORLD_IO_H
#include "servers/rendering/device/shader_interop.h"

#define WORLD_MAX_CASCADES 8
#define WORLD_BRICK_CELLS 4 // an axis
#define WORLD_SUB_VOXELS 4 // an axis of a cell

// Bindings of the world, wherever it is read (world_inc.glsl, trace_world_inc.glsl).
#define WORLD_PARAMS 0 // uniform GiWorldParams
#define WORLD_OCCUPANCY 1 // uvec2 a brick: bit x + 4 y + 16 z is set where the cell has storage
#define WORLD_BRICK_CELL_BASE 2 // uint a brick: index of its first stored cell
#define WORLD_CELLS 3 // WorldCell a stored cell
#define WORLD_SDF 4 // a byte a cell: distance to the nearest stored cell's centre, in sixteenths of a cell, rounded down, 255: that or more
#define WORLD_RECORDS 5 // WorldRecord
#define WORLD_RECORD_LIGHT 6 // uvec4 a record, 2 x half x 4: radiance that it reflects of all light; irradiance / pi of all light but lamps'
#define WORLD_SKY 7 // texture2D, octahedral
#define WORLD_SKY_SAMPLER 8
#define WORLD_CELL_TRIANGLES 28 // uint: a triangle of a listed cell: its number in WORLD_TRIANGLES, above it the octants of the cell that it touches
#define WORLD_TRIANGLES 29 // vec4, four a triangle: plane (unit normal of the front, distance from the origin), then corners, all in metres; w of the first corner: WORLD_TRIANGLE_* as bits
#define WORLD_FETCH_COUNTS 35 // FetchCounts a pass (fetch_counts_inc.glsl)

#define COUNT_FETCHES_ID 0 // specialisation constant

// A cell is flat when no surface in it is further than this from its record's plane.
#define WORLD_FLAT_SUB_VOXELS 0.04
#define WORLD_CELL_FLAT 0x80000000u

// A cell that at most this many triangles touch lists them: rays meet the triangles themselves there, not the solid bits.
#define WORLD_LISTED_TRIANGLES 62u
#define WORLD_NOT_LISTED 0xFFFFFFFFu
// Instead of a count: one plane covers the cell from side to side.
#define WORLD_PLAIN 255u
#define WORLD_LIST_COUNT_BITS 8
#define WORLD_LIST_COUNT_MASK 255u
// No surface of a plain cell is further off its plane than this, in cells; as much as triangles are grown by.
#define WORLD_PLAIN_CELLS WORLD_TRIANGLE_GROWTH_CELLS
// Triangles are this much larger for rays, in cells: what is cracked by less is closed. As much as coverage is grown, so that lists are complete.
#define WORLD_TRIANGLE_GROWTH_CELLS (WORLD_TOUCH_SUB_VOXELS / float(WORLD_SUB_VOXELS))
#define WORLD_TRIANGLE_BYTES 64
#define WORLD_TRIANGLE_NUMBER_BITS 24
#define WORLD_TRIANGLE_NUMBER_MASK ((1u << WORLD_TRIANGLE_NUMBER_BITS) - 1u)
// The lowest bits: the face that the front mostly looks at.
#define WORLD_TRIANGLE_FACE 7u
#define WORLD_TRIANGLE_DOUBLE_SIDED 8u
#define WORLD_TRIANGLE_ALPHA_TESTED 16u // only where a solid bit is set
#define WORLD_TRIANGLE_EMISSIVE 32u

// Where a draw that samples GI finds these bindings and the probes': this much higher (transparent_inc.glsl).
#define GI_SAMPLE_BINDING_BASE 32

#define WORLD_COLUMN_STRETCH 64u

#define WORLD_SDF_SCALE 16.0
#define WORLD_SDF_RADIUS_CELLS 15
#define NEAR_BRICKS_A_ROW 32768u // devices need not take more than 65535 work groups a dimension
#define WORLD_SDF_FAR_SQUARED 4096u // cells^2: more than (WORLD_SDF_RADIUS_CELLS + 1)^2
#define WORLD_SDF_RADIUS_BRICKS 4 // a cell further than this many bricks from any stored cell is further than the radius

// Fixed-point scales of the accumulators: areas are in cells^2, so one record can take 4096 cell faces.
#define WORLD_FIXED_AREA 1048576.0
#define WORLD_FIXED_EMISSION 4096.0
// Everything that a triangle touches within this many sub-voxels counts: surfaces that lie exactly between two cells belong to both.
#define WORLD_TOUCH_SUB_VOXELS 0.00390625

INTEROP_BEGIN
// Of one pass in a frame, 64 bits each.
struct FetchCounts {
	uint fetches;
	uint fetches_high;
	uint bytes;
	uint bytes_high;
};
struct GiCascade {
	ivec3 origin_cells; // world-fixed coordinates of the lowest cell
	vec3 cell_m; // size of a cell; y is smaller by the y scale
};
struct GiWorldParams {
	GiCascade cascades[WORLD_MAX_CASCADES];
	uint cascade_count;
	uint grid_size; // cells an axis, a power of two, at most 256
	uint cell_capacity; // a cascade
	uint record_capacity; // a cascade
	uint triangle_capacity; // a cascade, in lists of cells
	float sky_scale; // 0: rays that leave the world see nothing
	int hole_margin_cells; // cells of a coarser cascade deeper than this inside the finer one are never lit nor read
};
struct WorldCell {
	uvec2 bits; // sub-voxel x + 4 y + 16 z
	uint records; // flat << 31 | index of the first record << 6 | face mask; faces: +x -x +y -y +z -z
	uint triangles; // index of the first in the cascade's part of WORLD_CELL_TRIANGLES << 8 | count; number in WORLD_TRIANGLES of one whose plane covers the cell << 8 | WORLD_PLAIN; WORLD_NOT_LISTED: more than fit, the bits decide
};
struct WorldRecord {
	uint position; // centroid in the cell: 9 bits an axis; then 5 bits: offset of the start point along the normal in quarter sub-voxels, 0: no free point
	uint normal; // octahedral, 13 bits each; then a bit a face: in a flat cell, the record's surface goes on in front of that face's record
	uint albedo; // 11:11:10 unorm
	uint emission; // RGB9E5, mean over the surface
	uint cell; // cascade << 27 | face << 24 | storage coordinates z << 16 | y << 8 | x
	uint area; // m^2 of the surface, seen along its normal: a float but for its last 8 bits, which are the share of its emission that no other cell has too
};
// Per-record sums while a cascade is voxelised. Integers, so that the order of triangles doesn't matter.
struct RecordAccumulator {
	uint area;
	uvec3 albedo;
	uvec3 emission;
	ivec3 normal;
	uvec3 position;
	uint own_emission; // sum of the channels' mean, of what no other cell counts
};
// A cascade's counts, written by the allocation passes. Wanted, so they may exceed the capacity.
struct CascadeCounts {
	uint cells;
	uint records;
	uint triangles; // in lists of cells
	uint plain_cells;
	uint unlisted_cells; // that have records but no room for a list
	uvec3 light_groups; // indirect arguments: a work group for eight records
};
struct VoxelizeConstants {
	uint cascade;
	uint surface_count;
	uint triangle_count;
	uint stored_triangles; // in WORLD_TRIANGLES; those beyond have no place there
};
struct BuildSdfConstants {
	uint cascade;
	uint axis;
};
// The bricks that build_sdf works on: this, then a brick of the window each (x | y << 10 | z << 20).
struct NearBrickHeader {
	uvec3 groups; // indirect arguments: NEAR_BRICKS_A_ROW along x, as many rows along y as it takes
	uint count;
};
struct ClearWordsConstants {
	uint first;
	uint count;
	uint value;
};
// Columns of a large triangle's cells from one on, WORLD_COLUMN_STRETCH of them at most.
struct ColumnStretch {
	uint triangle;
	uint first_column;
};
// An emissive record in the list for next-event estimation.
struct Emitter {
	uint record;
	float cdf; // running share of the power, this one included; 1 at the end
	float share; // of the total power
};
INTEROP_END
INTEROP_SIZE(GiCascade, 24)
INTEROP_SIZE(GiWorldParams, 220)
INTEROP_SIZE(NearBrickHeader, 16)
INTEROP_SIZE(WorldCell, 16)
INTEROP_SIZE(WorldRecord, 24)
INTEROP_SIZE(RecordAccumulator, 56)
#endif
