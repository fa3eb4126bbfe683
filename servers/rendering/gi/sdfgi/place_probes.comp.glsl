// SPDX-License-Identifier: MIT
// Moves each probe away from surfaces: of its grid point and 26 points up to 0.45 of the spacing around, the nearest that has room.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/sdfgi/probes_inc.glsl"
#include "servers/rendering/gi/world/world_lookup_inc.glsl"

#define PLACE_PROBES_OUT 20

layout(local_size_x = 64) in;
layout(set = 0, binding = PLACE_PROBES_OUT, scalar) writeonly buffer PlacesBlock {
	ProbePlace places[];
};
layout(set = 0, binding = PROBE_LIST, scalar) buffer ProbeListBlock {
	uint probe_list[]; // the header is zero before
};
layout(push_constant, scalar) uniform PlacePush {
	TraceProbesConstants constants;
};

// Distance to the nearest stored cell, cells; outside of the cascade: far. Negative: inside a solid sub-voxel.
float room_cells(vec3 position_cells) {
	GiCascade cascade = world.cascades[constants.cascade];
	ivec3 cell = ivec3(floor(position_cells));
	ivec3 local = cell - cascade.origin_cells;
	if (any(lessThan(local, ivec3(0))) || any(greaterThanEqual(local, ivec3(int(world.grid_size))))) {
		return 8.0;
	}
	if (sub_voxel_is_solid(constants.cascade, position_cells * cascade.cell_m)) {
		return -1.0;
	}
	return sdf_cells(constants.cascade, storage_from_world_cell(cell));
}

void main() {
	uint place = gl_GlobalInvocationID.x;
	if (place >= probes_in_cascade()) {
		return;
	}
	ivec3 probe = probe_at_place(constants.cascade, place);
	float spacing = float(probe_params.spacing_cells);
	vec3 grid_cells = vec3(probe) * spacing;
	// A tenth of a cell off the grid point, which is a corner of eight cells and often lies exactly on a wall.
	float best_score = -1e9;
	vec3 best_offset = vec3(0.0);
	bool best_free = false;
	for (uint ring = 0u; ring < 4u; ring++) {
		float reach = ring == 0u ? 0.1 : spacing * 0.15 * float(ring);
		for (uint i = 0u; i < 27u; i++) {
			if ((i == 13u) || (ring == 0u && i != 26u)) {
				continue;
			}
			vec3 direction = vec3(ivec3(int(i % 3u), int((i / 3u) % 3u), int(i / 9u)) - 1);
			vec3 offset = reach * direction / (ring == 0u ? 1.0 : length(direction));
			float room = room_cells(grid_cells + offset);
			float score = min(room, 2.0) - length(offset) / spacing;
			if (score > best_score + 1e-4) {
				best_score = score;
				best_offset = offset;
				best_free = room >= 0.0;
			}
		}
	}
	// A block's far corner is sqrt(3) spacings away; a cell's centre up to 0.87 cells further, the probe as far from its own.
	ivec3 center = clamp(probe * int(probe_params.spacing_cells) - world.cascades[constants.cascade].origin_cells, ivec3(0), ivec3(int(world.grid_size) - 1));
	float reach_cells = sdf_cells(constants.cascade, storage_from_world_cell(center + world.cascades[constants.cascade].origin_cells));
	uint flags = (best_free ? PROBE_FREE : 0u) | (reach_cells < 1.7321 * spacing + 2.0 ? PROBE_NEAR : 0u);
	ivec3 packed_offset = ivec3(round(clamp(best_offset * 16.0, -127.0, 127.0))) & 255;
	places[constants.cascade * probes_in_cascade() + place].packed_offset = uint(packed_offset.x) | (uint(packed_offset.y) << 8) | (uint(packed_offset.z) << 16) | (flags << 24);
	if ((flags & PROBE_NEAR) != 0u && !cell_in_hole(constants.cascade, probe * int(probe_params.spacing_cells))) {
		// The order in the list is any; each probe's result is its own.
		uint start = probe_list_start(constants.cascade);
		uint slot = atomicAdd(probe_list[start], 1u);
		probe_list[start + PROBE_LIST_HEADER_WORDS + slot] = place;
		atomicMax(probe_list[start + 1u], (slot + 1u) * probe_params.rays / 64u + 1u);
		atomicMax(probe_list[start + 2u], 1u);
		atomicMax(probe_list[start + 3u], 1u);
		atomicMax(probe_list[start + 4u], slot + 1u);
		atomicMax(probe_list[start + 5u], 1u);
		atomicMax(probe_list[start + 6u], 1u);
	}
}
