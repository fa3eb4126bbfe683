// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/test_io.h"

// target[i] = source[i] + value
layout(local_size_x = 64) in;
layout(set = 0, binding = TEST_SOURCE, scalar) readonly buffer Source { uint source[]; };
layout(set = 0, binding = TEST_TARGET, scalar) buffer Target { uint target[]; };
layout(push_constant, scalar) uniform Constants { TestConstants constants; };

void main() {
	if (gl_GlobalInvocationID.x < constants.count) {
		target[gl_GlobalInvocationID.x] = source[gl_GlobalInvocationID.x] + constants.value;
	}
}
