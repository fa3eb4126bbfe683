// SPDX-License-Identifier: MIT
// The one interface by which surfaces and fog read GI: position, normal, view and roughness in, irradiance and radiance out.
// Near a voxelised surface the answer comes from the surface records of the cells around the point, elsewhere from the eight
// probes around it; both count only where no solid sub-voxel stands between.
#ifndef GI_SAMPLE_INC
#define GI_SAMPLE_INC
#extension GL_EXT_samplerless_texture_functions : require
#include "servers/rendering/gi/world/world_lookup_inc.glsl"
#include "servers/rendering/gi/sdfgi/probes_inc.glsl"

WorldCell cell_on_way(uint cascade, ivec3 cell);
#define WORLD_CELL_ON_WAY cell_on_way
#include "servers/rendering/gi/world/surface_light_inc.glsl"

layout(set = 0, binding = WORLD_BINDING(GI_PROBE_IRRADIANCE)) uniform texture2D gi_probe_irradiance;
layout(set = 0, binding = WORLD_BINDING(GI_PROBE_RADIANCE)) uniform texture2D gi_probe_radiance;
layout(set = 0, binding = WORLD_BINDING(GI_PROBE_OFFSETS), scalar) readonly buffer GiProbePlacesBlock {
	ProbePlace gi_probe_places[];
};
layout(set = 0, binding = WORLD_BINDING(GI_PROBE_SAMPLER)) uniform sampler gi_probe_sampler;

// A reflection is traced up to the first roughness, and no longer from the second on: there a texel of the probes' radiance is no wider
// than the lobe. From the third on it is read as irradiance.
#define GI_TRACED_ROUGHNESS 0.1
#define GI_UNTRACED_ROUGHNESS 0.25
#define GI_DIFFUSE_ROUGHNESS 0.8
// Roughness that the prepass writes for surfaces without a specular lobe: no radiance is looked up.
#define GI_NO_SPECULAR 1.5
// Thirds of a cell off a record's plane within which a point counts as on it.
#define PLAIN_OFF_PLANE 0.25
#define MIN_WEIGHT 0.002 // of a record, less counts as none

struct GiSample {
	vec3 irradiance; // / pi
	vec3 radiance;
	float weight; // 0 where GI doesn't reach
	float from_records; // share of it that surface records answered
	bool startless; // no free point was found before the surface
};

struct GiQuery {
	vec3 position_m;
	vec3 normal;
	vec3 view; // unit, to the eye
	float roughness;
	vec3 start_m; // the free point that visibility is tested from
	bool has_start;
};

// The 2 x 2 x 2 cells whose centres surround the point in question; ways between its surfaces hardly leave them.
struct CellFootprint {
	ivec3 base;
	vec3 f; // the point's place between the centres
	WorldCell cells[8]; // x + 2 y + 4 z; all bits 0: nothing stored
	bool is_plain; // surfaces of one face direction only, all flat: nothing stands between two points of one plane
};
CellFootprint footprint;
uint footprint_cascade = WORLD_MAX_CASCADES; // none yet

void find_footprint(vec3 position_m, uint cascade) {
	vec3 p = position_m / world.cascades[cascade].cell_m - 0.5;
	footprint_cascade = cascade;
	footprint.base = ivec3(floor(p));
	footprint.f = p - vec3(footprint.base);
	uint all_faces = 0u;
	bool all_flat = true;
	for (uint i = 0u; i < 8u; i++) {
		ivec3 cell = footprint.base + ivec3(int(i & 1u), int((i >> 1) & 1u), int(i >> 2));
		ivec3 local = cell - world.cascades[cascade].origin_cells;
		bool inside = all(greaterThanEqual(local, ivec3(0))) && all(lessThan(local, ivec3(int(world.grid_size))));
		footprint.cells[i] = inside ? load_cell(cascade, cell) : WorldCell(uvec2(0u), 0u, WORLD_NOT_LISTED);
		all_faces |= footprint.cells[i].records & 63u;
		all_flat = all_flat && ((footprint.cells[i].bits.x | footprint.cells[i].bits.y) == 0u || (footprint.cells[i].records & WORLD_CELL_FLAT) != 0u);
	}
	footprint.is_plain = all_flat && (all_faces & (all_faces - 1u)) == 0u;
}

