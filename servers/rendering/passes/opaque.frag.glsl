#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
// SPDX-License-Identifier: MIT
#include "servers/rendering/passes/opaque_inc.glsl"
layout(location = 0) out vec4 out_color;

void main() {
	Lighting lighting;
	Surface s = fragment_surface(lighting);
	out_color = half_color(sent_color(lighting, s));
}
