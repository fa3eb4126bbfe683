// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/test_io.h"

layout(set = 0, binding = TEST_SOURCE, scalar) readonly buffer Vertices { TestVertex vertices[]; };
layout(location = 0) out vec4 color;

void main() {
	color = vertices[gl_VertexIndex].color;
	gl_Position = vertices[gl_VertexIndex].position;
}
