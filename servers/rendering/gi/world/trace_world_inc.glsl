// SPDX-License-Identifier: MIT
// Rays through the world: sphere steps by the distance field through empty cells, exact stepping through stored cells and
// their sub-voxels. Every point of a ray is looked up in the finest cascade that holds it.
//
// Solid bits reach up to a sub-voxel beyond the surface. They only say where a surface may be: in a cell that lists its triangles (nearly
// all) a ray that comes through a solid sub-voxel meets the triangles themselves, in one that a plane covers from side to side the plane. In other flat cells it stops where it crosses the
// plane of one of the cell's records, or is behind all of them. Only cells of many triangles that aren't flat are as large as their bits.
//
// No leak: triangles set every sub-voxel that they touch, so any path through face-neighbouring sub-voxels that crosses a
// surface meets a set bit; the stepping below visits face neighbours only, and sphere steps stay within certified empty space. A cell's
// list holds every triangle that comes within WORLD_TRIANGLE_GROWTH_CELLS of it, and rays meet triangles that are grown by as much, so that
// neither rounding nor a crack in a model lets a ray pass between two of them.
#ifndef TRACE_WORLD_INC
#define TRACE_WORLD_INC
#include "servers/rendering/gi/world/meet_triangles_inc.glsl"

layout(set = 0, binding = WORLD_BINDING(WORLD_RECORDS), scalar) readonly buffer WorldRecordsBlock {
	WorldRecord world_records[];
};
WorldRecord stored_record(uint index) {
	count_fetch(24u);
	return world_records[index];
}

#define TRACE_MAX_STEPS 768

struct WorldHit {
	bool hit;
	uint cascade;
	uint cell; // index, or WORLD_LOST_CELL
	ivec3 world_cell;
	float t_m;
	vec3 position_m; // on a listed triangle; elsewhere where the ray enters the solid sub-voxel
	uint face; // that a met triangle shows the ray, or HIT_*
};

bool cascade_holds(uint cascade, vec3 position_m) {
	GiCascade c = world.cascades[cascade];
	vec3 p = position_m / c.cell_m - vec3(c.origin_cells);
	return all(greaterThanEqual(p, vec3(0.0))) && all(lessThan(p, vec3(float(world.grid_size))));
}

uint finest_cascade(vec3 position_m) {
	for (uint i = 0u; i < world.cascade_count; i++) {
		if (cascade_holds(i, position_m)) {
			return i;
		}
	}
	return world.cascade_count;
}

// Is a point (cell-local, in cells) beyond the edge at which a record's surface ends: in front of another record's plane, where the
// surface does not go on?
bool is_beyond_edge(uint cascade, uint packed_records, WorldRecord record, vec3 point, float tolerance_m) {
	uint faces = packed_records & 63u;
	uint others = faces & ~(1u << record_face(record)) & ~record_spill(record);
	for (; others != 0u; others &= others - 1u) {
		uint face = uint(findLSB(others));
		WorldRecord other = stored_record(cell_first_record(packed_records) + uint(bitCount(faces & ((1u << face) - 1u))));
		if (dot((point - record_position_in_cell(other)) * world.cascades[cascade].cell_m, record_normal(other)) > tolerance_m) {
			return true;
		}
	}
	return false;
}

// Does the stretch from `a` to `b` (cell-local, in cells) cross a surface of a flat cell?
bool crosses_surface(uint cascade, uint packed_records, vec3 a, vec3 b) {
	vec3 cell_m = world.cascades[cascade].cell_m;
	// No surface of the cell is further off its plane than the limit.
	float tolerance_m = 1.05 * WORLD_FLAT_SUB_VOXELS * cell_m.y / float(WORLD_SUB_VOXELS);
	bool behind_all = true;
	uint index = cell_first_record(packed_records);
	for (uint faces = packed_records & 63u; faces != 0u; faces &= faces - 1u, index++) {
		WorldRecord record = stored_record(index);
		vec3 normal = record_normal(record) * cell_m;
		vec3 center = record_position_in_cell(record);
		float at_a = dot(a - center, normal);
		float at_b = dot(b - center, normal);
		if (min(at_a, at_b) <= tolerance_m && max(at_a, at_b) >= -tolerance_m) {
			float share = abs(at_a - at_b) > 1e-9 ? clamp(at_a / (at_a - at_b), 0.0, 1.0) : 0.5;
			if (!is_beyond_edge(cascade, packed_records, record, mix(a, b, share), tolerance_m)) {
				return true;
			}
		}
		behind_all = behind_all && at_a < 0.0;
	}
	return behind_all;
}

// A walk through face-neighbouring boxes of a grid (Amanatides and Woo 1987).
struct GridWalk {
	ivec3 at;
	vec3 t_next; // where the ray leaves the box, by axis
};