WorldCell cell_on_way(uint cascade, ivec3 cell) {
	if (cascade != footprint_cascade) {
		return load_cell(cascade, cell);
	}
	ivec3 local = cell - footprint.base;
	if (all(greaterThanEqual(local, ivec3(0))) && all(lessThan(local, ivec3(2)))) {
		return footprint.cells[local.x + 2 * local.y + 4 * local.z];
	}
	return load_cell(cascade, cell);
}

// The least distance off a surface, in sub-voxels, that a pixel sees from: more than what its position is rounded by.
#define NEAR_START_SUB_VOXELS 0.1

// A point just off the surface, in a free sub-voxel. The way to the eye is free, so steps towards it stay on the surface's side; a step along
// the normal may cross another surface, unless the footprint has one plane only. With `ways`, where the cells know their surfaces, also
// between solid sub-voxels, nearer and nearer to the surface.
void find_query_start(inout GiQuery query, uint cascade, const bool ways) {
	find_footprint(query.position_m, cascade);
	float along_normal = sub_voxel_along_m(cascade, query.normal);
	float along_view = sub_voxel_along_m(cascade, query.view);
	vec3 near_m = query.position_m + query.normal * (NEAR_START_SUB_VOXELS * along_normal);
	bool is_listed = cell_is_listed(load_cell(cascade, ivec3(floor(near_m / world.cascades[cascade].cell_m))));
	bool checks = !footprint.is_plain && is_listed;
	query.has_start = false;
	uint tries = ways && is_listed ? 14u : 10u;
	for (uint i = 0u; i < tries && !query.has_start; i++) {
		// First off the surface, then from there towards the eye, then towards the eye alone, then less and less far off.
		float off = i < 8u ? probe_params.normal_bias : (i < 10u ? 0.0 : probe_params.normal_bias * exp2(-float(i - 10u)));
		float towards = i < 10u ? probe_params.probe_bias * (i < 8u ? 0.5 * float(i) : float(i - 7u)) : 0.0;
		query.start_m = query.position_m + query.normal * (off * along_normal) + query.view * (towards * along_view);
		bool is_free = i >= 10u || !sub_voxel_is_solid(cascade, query.start_m);
		query.has_start = is_free && (!checks || short_way_is_free(cascade, near_m, query.start_m));
	}
	if (ways && is_listed && !query.has_start) {
		query.start_m = near_m;
		query.has_start = true;
	}
}

// Records that may answer, by weight; at most this many, the first found.
#define MAX_CANDIDATES 12u

struct RecordCandidates {
	uint count;
	uint indices[MAX_CANDIDATES]; // with CANDIDATE_SEEN where no way need be walked
	float weights[MAX_CANDIDATES];
};
#define CANDIDATE_SEEN 0x80000000u

RecordCandidates find_candidates(GiQuery query, uint cascade) {
	RecordCandidates found;
	found.count = 0u;
	vec3 n = query.normal;
	uint end = record_end(cascade);
	float cell_along_normal = 4.0 * sub_voxel_along_m(cascade, n);
	for (uint i = 0u; i < 8u; i++) {
		uint packed_records = footprint.cells[i].records;
		vec3 axis_weight = mix(1.0 - footprint.f, footprint.f, vec3(float(i & 1u), float((i >> 1) & 1u), float(i >> 2)));
		// Along the normal the surface may lie anywhere in its cell: there the distance to its plane decides.
		axis_weight = mix(axis_weight, vec3(1.0), n * n);
		float cell_weight = axis_weight.x * axis_weight.y * axis_weight.z;
		if ((packed_records & 63u) == 0u || cell_weight < 0.01) {
			continue;
		}
		uint index = cell_first_record(packed_records);
		for (uint faces = packed_records & 63u; faces != 0u && index < end && found.count < MAX_CANDIDATES; faces &= faces - 1u, index++) {
			WorldRecord record = stored_record(index);
			float facing = dot(n, record_normal(record));
			if (facing < 0.5 || !record_has_start(record)) {
				continue;
			}
			float off_plane = dot(query.position_m - record_position_m(record), n) / cell_along_normal * 3.0;
			float weight = cell_weight * (facing - 0.45) * exp(-off_plane * off_plane);
			if (weight < MIN_WEIGHT) {
				continue;
			}
			bool seen = footprint.is_plain && abs(off_plane) <= PLAIN_OFF_PLANE;
			if (!seen && !query.has_start) {
				if (cell_is_split(packed_records & 63u)) {
					continue;
				}
				seen = true;
			}
			found.indices[found.count] = index | (seen ? CANDIDATE_SEEN : 0u);
			found.weights[found.count] = weight;
			found.count++;
		}
	}
	return found;
}

