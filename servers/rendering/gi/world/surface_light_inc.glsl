// SPDX-License-Identifier: MIT
// The light that leaves a hit of trace_world.
#ifndef SURFACE_LIGHT_INC
#define SURFACE_LIGHT_INC
#include "servers/rendering/gi/world/trace_world_inc.glsl"
#include "servers/rendering/shaders/sampling_inc.glsl"

layout(set = 0, binding = WORLD_BINDING(WORLD_RECORD_LIGHT), scalar) readonly buffer WorldRecordLightBlock {
	uvec4 world_record_light[]; // xy: reflected, zw: falls on it, but for lamps'
};
vec3 light_from_record(uint index) {
	count_fetch(8u);
	return vec4_from_half4(world_record_light[index].xy).rgb;
}
vec3 light_onto_record(uint index) {
	count_fetch(8u);
	return vec4_from_half4(world_record_light[index].zw).rgb;
}
layout(set = 0, binding = WORLD_BINDING(WORLD_SKY)) uniform texture2D world_sky;
layout(set = 0, binding = WORLD_BINDING(WORLD_SKY_SAMPLER)) uniform sampler world_sky_sampler;

// How short ways look cells up; a shader that has some at hand defines its own.
#ifndef WORLD_CELL_ON_WAY
#define WORLD_CELL_ON_WAY load_cell
#endif
#define SHORT_WAY_MAX_CELLS 10u // three cells along each axis, and the first
#define TEXEL_LOOKUP_BYTES 32u // bilinear, of RGBA16F
// What a ray met, instead of a record's index.
#define RAY_MET_NOTHING 0xFFFFFFFFu
#define RAY_MET_SKY 0xFFFFFFFEu

// Nothing solid between two points of one cascade at most three cells apart: every cell on the way is looked up. As for rays, the
// solid sub-voxels of a listed or flat cell only count where the way crosses a surface.
bool short_way_is_free(uint cascade, vec3 from_m, vec3 to_m) {
	vec3 cell_m = world.cascades[cascade].cell_m;
	vec3 a = from_m / cell_m;
	vec3 way = to_m / cell_m - a;
	way = mix(way, vec3(1e-6), lessThan(abs(way), vec3(1e-6)));
	vec3 inverse = 1.0 / way;
	ivec3 direction_sign = ivec3(sign(way));
	GridWalk walk;
	walk.at = ivec3(floor(a));
	walk.t_next = (vec3(walk.at) + step(vec3(0.0), way) - a) * inverse;
	float t = 0.0;
	for (uint i = 0u; i < SHORT_WAY_MAX_CELLS; i++) {
		// Beyond the cascade its storage holds cells of the other side.
		if (is_outside(walk.at - world.cascades[cascade].origin_cells, int(world.grid_size))) {
			return false;
		}
		WorldCell cell = WORLD_CELL_ON_WAY(cascade, walk.at);
		float t_leave = min(walk_leaves(walk), 1.0);
		if (cell_is_plain(cell)) {
			vec3 way_m = to_m - from_m;
			float along;
			uint flags;
			if (meet_plane(cell, from_m, way_m, vec2(t, t_leave), triangle_growth_m(cascade) / max(length(way_m), 1e-6), along, flags) >= 0.0) {
				return false;
			}
		} else if ((cell.bits.x | cell.bits.y) != 0u) {
			vec3 entry = (a + way * t - vec3(walk.at)) * float(WORLD_SUB_VOXELS);
			uint octants;
			float met = trace_sub_voxels(cascade, cell, entry, way * float(WORLD_SUB_VOXELS), inverse / float(WORLD_SUB_VOXELS), 1.0 - t, octants);
			if (met >= 0.0 && (!cell_is_listed(cell) || crosses_triangles(cascade, cell, octants, walk.at, from_m, to_m))) {
				return false;
			}
		}
		t = t_leave;
		if (t >= 1.0) {
			return true;
		}
		walk_on(walk, inverse, direction_sign);
	}
	return false;
}

// Two surfaces of the cell face opposite ways: a wall thinner than the cell, whose other records may lie on either side.
bool cell_is_split(uint faces) {
	return (faces & (faces >> 1) & 21u) != 0u;
}

vec3 world_sky_radiance(vec3 direction) {
	vec2 uv = octahedral_from_direction(direction) * 0.5 + 0.5;
	count_fetch(TEXEL_LOOKUP_BYTES);
	return textureLod(sampler2D(world_sky, world_sky_sampler), uv, 0.0).rgb * world.sky_scale;
}