void walk_on(inout GridWalk walk, vec3 inverse_rate, ivec3 direction_sign) {
	if (walk.t_next.x <= walk.t_next.y && walk.t_next.x <= walk.t_next.z) {
		walk.t_next.x += abs(inverse_rate.x);
		walk.at.x += direction_sign.x;
	} else if (walk.t_next.y <= walk.t_next.z) {
		walk.t_next.y += abs(inverse_rate.y);
		walk.at.y += direction_sign.y;
	} else {
		walk.t_next.z += abs(inverse_rate.z);
		walk.at.z += direction_sign.z;
	}
}

float walk_leaves(GridWalk walk) {
	return min(walk.t_next.x, min(walk.t_next.y, walk.t_next.z));
}

bool is_outside(ivec3 at, int size) {
	return any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, ivec3(size)));
}

// Steps through a cell's sub-voxels from `entry` (cell-local, in sub-voxels, 0..4). `rate`: sub-voxels per metre. Returns the way in metres to
// the first solid one, in a flat cell that isn't listed to the surface, or a negative number. r_octants: in a listed cell those of all solid
// sub-voxels on the way.
float trace_sub_voxels(uint cascade, WorldCell cell, vec3 entry, vec3 rate, vec3 inverse_rate, float t_max, out uint r_octants) {
	ivec3 direction_sign = ivec3(sign(rate));
	GridWalk walk;
	walk.at = clamp(ivec3(floor(entry)), ivec3(0), ivec3(3));
	walk.t_next = (vec3(walk.at) + step(vec3(0.0), rate) - entry) * inverse_rate;
	r_octants = 0u;
	bool inside = true;
	if (cell_is_listed(cell)) {
		for (uint i = 0u; i < 12u && inside; i++) {
			bool solid = bit_is_set(cell.bits, uint(walk.at.x + 4 * walk.at.y + 16 * walk.at.z));
			r_octants |= solid ? octant_of_sub_voxel(walk.at) : 0u;
			inside = walk_leaves(walk) <= t_max;
			walk_on(walk, inverse_rate, direction_sign);
			inside = inside && !is_outside(walk.at, 4);
		}
		return r_octants != 0u ? 0.0 : -1.0;
	}
	bool by_planes = (cell.records & WORLD_CELL_FLAT) != 0u;
	float t = 0.0;
	for (uint tests = 0u; tests < 12u && inside; tests++) {
		bool solid = false;
		for (uint i = 0u; i < 12u && inside && !solid; i++) {
			solid = bit_is_set(cell.bits, uint(walk.at.x + 4 * walk.at.y + 16 * walk.at.z));
			if (!solid) {
				t = walk_leaves(walk);
				walk_on(walk, inverse_rate, direction_sign);
				inside = !is_outside(walk.at, 4) && t <= t_max;
			}
		}
		if (!solid) {
			break;
		}
		float t_leave = min(walk_leaves(walk), t_max);
		if (!by_planes || crosses_surface(cascade, cell.records, (entry + rate * t) * 0.25, (entry + rate * t_leave) * 0.25)) {
			return t;
		}
		t = t_leave;
		walk_on(walk, inverse_rate, direction_sign);
		inside = !is_outside(walk.at, 4) && t <= t_max;
	}
	return -1.0;
}

// The ray's way through one cascade's box, in metres.
vec2 cascade_interval(uint cascade, vec3 origin_m, vec3 inverse_direction) {
	GiCascade c = world.cascades[cascade];
	vec3 low = vec3(c.origin_cells) * c.cell_m;
	vec3 high = vec3(c.origin_cells + int(world.grid_size)) * c.cell_m;
	vec3 a = (low - origin_m) * inverse_direction;
	vec3 b = (high - origin_m) * inverse_direction;
	vec3 near = min(a, b);
	vec3 far = max(a, b);
	return vec2(max(near.x, max(near.y, near.z)), min(far.x, min(far.y, far.z)));
}

