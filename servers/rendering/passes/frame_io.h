// SPDX-License-Identifier: MIT
// What every raster pass of a frame sees. Shared by C++ and GLSL.
#ifndef FRAME_IO_H
#define FRAME_IO_H
#include "servers/rendering/device/shader_interop.h"

// Set 0 of all passes that draw the scene.
#define RASTER_FRAME 0
#define RASTER_POSITIONS 1
#define RASTER_ATTRIBUTES 2
#define RASTER_INSTANCES 3
#define RASTER_MATERIALS 4
#define RASTER_DRAW_INSTANCES 5
// … and of those that shade.
#define SHADE_LIGHTS 6
#define SHADE_CLUSTERS 7
#define SHADE_SHADOW_VIEWS 8
#define SHADE_SUN_SHADOWS 9
#define SHADE_LIGHT_SHADOWS 10
#define SHADE_SHADOW_SAMPLER 11
#define SHADE_SKY_IRRADIANCE 12
#define SHADE_SKY_RADIANCE 13
#define SHADE_LINEAR_SAMPLER 14
#define SHADE_GI_IRRADIANCE 15
#define SHADE_GI_RADIANCE 16
#define SHADE_ENVIRONMENT_BRDF 17

// Roughness that the prepass writes where there is no specular lobe: GI looks up no reflection there.
#define PREPASS_NO_SPECULAR 2.0
#define MAX_DIRECTIONAL_LIGHTS 8
#define SUN_SPLITS 4
#define SKY_RADIANCE_LAYERS 6 // layer i holds roughness i / (SKY_RADIANCE_LAYERS - 1)
#define CLUSTER_TILE_PIXELS 64
#define CLUSTER_SLICES 24
#define MAX_CLUSTER_WORDS 8 // 32 lights each

INTEROP_BEGIN
struct ViewData {
	mat4 clip_from_world;
	mat4 previous_clip_from_world;
	mat4 world_from_clip;
	mat4 view_from_world;
	vec3 camera_position; // m
	vec3 camera_back; // unit, +z of the camera
	uint orthogonal; // 1: no perspective
};
struct FrameData {
	ViewData views[2];
	uvec2 size_pixels;
	vec3 ambient_color; // irradiance / pi where the sky does not serve
	float ambient_sky_mix; // 0: ambient_color, 1: sky
	float ambient_sky_energy;
	uint gi_enabled;
	uint directional_count;
	uint directional_lights[MAX_DIRECTIONAL_LIGHTS]; // into the lights
	uvec3 cluster_count;
	uint cluster_words; // words a cluster, bit i of word w: light 32 w + i
	float cluster_near_m;
	float cluster_slices_per_log2; // slice = log2(distance / near) * this
};
// A shadow map's view. uv and depth = shadow_from_world * p, divided by w.
struct ShadowView {
	mat4 shadow_from_world;
	float texel_size; // m; perspective: m a metre of distance
	float end_m; // sun: view distance where the split ends
	uint layer;
};
struct DrawConstants {
	uint material;
};
struct ShadowDrawConstants {
	mat4 clip_from_world;
	uint material;
};
INTEROP_END
INTEROP_SIZE(ViewData, 284)
INTEROP_SIZE(ShadowView, 76)
INTEROP_SIZE(ShadowDrawConstants, 68)
#endif
