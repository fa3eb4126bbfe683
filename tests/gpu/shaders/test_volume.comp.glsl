// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/test_io.h"

// Adds to each texel its coordinates: x + 100 y + 10000 z.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(set = 0, binding = TEST_TARGET, r32ui) uniform uimage3D target;

void main() {
	const ivec3 texel = ivec3(gl_GlobalInvocationID);
	if (all(lessThan(texel, imageSize(target)))) {
		imageStore(target, texel, imageLoad(target, texel) + uint(texel.x + 100 * texel.y + 10000 * texel.z));
	}
}
