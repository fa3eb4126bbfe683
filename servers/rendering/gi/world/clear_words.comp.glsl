// SPDX-License-Identifier: MIT
// Fills a part of a buffer.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_io.h"

#define CLEAR_WORDS_BUFFER 0

layout(local_size_x = 64) in;
layout(set = 0, binding = CLEAR_WORDS_BUFFER, scalar) writeonly buffer WordsBlock {
	uint words[];
};
layout(push_constant, scalar) uniform ClearWordsPush {
	ClearWordsConstants constants;
};

void main() {
	uint stride = gl_NumWorkGroups.x * 64u;
	for (uint i = gl_GlobalInvocationID.x; i < constants.count; i += stride) {
		words[constants.first + i] = constants.value;
	}
}
