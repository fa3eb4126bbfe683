// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/surface_light_inc.glsl"
#include "tests/gpu/shaders/test_io.h"

// What rays through the world meet, and whether the way to half of a metre is free by the rules of short ways.
layout(local_size_x = 64) in;
layout(set = 0, binding = TEST_RAY_SOURCE, scalar) readonly buffer Rays { TestRay rays[]; };
layout(set = 0, binding = TEST_RAY_HITS, scalar) writeonly buffer Hits { TestHit hits[]; };
layout(push_constant, scalar) uniform Push { TestConstants constants; };

void main() {
	uint i = gl_GlobalInvocationID.x;
	if (i >= constants.count) {
		return;
	}
	WorldHit hit = trace_world(rays[i].origin_m, rays[i].direction, 100.0, 0u);
	hits[i].t_m = hit.hit ? hit.t_m : -1.0;
	hits[i].face = hit.face;
	hits[i].free_way = short_way_is_free(0u, rays[i].origin_m, rays[i].origin_m + 0.5 * rays[i].direction) ? 1u : 0u;
}