// The last free point of the ray before a hit, at most back to the ray's start: just before a triangle; elsewhere outside of the solid
// sub-voxels that hits in flat cells may lie under.
vec3 free_point_before(WorldHit hit, vec3 direction) {
	float step_m = 0.5 * sub_voxel_along_m(hit.cascade, direction);
	if (hit.face != HIT_BITS) {
		return hit.position_m - min(0.1 * step_m, hit.t_m) * direction;
	}
	float back_m = min(0.5 * step_m, hit.t_m);
	for (uint i = 0u; i < 12u && back_m < hit.t_m && sub_voxel_is_solid(hit.cascade, hit.position_m - back_m * direction); i++) {
		back_m = min(back_m + step_m, hit.t_m);
	}
	return hit.position_m - back_m * direction;
}

// Emission that rays see of a record. They see whole sub-voxels of cells that are neither listed nor flat: there it is spread over what they see, so that
// the flux stays.
vec3 visible_emission(WorldRecord record, WorldCell cell) {
	vec3 emission = color_from_rgb9e5(record.emission);
	if (record.emission == 0u || (cell.records & WORLD_CELL_FLAT) != 0u || cell_is_listed(cell)) {
		return emission;
	}
	uint axis = record_face(record) >> 1;
	vec3 size = world.cascades[record_cascade(record)].cell_m;
	float column_m2 = size[(axis + 1u) % 3u] * size[(axis + 2u) % 3u] / 16.0;
	float seen_m2 = column_m2 * float(max(bitCount(columns_of_bits(cell.bits, axis)), 1));
	return emission * (record_area_m2(record) * abs(record_normal(record)[axis]) / seen_m2);
}

// Records that may answer for a hit: those of its cell that show the ray the face that it met (where only bits were met: that face it),
// and that a free way leads to from the ray's last free point, asked when the cell holds several: some may lie on the other side of a
// thin wall, or inside of solids that touch. Where there is none, those of the cells around it, always by a free way.
struct HitQuery {
	WorldHit hit;
	vec3 direction;
	vec3 free_m;
	bool asks_ways;
	float least_facing;
	bool any_face; // not only the one that was met, but emitters for emitters and others for others
	bool is_emitter;
};

// How much a record has to do with a hit; 0: nothing.
float record_weight(HitQuery query, WorldRecord record) {
	vec3 normal = record_normal(record);
	float facing = -dot(normal, query.direction);
	bool shown = query.hit.face == HIT_BITS || query.any_face ? facing > query.least_facing : query.hit.face == record_face(record);
	if (!shown || !record_has_start(record) || (query.any_face && (record.emission != 0u) != query.is_emitter)) {
		return 0.0;
	}
	if (query.asks_ways && !short_way_is_free(query.hit.cascade, query.free_m, record_start_m(record))) {
		return 0.0;
	}
	float off_plane = abs(dot(query.hit.position_m - record_position_m(record), normal)) / sub_voxel_along_m(query.hit.cascade, normal);
	return max(facing - query.least_facing, 0.05) / (0.25 + off_plane * off_plane);
}

bool has_several(uint faces) {
	return (faces & (faces - 1u)) != 0u;
}

// Where neighbours are looked for from: off the met surface, as far as a free way leads, since more can be seen from there.
vec3 lifted_point(HitQuery query) {
	vec3 normal = -query.direction;
	if (query.hit.face != HIT_BITS) {
		normal = vec3(0.0);
		normal[query.hit.face >> 1] = (query.hit.face & 1u) == 0u ? 1.0 : -1.0;
	}
	vec3 lifted_m = query.free_m + normal * (1.5 * sub_voxel_along_m(query.hit.cascade, normal));
	return short_way_is_free(query.hit.cascade, query.free_m, lifted_m) ? lifted_m : query.free_m;
}

// From where the cells around a hit are asked, in turn while none answers: off the met surface, then further and further back on the ray, which
// came all that way: what stands between the hit and a record hides less and less. At last what faces the ray answers for the face that was met: a
// cell has one record of a face, where a folded cloth has two sides.
#define NEIGHBOUR_VIEWS 5u
HitQuery neighbour_query(HitQuery query, uint view) {
	query.asks_ways = true;
	query.any_face = view >= 3u;
	query.least_facing = query.any_face ? 0.0 : -0.5;
	if (view == 0u || view == 3u) {
		query.free_m = lifted_point(query);
	} else {
		float back_m = 2.0 * float(query.any_face ? view - 3u : view) * sub_voxel_along_m(query.hit.cascade, query.direction);
		query.free_m = query.hit.position_m - min(back_m, 0.999 * query.hit.t_m) * query.direction;
	}
	return query;
}

