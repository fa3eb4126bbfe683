// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "tests/gpu/shaders/test_io.h"

// Each texel is the sum of four of the mip before.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = TEST_SOURCE) uniform texture2D source;
layout(set = 0, binding = TEST_TARGET, r32f) uniform writeonly image2D target;

void main() {
	const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
	if (all(lessThan(texel, imageSize(target)))) {
		float sum = 0.0;
		for (int i = 0; i < 4; i++) {
			sum += texelFetch(source, 2 * texel + ivec2(i & 1, i >> 1), 0).r;
		}
		imageStore(target, texel, vec4(sum));
	}
}
