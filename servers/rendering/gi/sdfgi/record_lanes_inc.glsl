// SPDX-License-Identifier: MIT
// Work on surface records by eight lanes each, and the cache of what their gather rays have met.
#ifndef RECORD_LANES_INC
#define RECORD_LANES_INC
#include "servers/rendering/gi/sdfgi/sdfgi_io.h"
#include "servers/rendering/gi/world/fetch_counts_inc.glsl"
#include "servers/rendering/gi/world/surface_light_inc.glsl"
#include "servers/rendering/shaders/sampling_inc.glsl"

#define RECORD_LANES 8u

layout(local_size_x = 64) in;
layout(set = 0, binding = RECORD_RAYS_COUNTS, scalar) readonly buffer CountsBlock {
	CascadeCounts counts[];
};

uint records_of(uint cascade) {
	return min(counts[cascade].records, world.record_capacity);
}

bool record_is_active(WorldRecord record) {
	return record_has_start(record) && !cell_in_hole(record_cascade(record), record_world_cell(record));
}

uint record_seed(WorldRecord record) {
	ivec3 cell = record_world_cell(record);
	return hash_uint(uint(cell.x) * 73856093u ^ hash_uint(uint(cell.y) * 19349663u ^ hash_uint(uint(cell.z) * 83492791u ^ (record.cell >> 24))));
}

vec3 gather_direction(uint sample_index, uint seed, vec3 normal) {
	return cosine_direction(r2_point(sample_index, seed), normal);
}

// The cache holds a word a ray, by turn, record (those of all cascades, one after another) and lane.
struct RayCache {
	uint records; // in all cascades
	uint before; // of these, in earlier cascades
	uint turns; // that there is room for; with none, nothing is gathered from
};

RayCache ray_cache_of(uint cascade, uint capacity, uint turns) {
	RayCache cache;
	cache.records = 0u;
	cache.before = 0u;
	for (uint c = 0u; c < world.cascade_count; c++) {
		cache.before += c < cascade ? records_of(c) : 0u;
		cache.records += records_of(c);
	}
	cache.turns = min(capacity / max(cache.records * RECORD_LANES, 1u), turns);
	return cache;
}

uint ray_cache_place(RayCache cache, uint turn, uint record, uint lane) {
	return (turn * cache.records + cache.before + record) * RECORD_LANES + lane;
}

#endif
