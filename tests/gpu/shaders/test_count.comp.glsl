// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/test_io.h"

// Counts its own threads; the group's size is a specialization constant.
layout(local_size_x_id = 7) in;
layout(set = 0, binding = TEST_TARGET, scalar) buffer Target { uint target[]; };

void main() {
	atomicAdd(target[0], 1);
}
