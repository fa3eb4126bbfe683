// SPDX-License-Identifier: MIT
// The sky's inputs. Shared by C++ and GLSL.
#ifndef SKY_IO_H
#define SKY_IO_H
#include "servers/rendering/device/shader_interop.h"

#define SKY_KIND_COLOR 0
#define SKY_KIND_PROCEDURAL 1
#define SKY_KIND_PANORAMA 2
#define MAX_SKY_SUNS 4

#define SKY_DATA 0
#define SKY_PANORAMA 1
#define SKY_PANORAMA_SAMPLER 2
#define SKY_TARGET 3
#define SKY_SOURCE 4
#define SKY_DEPTH 5

INTEROP_BEGIN
struct SkySun {
	vec3 to_sun; // unit
	float cos_size; // of the disc's angular radius
	vec3 color; // linear * energy
};
struct SkyData {
	mat4 sky_from_world; // rotation
	mat4 world_direction_from_clip; // camera rotation and the sky's field of view
	uint kind;
	vec3 color; // SKY_KIND_COLOR
	float energy;
	vec3 sky_top; // energies multiplied in
	vec3 sky_horizon;
	vec3 ground_bottom;
	vec3 ground_horizon;
	float inverse_sky_curve;
	float inverse_ground_curve;
	float cos_sun_angle_max;
	float inverse_sun_curve;
	uint sun_count;
	SkySun suns[MAX_SKY_SUNS];
};
struct SkyRadianceConstants {
	float roughness;
};
INTEROP_END
#endif