// Those of a cell's faces whose records may answer.
uint answering_faces(HitQuery query, uint packed_records) {
	uint faces = packed_records & 63u;
	return query.hit.face == HIT_BITS || query.any_face ? faces : faces & (1u << query.hit.face);
}

uint record_of_face(uint packed_records, uint face) {
	return cell_first_record(packed_records) + uint(bitCount(packed_records & ((1u << face) - 1u)));
}

HitQuery first_query(WorldHit hit, vec3 direction, uint packed_records) {
	uint faces = packed_records & 63u;
	bool is_emitter = hit.face != HIT_BITS && (faces & (1u << hit.face)) != 0u && stored_record(record_of_face(packed_records, hit.face)).emission != 0u;
	return HitQuery(hit, direction, free_point_before(hit, direction), has_several(faces), 0.0, false, is_emitter);
}

// Of 3 x 3 x 3 cells.
ivec3 neighbour_offset(uint i) {
	return ivec3(int(i % 3u), int((i / 3u) % 3u), int(i / 9u)) - 1;
}

// What answers of a cell: one record, drawn by weight; `picked` where there is none.
uint pick_in_cell(HitQuery query, uint packed_records, uint seed, inout float weight_sum, uint picked) {
	uint end = record_end(query.hit.cascade);
	uint faces = answering_faces(query, packed_records);
	for (uint left = faces; left != 0u; left &= left - 1u) {
		uint index = record_of_face(packed_records, uint(findLSB(left)));
		float weight = index < end ? record_weight(query, stored_record(index)) : 0.0;
		weight_sum += weight;
		if (weight > 0.0 && unit_float(hash_uint(seed + index)) * weight_sum < weight) {
			picked = index;
		}
	}
	return picked;
}

// One record that answers for a hit, RAY_MET_NOTHING: none: the back of a one-sided surface, a cell without memory, or no free way.
uint pick_record(WorldHit hit, vec3 direction, uint seed) {
	uint picked = RAY_MET_NOTHING;
	if (hit.cell >= WORLD_LOST_CELL || hit.face == HIT_BACK) {
		return picked;
	}
	uint packed_records = stored_cell(hit.cell).records;
	HitQuery query = first_query(hit, direction, packed_records);
	float weight_sum = 0.0;
	picked = pick_in_cell(query, packed_records, seed, weight_sum, picked);
	if (picked != RAY_MET_NOTHING) {
		return picked;
	}
	for (uint k = 0u; k < NEIGHBOUR_VIEWS && picked == RAY_MET_NOTHING; k++) {
		HitQuery view = neighbour_query(query, k);
		for (uint i = 0u; i < 27u; i++) {
			picked = pick_in_cell(view, load_cell(hit.cascade, hit.world_cell + neighbour_offset(i)).records, seed, weight_sum, picked);
		}
	}
	return picked;
}

// Light that leaves a cell's records that answer, by weight, and the sum of the weights.
vec4 light_of_cell(HitQuery query, WorldCell cell) {
	vec4 sum = vec4(0.0);
	uint end = record_end(query.hit.cascade);
	for (uint left = answering_faces(query, cell.records); left != 0u; left &= left - 1u) {
		uint index = record_of_face(cell.records, uint(findLSB(left)));
		if (index >= end) {
			continue;
		}
		WorldRecord record = stored_record(index);
		float weight = record_weight(query, record);
		if (weight > 0.0) {
			sum += weight * vec4(light_from_record(index) + visible_emission(record, cell), 1.0);
		}
	}
	return sum;
}

// Radiance that leaves the hit against `direction`: the mean of the records that answer; black where none does.
vec3 hit_radiance(WorldHit hit, vec3 direction) {
	if (hit.cell >= WORLD_LOST_CELL || hit.face == HIT_BACK) {
		return vec3(0.0);
	}
	WorldCell cell = stored_cell(hit.cell);
	HitQuery query = first_query(hit, direction, cell.records);
	vec4 sum = light_of_cell(query, cell);
	if (sum.w > 0.0) {
		return sum.rgb / sum.w;
	}
	for (uint k = 0u; k < NEIGHBOUR_VIEWS && sum.w <= 0.0; k++) {
		HitQuery view = neighbour_query(query, k);
		for (uint i = 0u; i < 27u; i++) {
			sum += light_of_cell(view, load_cell(hit.cascade, hit.world_cell + neighbour_offset(i)));
		}
	}
	return sum.w > 0.0 ? sum.rgb / sum.w : vec3(0.0);
}

#endif
