// SPDX-License-Identifier: MIT
// SDFGI's own structs, constants and bindings, beside the world's (gi/world/world_io.h). Shared by C++ and GLSL.
#ifndef SDFGI_IO_H
#define SDFGI_IO_H
#include "servers/rendering/device/shader_interop.h"

#define PROBE_BORDER_TEXELS 2 // an axis: a probe's two octahedral maps are stored with one texel around

// Specialisation constants of filter_probes
#define PROBE_RADIANCE_TEXELS_ID 1
#define PROBE_IRRADIANCE_TEXELS_ID 2
#define PROBE_FILTER_LANES_ID 3

// Passes whose fetches are counted
#define FETCHES_TRACE_RECORDS 0u
#define FETCHES_LIGHT_LAMPS 1u
#define FETCHES_LIGHT_RECORDS 2u
#define FETCHES_TRACE_PROBES 3u
#define FETCHES_TRACE_FAR_PROBES 4u
#define FETCHES_FILTER_PROBES 5u
#define FETCHES_FILTER_FAR_PROBES 6u
#define FETCHES_GATHER_GI 7u
#define FETCHES_GATHER_RAYS 8u
#define FETCHES_PASSES 9u

// trace_records, light_lamps, light_records
#define RECORD_RAYS_COUNTS 20
#define RECORD_RAYS_STATE 21
#define RECORD_RAYS_STATISTICS 22
#define RECORD_RAYS_CACHE 23
#define TRACE_RECORDS_EMITTERS 24
#define TRACE_RECORDS_EMITTER_COUNT 25
#define LIGHT_LAMPS_LIGHTS 24
#define LIGHT_RECORDS_OUT 24

// What a gather ray has met
#define GATHER_MET_SKY 0u
#define GATHER_MET_RECORD 1u // of the cell that was hit
#define GATHER_MET_NEIGHBOUR 2u // no record of that cell answers, but one beside it
#define GATHER_MET_NOTHING 3u // none does: black
#define GATHER_MET_BACK 4u // of a one-sided surface: black
#define GATHER_MET_LOST_CELL 5u // without memory: black
#define GATHER_MET_KINDS 6

#define SETTLED_CHANGE 0.002 // of a record's light in a frame: less counts as none

// gather_gi, gather_rays
#define GATHER_DEPTH 20
#define GATHER_NORMAL_ROUGHNESS 21
#define GATHER_IRRADIANCE 22
#define GATHER_RADIANCE 23
#define GATHER_RAY_PIXELS 24 // GatherCounts, then pixels

// Bindings of the list of near probes
#define PROBE_LIST 34

#define PROBE_FREE 1 // not in a solid sub-voxel
#define PROBE_NEAR 2 // a surface can read it: there is a stored cell in the eight blocks around it
// Frames between the updates of a probe that is not near
#define PROBE_FAR_PERIOD 8

// Probes, wherever they are read
#define GI_PROBE_PARAMS 9 // uniform ProbeParams
#define GI_PROBE_IRRADIANCE 30 // texture2D: a tile of ProbeParams::irradiance_texels + PROBE_BORDER_TEXELS a probe
#define GI_PROBE_RADIANCE 31
#define GI_PROBE_OFFSETS 32 // ProbePlace a probe
#define GI_PROBE_SAMPLER 33

INTEROP_BEGIN
struct RecordRaysConstants {
	uint cascade;
	uint turn; // of `turns`
	uint turns; // in a full set of rays
	uint cache_capacity; // words
	uint light_count;
};
struct LightRecordsConstants {
	uint cascade;
	uint turns; // in a full set of rays
	uint turns_done; // by trace_records, this frame's included
	uint lamp_turns_done; // by light_lamps
	uint cache_capacity; // words
	float feedback; // sdfgi_bounce_feedback
};
// A probe's place: offset from its grid point in 1/16 cells, 8 bits an axis (signed), then PROBE_* bits.
struct ProbePlace {
	uint packed_offset;
};
// The near probes of a cascade, outside of holes: PROBE_LIST_HEADER words, then their places.
struct ProbeListHeader {
	uint count;
	uvec3 trace_groups; // indirect arguments
	uvec3 filter_groups;
};
#define PROBE_LIST_HEADER_WORDS 8u // as if the header were padded to 32 bytes
struct ProbeParams {
	uint probes; // an axis
	uint spacing_cells;
	uint rays; // a probe and frame
	uint radiance_texels; // an axis of a probe's octahedral radiance
	uint irradiance_texels;
	uint frame; // since the probes' means started anew
	uint running_frame; // never starts anew: what is due in a frame goes by it, so that constant change starves no texel
	float normal_bias; // sub-voxels
	float probe_bias; // sub-voxels
	float energy;
	uint use_occlusion;
	vec3 camera_m;
	uint average_frames; // most visits that a radiance texel's mean counts
};
struct TraceProbesConstants {
	uint cascade;
	uint far; // 1: the probes that are not near, a slice a frame
};
struct GatherConstants {
	mat4 world_from_clip;
	vec3 camera_m;
	uint width;
	uint height;
	uint view; // debug views: DEBUG_VIEW_*
};
// Pixels of a picture.
struct GatherCounts {
	uint listed; // for gather_rays
	uint startless; // of these, without a free point before them
	uint recordless; // that no surface record lights: probes do
};
struct SdfgiStatistics {
	uint rays;
	uint lit_records; // with any light
	uint changed_records; // … that moved by more than SETTLED_CHANGE
	uint met[GATHER_MET_KINDS]; // rays that trace_records gathers light with, by GATHER_MET_*
};
INTEROP_END
INTEROP_SIZE(RecordRaysConstants, 20)
INTEROP_SIZE(LightRecordsConstants, 24)
INTEROP_SIZE(ProbeParams, 60)
INTEROP_SIZE(ProbeListHeader, 28)
INTEROP_SIZE(GatherConstants, 88)
#endif
