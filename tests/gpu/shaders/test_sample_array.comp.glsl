// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/test_io.h"

// target[i] = bilinear sample at the middle of layer i
layout(local_size_x = 1) in;
layout(set = 0, binding = TEST_SOURCE) uniform texture2DArray source;
layout(set = 0, binding = TEST_SAMPLER) uniform sampler linear_sampler;
layout(set = 0, binding = TEST_TARGET, scalar) writeonly buffer Target { vec4 target[]; };

void main() {
	target[gl_GlobalInvocationID.x] = textureLod(sampler2DArray(source, linear_sampler), vec3(0.5, 0.5, gl_GlobalInvocationID.x), 0.0);
}
