// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/test_io.h"

// A copy through registers, member by member.
layout(local_size_x = 1) in;
layout(set = 0, binding = TEST_SOURCE, scalar) readonly buffer Source { TestStruct source[]; };
layout(set = 0, binding = TEST_TARGET, scalar) writeonly buffer Target { TestStruct target[]; };

void main() {
	const TestStruct value = source[gl_GlobalInvocationID.x];
	target[gl_GlobalInvocationID.x] = value;
}
