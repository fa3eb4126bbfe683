// SPDX-License-Identifier: MIT
// Which probe a lane of trace_probes or filter_probes works on.
#ifndef PROBE_LIST_INC
#define PROBE_LIST_INC
#include "servers/rendering/gi/sdfgi/probes_inc.glsl"

layout(set = 0, binding = PROBE_LIST, scalar) readonly buffer ProbeListBlock {
	uint probe_list[];
};
layout(set = 0, binding = GI_PROBE_OFFSETS, scalar) readonly buffer PlacesBlock {
	ProbePlace places[];
};
layout(push_constant, scalar) uniform ProbePush {
	TraceProbesConstants constants;
};

#define NO_PLACE 0xFFFFFFFFu

// The place of the slot-th probe that is due this frame: of the list of near probes, or of this frame's slice of all others.
uint place_of_slot(uint slot) {
	if (constants.far == 0u) {
		uint start = probe_list_start(constants.cascade);
		count_fetch(4u);
		return slot < probe_list[start] ? probe_list[start + PROBE_LIST_HEADER_WORDS + slot] : NO_PLACE;
	}
	uint place = slot + probe_params.running_frame % PROBE_FAR_PERIOD * far_slice_size();
	if (slot >= far_slice_size() || place >= probes_in_cascade() || probe_is_near(places[constants.cascade * probes_in_cascade() + place])) {
		return NO_PLACE;
	}
	return cell_in_hole(constants.cascade, probe_at_place(constants.cascade, place) * int(probe_params.spacing_cells)) ? NO_PLACE : place;
}

#endif
