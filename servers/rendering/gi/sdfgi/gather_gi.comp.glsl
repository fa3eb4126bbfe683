// SPDX-License-Identifier: MIT
// Screen irradiance and radiance from GI, a thread a pixel. Pixels that need rays go to a list (gather_rays): without tracing code
// here, the many that don't run several times faster on a GPU.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/sdfgi/gather_inc.glsl"

shared uint group_count;
shared uint group_first;

void main() {
	ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
	if (gl_LocalInvocationIndex == 0u) {
		group_count = 0u;
	}
	barrier();
	bool needs_rays = false;
	uint slot = 0u;
	if (pixel.x < int(constants.width) && pixel.y < int(constants.height)) {
		GatherSurface surface;
		GiSample gi = GiSample(vec3(0.0), vec3(0.0), 0.0, 0.0, false);
		if (load_surface(pixel, surface)) {
			needs_rays = reflection_is_traced(surface) || !gi_sample_without_rays(surface.position_m, surface.normal, surface.view, surface.roughness, gi);
		}
		if (needs_rays) {
			slot = atomicAdd(group_count, 1u);
		} else {
			store_gi(pixel, gi);
		}
	}
	barrier();
	if (gl_LocalInvocationIndex == 0u) {
		group_first = atomicAdd(gather_counts.listed, group_count);
	}
	barrier();
	if (needs_rays) {
		ray_pixels[group_first + slot] = uint(pixel.x) | (uint(pixel.y) << 16);
	}
	store_fetches(FETCHES_GATHER_GI);
}
