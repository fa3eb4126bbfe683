#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// SPDX-License-Identifier: MIT
// As depth_prepass, without the texels below the alpha threshold.
#include "servers/rendering/passes/depth_prepass_inc.glsl"

void main() {
	MaterialUvs uvs = MaterialUvs(v_uvs.xy, v_uvs.zw);
	if (material_albedo(draw.material, uvs, v_color).a < materials[draw.material].alpha_scissor_threshold) {
		discard;
	}
	write_surface();
}
