#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
// SPDX-License-Identifier: MIT
// As opaque, with the parts of the light beside their sum.
#include "servers/rendering/passes/opaque_inc.glsl"
layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_direct;
layout(location = 2) out vec4 out_indirect_diffuse;
layout(location = 3) out vec4 out_indirect_specular;
layout(location = 4) out vec4 out_emission;
layout(location = 5) out vec4 out_albedo;

void main() {
	Lighting lighting;
	Surface s = fragment_surface(lighting);
	out_color = half_color(sent_color(lighting, s));
	out_direct = half_color(lighting.direct);
	out_indirect_diffuse = half_color(lighting.indirect_diffuse);
	out_indirect_specular = half_color(lighting.indirect_specular);
	out_emission = half_color(s.emission);
	out_albedo = vec4(s.albedo, 1.0);
}
