// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/test_io.h"

layout(location = 0) in vec4 color;
layout(location = 0) out vec4 target;

void main() {
	target = color;
}