// Irradiance from the records of the 2 x 2 x 2 cells whose centres surround the point. w: how much of it answered. The ways are walked
// in a loop of their own, so that a GPU's lanes walk theirs at the same time.
vec4 sample_records(GiQuery query, uint cascade) {
	RecordCandidates found = find_candidates(query, cascade);
	vec3 sum = vec3(0.0);
	float weight_sum = 0.0;
	for (uint i = 0u; i < found.count; i++) {
		uint index = found.indices[i] & ~CANDIDATE_SEEN;
		bool seen = (found.indices[i] & CANDIDATE_SEEN) != 0u || short_way_is_free(cascade, query.start_m, record_start_m(stored_record(index)));
		if (seen) {
			sum += found.weights[i] * light_onto_record(index);
			weight_sum += found.weights[i];
		}
	}
	return weight_sum > 0.0 ? vec4(sum / weight_sum, clamp(weight_sum * 20.0, 0.0, 1.0)) : vec4(0.0);
}

vec2 probe_uv(uint index, vec3 direction, int texels, vec2 atlas_size) {
	vec2 within = (octahedral_from_direction(direction) * 0.5 + 0.5) * float(texels) + 1.0;
	return (vec2(probe_tile(index, texels + 2)) + within) / atlas_size;
}

struct ProbeSums {
	vec3 irradiance;
	vec3 radiance;
	float weight;
};

// The eight probes around the point: trilinear x facing, and x visibility unless the caller only wants the shape of the light.
ProbeSums sample_probes(GiQuery query, uint cascade, vec3 reflected, bool with_radiance, bool with_visibility) {
	float spacing = float(probe_params.spacing_cells);
	GiCascade c = world.cascades[cascade];
	vec3 p = query.start_m / (c.cell_m * spacing);
	ivec3 base = ivec3(floor(p));
	vec3 f = p - vec3(base);
	vec2 irradiance_size = vec2(textureSize(gi_probe_irradiance, 0));
	vec2 radiance_size = vec2(textureSize(gi_probe_radiance, 0));
	ProbeSums sums = ProbeSums(vec3(0.0), vec3(0.0), 0.0);
	for (uint i = 0u; i < 8u; i++) {
		ivec3 corner = ivec3(int(i & 1u), int((i >> 1) & 1u), int(i >> 2));
		ivec3 probe = base + corner;
		uint index = probe_index(cascade, probe);
		ProbePlace place = gi_probe_places[index];
		count_fetch(4u);
		if (!probe_is_free(place)) {
			continue;
		}
		vec3 to_probe = probe_position_m(cascade, probe, place) - query.start_m;
		float distance_m = max(length(to_probe), 1e-12);
		vec3 axis_weight = mix(1.0 - f, f, vec3(corner));
		float weight = max(axis_weight.x * axis_weight.y * axis_weight.z, 1e-3);
		float facing = dot(to_probe / distance_m, query.normal) * 0.5 + 0.5;
		weight *= facing * facing + 0.02;
		if (!with_visibility && weight < 0.01) {
			continue;
		}
		if (with_visibility && trace_world(query.start_m, to_probe / distance_m, distance_m, cascade).hit) {
			continue;
		}
		count_fetch(TEXEL_LOOKUP_BYTES);
		sums.irradiance += weight * textureLod(sampler2D(gi_probe_irradiance, gi_probe_sampler), probe_uv(index, query.normal, int(probe_params.irradiance_texels), irradiance_size), 0.0).rgb;
		if (with_radiance) {
			count_fetch(TEXEL_LOOKUP_BYTES);
			sums.radiance += weight * textureLod(sampler2D(gi_probe_radiance, gi_probe_sampler), probe_uv(index, reflected, int(probe_params.radiance_texels), radiance_size), 0.0).rgb;
		}
		sums.weight += weight;
	}
	return sums;
}

