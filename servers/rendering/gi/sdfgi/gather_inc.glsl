// SPDX-License-Identifier: MIT
// What the two gather passes share: the pixels' surfaces, the outputs, and the list of pixels that need rays.
#ifndef GATHER_INC
#define GATHER_INC
#include "servers/rendering/gi/gi_sample_inc.glsl"
#include "servers/rendering/gi/world/fetch_counts_inc.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = GATHER_DEPTH) uniform texture2D depth_texture;
layout(set = 0, binding = GATHER_NORMAL_ROUGHNESS) uniform texture2D normal_roughness;
layout(set = 0, binding = GATHER_IRRADIANCE, rgba16f) uniform writeonly image2D irradiance_out;
layout(set = 0, binding = GATHER_RADIANCE, rgba16f) uniform writeonly image2D radiance_out;
layout(set = 0, binding = GATHER_RAY_PIXELS, scalar) buffer RayPixelsBlock {
	GatherCounts gather_counts;
	uint ray_pixels[]; // x | y << 16
};
layout(push_constant, scalar) uniform GatherPush {
	GatherConstants constants;
};

struct GatherSurface {
	vec3 position_m;
	vec3 normal;
	vec3 view;
	float roughness;
};

// False: nothing is drawn at the pixel.
bool load_surface(ivec2 pixel, out GatherSurface surface) {
	count_fetch(4u);
	float depth = texelFetch(depth_texture, pixel, 0).r;
	if (depth <= 0.0) {
		return false;
	}
	vec2 ndc = (vec2(pixel) + 0.5) / vec2(float(constants.width), float(constants.height)) * 2.0 - 1.0;
	vec4 h = constants.world_from_clip * vec4(ndc, depth, 1.0);
	count_fetch(8u);
	vec4 normal = texelFetch(normal_roughness, pixel, 0);
	surface.position_m = h.xyz / h.w;
	surface.normal = normalize(normal.xyz);
	surface.view = normalize(constants.camera_m - surface.position_m);
	surface.roughness = normal.w;
	return true;
}

bool reflection_is_traced(GatherSurface surface) {
	return surface.roughness < GI_UNTRACED_ROUGHNESS;
}

void store_gi(ivec2 pixel, GiSample gi) {
	imageStore(irradiance_out, pixel, vec4(gi.irradiance / max(gi.weight, 1e-6), gi.weight));
	imageStore(radiance_out, pixel, vec4(gi.radiance / max(gi.weight, 1e-6), gi.weight));
}

#endif
