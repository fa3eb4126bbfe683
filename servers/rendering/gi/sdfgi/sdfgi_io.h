// SPDX-License-Identifier: MIT
// SDFGI's own structs, constants and bindings, beside the world's (gi/world/world_io.h). Shared by C++ and GLSL.
#ifndef SDFGI_IO_H
#define SDFGI_IO_H
#include "servers/rendering/device/shader_interop.h"

#define PROBE_RADIANCE_TEXELS 8 // an axis of a probe's octahedral radiance
#define PROBE_IRRADIANCE_TEXELS 6 // an axis of a probe's octahedral irradiance, without its border
#define PROBE_BORDERED_TEXELS 8 // … with it; both maps are stored with one texel of border around: radiance 10
#define PROBE_RADIANCE_BORDERED_TEXELS 10

// light_records
#define LIGHT_RECORDS_LIGHTS 20
#define LIGHT_RECORDS_COUNTS 21
#define LIGHT_RECORDS_EMITTERS 22
#define LIGHT_RECORDS_EMITTER_COUNT 23
#define LIGHT_RECORDS_STATE 24
#define LIGHT_RECORDS_OUT 25
#define LIGHT_RECORDS_STATISTICS 26

// gather_gi, gather_rays
#define GATHER_DEPTH 20
#define GATHER_NORMAL_ROUGHNESS 21
#define GATHER_IRRADIANCE 22
#define GATHER_RADIANCE 23
#define GATHER_RAY_PIXELS 24

// Bindings of the list of near probes
#define PROBE_LIST 34

#define PROBE_FREE 1 // not in a solid sub-voxel
#define PROBE_NEAR 2 // a surface can read it: there is a stored cell in the eight blocks around it
// Frames between the updates of a probe that is not near
#define PROBE_FAR_PERIOD 8

// Probes, wherever they are read
#define GI_PROBE_PARAMS 9 // uniform ProbeParams
#define GI_PROBE_IRRADIANCE 30 // texture2D: a tile of PROBE_BORDERED_TEXELS a probe
#define GI_PROBE_RADIANCE 31
#define GI_PROBE_OFFSETS 32 // ProbePlace a probe
#define GI_PROBE_SAMPLER 33

INTEROP_BEGIN
struct LightRecordsConstants {
	uint cascade;
	uint frame; // since the light was reset
	uint epoch_frames; // frames of this set of rays
	uint epoch_turn; // of them, done before this one
	uint first_epoch; // 1: there is no earlier mean
	uint light_count;
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
	uint frame; // since the light was reset
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
struct SdfgiStatistics {
	uint rays;
	uint lit_records; // at the end of an epoch: with any light
	uint changed_records; // … whose mean moved by more than 2 %
};
INTEROP_END
INTEROP_SIZE(LightRecordsConstants, 28)
INTEROP_SIZE(ProbeParams, 48)
INTEROP_SIZE(ProbeListHeader, 28)
INTEROP_SIZE(GatherConstants, 88)
#endif
