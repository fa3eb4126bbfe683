// SPDX-License-Identifier: MIT
// Rays to emissive records, for trace_records, which declares `emitters`, `emitter_count` and `constants`.
#ifndef EMITTER_SAMPLE_INC
#define EMITTER_SAMPLE_INC
#include "servers/rendering/gi/sdfgi/record_rays_inc.glsl"

#define NEAR_EMITTERS_CELLS 2.0

// A point on an emitter: a column of its face with surface in it.
vec3 emitter_point_m(WorldRecord record, vec2 u) {
	uint axis = record_face(record) >> 1;
	uint a = (axis + 1u) % 3u;
	uint b = (axis + 2u) % 3u;
	vec3 cell_m = world.cascades[record_cascade(record)].cell_m;
	vec3 center = record_position_in_cell(record);
	uint index = find_cell(record_cascade(record), storage_from_world_cell(record_world_cell(record)));
	uvec2 bits = index < WORLD_LOST_CELL ? stored_cell(index).bits : uvec2(0u);
	uint mask = columns_of_bits(bits, axis);
	uint count = uint(bitCount(mask));
	if (count == 0u) {
		return record_position_m(record);
	}
	float scaled = u.x * float(count);
	uint pick = min(uint(scaled), count - 1u);
	for (uint i = 0u; i < 16u && pick > 0u; i++, pick--) {
		mask &= mask - 1u;
	}
	uint column = uint(findLSB(mask));
	vec2 within = (vec2(float(column & 3u), float(column >> 2)) + vec2(fract(scaled), u.y)) / 4.0;
	vec3 normal = record_normal(record);
	vec3 offset = vec3(0.0);
	offset[a] = (within.x - center[a]) * cell_m[a];
	offset[b] = (within.y - center[b]) * cell_m[b];
	offset[axis] = clamp(-(offset[a] * normal[a] + offset[b] * normal[b]) / normal[axis], -cell_m[axis], cell_m[axis]);
	return record_position_m(record) + offset;
}

uint find_emitter(float u) {
	uint low = 0u;
	uint high = emitter_count - 1u;
	for (uint i = 0u; i < 24u && low < high; i++) {
		uint middle = (low + high) / 2u;
		count_fetch(4u);
		if (emitters[middle].cdf > u) {
			high = middle;
		} else {
			low = middle + 1u;
		}
	}
	return low;
}

// Emission nearer than this comes from gather rays, emission further away from rays to emitters.
float near_emitters_m() {
	return NEAR_EMITTERS_CELLS * world.cascades[constants.cascade].cell_m.x;
}

struct EmitterSample {
	LightRay ray;
	uint record;
	float weight; // luminance of ray.light: what resampling goes by
};

EmitterSample sample_emitter(vec3 from_m, vec3 normal, float pick, vec2 u) {
	Emitter emitter = emitters[find_emitter(pick)];
	count_fetch(12u);
	WorldRecord record = stored_record(emitter.record);
	EmitterSample result;
	result.record = emitter.record;
	vec3 way = emitter_point_m(record, u) - from_m;
	float distance_squared = max(dot(way, way), 1e-24);
	float distance_m = sqrt(distance_squared);
	result.ray.direction = way / distance_m;
	result.ray.t_max_m = distance_m;
	float cosines = max(dot(normal, result.ray.direction), 0.0) * max(-dot(record_normal(record), result.ray.direction), 0.0);
	// Emitters nearer than this are left to the gather rays: there a record is no point of light.
	float form = distance_m < near_emitters_m() ? 0.0 : cosines * record_emitting_area_m2(record) / (PI * distance_squared);
	result.ray.light = color_from_rgb9e5(record.emission) * form / max(emitter.share, 1e-9);
	result.weight = dot(result.ray.light, vec3(1.0));
	return result;
}

// Two candidates by power, one kept by what it would give (resampled importance sampling, Talbot et al. 2005).
EmitterSample resample_emitter(vec3 from_m, vec3 normal, uint index, uint seed) {
	EmitterSample kept;
	kept.weight = 0.0;
	kept.record = 0u;
	kept.ray.light = vec3(0.0);
	kept.ray.direction = normal;
	kept.ray.t_max_m = 0.0;
	float sum = 0.0;
	if (emitter_count == 0u) {
		return kept;
	}
	const uint CANDIDATES = 2u;
	for (uint i = 0u; i < CANDIDATES; i++) {
		float pick = r2_point(index * CANDIDATES + i, seed).x;
		EmitterSample candidate = sample_emitter(from_m, normal, pick, r2_point(index, hash_uint(seed + 11u + i)));
		sum += candidate.weight;
		if (candidate.weight > 0.0 && unit_float(hash_uint(seed ^ (index * 8u + i) * 0x9E3779B9u)) * sum < candidate.weight) {
			kept = candidate;
		}
	}
	kept.ray.light *= kept.weight > 0.0 ? sum / (float(CANDIDATES) * kept.weight) : 0.0;
	return kept;
}

// The ray has met the emitter's own cell, or emission of the same face at most a cell before the emitter's plane: solid bits stand before
// the surface, and a record's plane is the mean of what its cell holds, so that a flat ray meets neighbours before the point it is meant for.
bool hit_is_emitter(WorldHit hit, uint target, LightRay ray) {
	WorldRecord emitter = stored_record(target);
	bool shows_face = hit.face == record_face(emitter);
	if (hit.cascade == record_cascade(emitter) && hit.world_cell == record_world_cell(emitter)) {
		// Points on an emitter are drawn from the cell's columns, beyond its edge too: there another surface of the cell is met. The emitter is
		// seen if its start is.
		return shows_face || (hit.face != HIT_BACK && short_way_is_free(hit.cascade, free_point_before(hit, ray.direction), record_start_m(emitter)));
	}
	if (hit.face != HIT_BITS && !shows_face) {
		return false;
	}
	vec3 normal = record_normal(emitter);
	float before_plane_m = (ray.t_max_m - hit.t_m) * -dot(normal, ray.direction);
	if (hit.cell >= WORLD_LOST_CELL || before_plane_m > (hit.face == HIT_BITS ? float(WORLD_SUB_VOXELS) : 0.5) * sub_voxel_along_m(hit.cascade, normal)) {
		return false;
	}
	uint packed_records = stored_cell(hit.cell).records;
	uint faces = packed_records & 63u;
	uint face = record_face(emitter);
	uint index = cell_first_record(packed_records) + uint(bitCount(faces & ((1u << face) - 1u)));
	if ((faces & (1u << face)) == 0u || index >= record_end(hit.cascade)) {
		return false;
	}
	WorldRecord neighbour = stored_record(index);
	if (neighbour.emission == 0u || !record_has_start(neighbour)) {
		return false;
	}
	return !cell_is_split(faces) || short_way_is_free(hit.cascade, free_point_before(hit, ray.direction), record_start_m(neighbour));
}

#endif