// Traces from origin_m along the unit vector `direction` up to t_max_m. `cascade` is where the origin is looked up first: the
// finest that holds it, unless the caller wants a coarser one.
WorldHit trace_world(vec3 origin_m, vec3 direction, float t_max_m, uint first_cascade) {
	WorldHit result;
	result.hit = false;
	result.t_m = t_max_m;
	result.cell = WORLD_NO_CELL;
	result.cascade = first_cascade;
	result.world_cell = ivec3(0);
	result.position_m = origin_m;
	result.face = HIT_BITS;
	// No zero components: every division below is finite.
	vec3 d = mix(direction, vec3(1e-7), lessThan(abs(direction), vec3(1e-7)));
	vec3 inverse_direction = 1.0 / d;

	uint cascade = first_cascade;
	float t = 0.0;
	int steps = 0;
	// Each turn of the outer loop is a stretch within one cascade.
	for (uint stretch = 0u; stretch < 2u * WORLD_MAX_CASCADES && cascade < world.cascade_count; stretch++) {
		GiCascade c = world.cascades[cascade];
		vec2 interval = cascade_interval(cascade, origin_m, inverse_direction);
		float t_end = min(interval.y, t_max_m);
		uint next_cascade = cascade + 1u;
		if (cascade > 0u) {
			vec2 finer = cascade_interval(cascade - 1u, origin_m, inverse_direction);
			if (finer.x < finer.y && finer.x > t && finer.x < t_end) {
				t_end = finer.x;
				next_cascade = cascade - 1u;
			}
		}
		vec3 rate = d / c.cell_m; // cells per metre
		vec3 inverse_rate = c.cell_m * inverse_direction;
		float inverse_speed = 1.0 / length(rate);
		vec3 o = origin_m / c.cell_m - vec3(c.origin_cells);
		ivec3 direction_sign = ivec3(sign(rate));
		int size = int(world.grid_size);
		GridWalk walk;
		walk.at = clamp(ivec3(floor(o + rate * t)), ivec3(0), ivec3(size - 1));
		walk.t_next = (vec3(walk.at) + step(vec3(0.0), rate) - o) * inverse_rate;
		bool inside = true;

		// Two loops, one in the other, so that the code for stored cells runs once a stored cell and not once a step: a CPU's lanes
		// run all code of a loop's body in each turn.
		while (inside && steps < TRACE_MAX_STEPS && t < t_end) {
			bool stored = false;
			for (; inside && !stored && steps < TRACE_MAX_STEPS && t < t_end; steps++) {
				float distance = sdf_cells(cascade, storage_from_world_cell(walk.at + c.origin_cells));
				stored = distance < 0.5;
				if (!stored) {
					// The sphere around the point that no stored cell's box can reach: 0.8661 is half a cell's diagonal.
					vec3 p = o + rate * t;
					float t_sphere = t + (distance - 0.8661 - length(p - vec3(walk.at) - 0.5)) * inverse_speed;
					float t_leave = walk_leaves(walk);
					if (t_sphere > t_leave) {
						t = t_sphere;
						walk.at = ivec3(floor(o + rate * t));
						walk.t_next = (vec3(walk.at) + step(vec3(0.0), rate) - o) * inverse_rate;
					} else {
						t = max(t, t_leave);
						walk_on(walk, inverse_rate, direction_sign);
					}
					inside = !is_outside(walk.at, size);
				}
			}
			if (!stored) {
				break;
			}
			uint index = find_cell(cascade, storage_from_world_cell(walk.at + c.origin_cells));
			if (index < WORLD_LOST_CELL) {
				WorldCell cell = stored_cell(index);
				float t_leave = min(walk_leaves(walk), t_max_m);
				float way = -1.0;
				if (cell_is_plain(cell)) {
					float along;
					uint flags;
					way = meet_plane(cell, origin_m, d, vec2(t, t_leave), triangle_growth_m(cascade), along, flags);
					result.face = met_face(flags, along);
				} else {
					vec3 entry = (o + rate * t - vec3(walk.at)) * float(WORLD_SUB_VOXELS);
					uint octants;
					way = trace_sub_voxels(cascade, cell, entry, rate * float(WORLD_SUB_VOXELS), inverse_rate / float(WORLD_SUB_VOXELS), t_end - t, octants);
					result.face = HIT_BITS;
					if (way >= 0.0 && cell_is_listed(cell)) {
						// As far beyond the cell as its list reaches.
						float growth = triangle_growth_m(cascade);
						way = meet_triangles(cascade, cell, octants, walk.at + c.origin_cells, origin_m, d, vec2(t - growth, min(t_leave + growth, t_max_m)), result.face);
					} else if (way >= 0.0) {
						way += t;
					}
				}
				result.hit = way >= 0.0;
				result.t_m = way;
			} else if (index == WORLD_LOST_CELL) {
				result.hit = true;
				result.t_m = t;
			}
			if (result.hit) {
				result.cascade = cascade;
				result.cell = index;
				result.world_cell = walk.at + c.origin_cells;
				result.position_m = origin_m + direction * result.t_m;
				return result;
			}
			result.t_m = t_max_m;
			t = max(t, walk_leaves(walk));
			walk_on(walk, inverse_rate, direction_sign);
			inside = !is_outside(walk.at, size);
		}
		if (t >= t_max_m || steps >= TRACE_MAX_STEPS) {
			break;
		}
		// Not further: the distance field knows nothing of what lies beyond the cascade, and a sphere may reach there.
		t = t_end;
		cascade = next_cascade;
	}
	return result;
}

// Nothing solid between two points.
bool world_is_free(vec3 from_m, vec3 to_m, uint first_cascade) {
	vec3 way = to_m - from_m;
	float distance = length(way);
	if (distance < 1e-12) {
		return true;
	}
	return !trace_world(from_m, way / distance, distance, first_cascade).hit;
}

#endif
