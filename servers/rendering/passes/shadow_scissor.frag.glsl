#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// SPDX-License-Identifier: MIT
#include "servers/rendering/passes/material_inc.glsl"
layout(push_constant, scalar) uniform Constants { ShadowDrawConstants draw; };
layout(location = 0) in vec4 v_uvs;
layout(location = 1) in vec4 v_color;

void main() {
	if (material_albedo(draw.material, MaterialUvs(v_uvs.xy, v_uvs.zw), v_color).a < materials[draw.material].alpha_scissor_threshold) {
		discard;
	}
}
