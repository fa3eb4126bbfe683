// SPDX-License-Identifier: MIT
// Shared by tests/gpu and its shaders.
#ifndef TEST_IO_H
#define TEST_IO_H
#include "servers/rendering/device/shader_interop.h"

#define TEST_SOURCE 0
#define TEST_TARGET 1
#define TEST_SAMPLER 2
#define TEST_RAY_SOURCE 20
#define TEST_RAY_HITS 21

INTEROP_BEGIN
struct TestConstants {
	uint count;
	uint value;
};
struct TestInner {
	vec3 direction;
	float length;
};
// Of awkward alignments.
struct TestStruct {
	float a;
	vec3 b;
	uint c;
	mat4 d;
	ivec2 e;
	TestInner inner[2];
	vec2 f;
	vec4 g[2];
};
struct TestRay {
	vec3 origin_m;
	vec3 direction; // unit
};
struct TestHit {
	float t_m; // negative: nothing
	uint face;
	uint free_way; // the first half metre
};
struct TestVertex {
	vec4 position; // clip space
	vec4 color;
};
INTEROP_END
INTEROP_SIZE(TestStruct, 4 + 12 + 4 + 64 + 8 + 32 + 8 + 32)
#endif
