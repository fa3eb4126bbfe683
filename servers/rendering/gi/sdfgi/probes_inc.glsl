// SPDX-License-Identifier: MIT
// Probe addressing: probe p of a cascade (world-fixed integer coordinates, position p * spacing cells) is stored at p modulo the
// count an axis; tiles of the atlases are numbered by cascade and storage place, 256 a row.
#ifndef PROBES_INC
#define PROBES_INC
#include "servers/rendering/gi/sdfgi/sdfgi_io.h"
#include "servers/rendering/gi/world/world_inc.glsl"

layout(set = 0, binding = WORLD_BINDING(GI_PROBE_PARAMS), scalar) uniform ProbeParamsBlock {
	ProbeParams probe_params;
};

#define PROBE_TILES_A_ROW 256u

uint probes_in_cascade() {
	return probe_params.probes * probe_params.probes * probe_params.probes;
}
ivec3 first_probe(uint cascade) {
	return world.cascades[cascade].origin_cells / int(probe_params.spacing_cells); // origins are multiples of the spacing
}
uint probe_index(uint cascade, ivec3 probe) {
	int n = int(probe_params.probes);
	ivec3 s = ((probe % n) + n) % n;
	return cascade * probes_in_cascade() + uint((s.z * n + s.y) * n + s.x);
}
// The probe of a cascade's present window that is stored at `place` (0 .. probes_in_cascade - 1).
ivec3 probe_at_place(uint cascade, uint place) {
	int n = int(probe_params.probes);
	ivec3 s = ivec3(int(place) % n, (int(place) / n) % n, int(place) / (n * n));
	ivec3 first = first_probe(cascade);
	return first + (((s - first) % n) + n) % n;
}
vec3 probe_position_m(uint cascade, ivec3 probe, ProbePlace place) {
	ivec3 offset = ivec3(int(place.packed_offset << 24) >> 24, int(place.packed_offset << 16) >> 24, int(place.packed_offset << 8) >> 24);
	return (vec3(probe * int(probe_params.spacing_cells)) + vec3(offset) / 16.0) * world.cascades[cascade].cell_m;
}
bool probe_is_free(ProbePlace place) {
	return ((place.packed_offset >> 24) & PROBE_FREE) != 0u;
}
bool probe_is_near(ProbePlace place) {
	return ((place.packed_offset >> 24) & PROBE_NEAR) != 0u;
}
// The probe's own count of updates up to a frame: probes that no surface reads take turns.
uint probe_turn(ProbePlace place, uint frame) {
	return probe_is_near(place) ? frame : frame / PROBE_FAR_PERIOD;
}
uint far_slice_size() {
	return (probes_in_cascade() + PROBE_FAR_PERIOD - 1u) / PROBE_FAR_PERIOD;
}
uint probe_list_start(uint cascade) {
	return cascade * (PROBE_LIST_HEADER_WORDS + probes_in_cascade());
}
ivec2 probe_tile(uint index, int tile_texels) {
	return ivec2(int(index % PROBE_TILES_A_ROW), int(index / PROBE_TILES_A_ROW)) * tile_texels;
}

// Where a texel of the border, or beyond an edge of the octahedral square, is found inside it.
ivec2 octahedral_wrap(ivec2 t, int size) {
	if (t.x < 0 || t.x >= size) {
		t.x = t.x < 0 ? -1 - t.x : 2 * size - 1 - t.x;
		t.y = size - 1 - t.y;
	}
	if (t.y < 0 || t.y >= size) {
		t.y = t.y < 0 ? -1 - t.y : 2 * size - 1 - t.y;
		t.x = size - 1 - t.x;
	}
	return t;
}
vec3 direction_of_texel(ivec2 t, int size, vec2 within) {
	return direction_from_octahedral((vec2(t) + within) / float(size) * 2.0 - 1.0);
}

#endif