// 1 well inside the cascade, 0 at its edge, over one probe spacing.
float cascade_fade(uint cascade, vec3 position_m) {
	GiCascade c = world.cascades[cascade];
	vec3 p = position_m / c.cell_m - vec3(c.origin_cells);
	vec3 to_edge = min(p, vec3(float(world.grid_size)) - p);
	return clamp((min(to_edge.x, min(to_edge.y, to_edge.z)) - 1.0) / float(probe_params.spacing_cells), 0.0, 1.0);
}

// `rays`: probes are asked with visibility where records don't answer in full; without, false is returned there.
bool sample_cascades(vec3 position_m, vec3 normal, vec3 view, float roughness, const bool rays, out GiSample result) {
	result = GiSample(vec3(0.0), vec3(0.0), 0.0, 0.0, false);
	vec3 reflected = reflect(-view, normal);
	bool glossy = roughness < GI_DIFFUSE_ROUGHNESS;
	float left = 1.0;
	uint first = finest_cascade(position_m);
	GiQuery query = GiQuery(position_m, normal, view, roughness, position_m, false);
	for (uint cascade = first; cascade < min(first + 2u, world.cascade_count) && left > 0.0; cascade++) {
		float share = left * cascade_fade(cascade, position_m);
		if (share <= 0.0) {
			continue;
		}
		find_query_start(query, cascade, rays);
		if (!query.has_start && !rays) {
			return false;
		}
		vec4 records = sample_records(query, cascade);
		vec3 irradiance = records.rgb;
		vec3 radiance = records.rgb;
		if (records.w < 1.0 && !rays) {
			return false;
		}
		if (records.w < 1.0 || glossy) {
			// Where records answer, probes only give the light's shape: their mirror direction against their own irradiance, so that
			// probes behind a wall change little and no ray to them is needed.
			bool with_visibility = rays && probe_params.use_occlusion != 0u && records.w < 1.0;
			ProbeSums probes = sample_probes(query, cascade, reflected, glossy, with_visibility);
			if (probes.weight > 0.0) {
				vec3 probe_irradiance = probes.irradiance / probes.weight;
				irradiance = mix(probe_irradiance, records.rgb, records.w);
				vec3 scale = min(irradiance / max(probe_irradiance, vec3(1e-5)), vec3(4.0));
				radiance = mix(probes.radiance / probes.weight * scale, irradiance, smoothstep(0.5, GI_DIFFUSE_ROUGHNESS, roughness));
			}
		}
		result.irradiance += share * irradiance;
		result.radiance += share * radiance;
		result.weight += share;
		result.from_records += share * records.w;
		result.startless = result.startless || !query.has_start;
		left -= share;
	}
	result.irradiance *= probe_params.energy;
	result.radiance *= probe_params.energy;
	return true;
}

GiSample gi_sample(vec3 position_m, vec3 normal, vec3 view, float roughness) {
	GiSample result;
	sample_cascades(position_m, normal, view, roughness, true, result);
	return result;
}

// False: rays are needed, and `result` is none.
bool gi_sample_without_rays(vec3 position_m, vec3 normal, vec3 view, float roughness, out GiSample result) {
	return sample_cascades(position_m, normal, view, roughness, false, result);
}

#endif
