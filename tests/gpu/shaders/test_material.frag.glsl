// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "tests/gpu/shaders/test_io.h"

// The material's texture times the pass's own.
layout(set = 0, binding = TEST_TARGET) uniform texture2D pass_texture;
layout(set = 1, binding = 0) uniform sampler2D material_texture;
layout(set = 1, binding = 1, scalar) readonly buffer Tint { vec4 tint; };
layout(push_constant, scalar) uniform Constants { TestConstants constants; };
layout(location = 0) in vec4 color;
layout(location = 0) out vec4 target;

void main() {
	target = color * tint * texture(material_texture, vec2(0.5)) * texelFetch(pass_texture, ivec2(0), 0) * float(constants.value);
}
