#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
// SPDX-License-Identifier: MIT
// Lit as opaque surfaces are; ambient light serves where the screen's GI does not.
#include "servers/rendering/passes/shading_inc.glsl"
#define VARYING in
#include "servers/rendering/passes/surface_varyings_inc.glsl"
layout(push_constant, scalar) uniform Constants { DrawConstants draw; };
layout(location = 0) out vec4 out_color;

void main() {
	MaterialUvs uvs = MaterialUvs(v_uvs.xy, v_uvs.zw);
	vec4 albedo = material_albedo(draw.material, uvs, v_color);
	uint flags = materials[draw.material].flags;
	if ((flags & MATERIAL_FLAG_ALPHA_SCISSOR) != 0u && albedo.a < materials[draw.material].alpha_scissor_threshold) {
		discard;
	}
	float alpha = (flags & MATERIAL_FLAG_ALPHA_BLEND) != 0u ? clamp(albedo.a, 0.0, 1.0) : 1.0;
	Surface s = make_surface(draw.material, uvs, albedo.rgb, v_position, normalize(v_normal), v_tangent, gl_FrontFacing ? 1.0 : -1.0);
	vec3 color = albedo.rgb;
	if ((flags & MATERIAL_FLAG_UNSHADED) == 0u) {
		Lighting lighting = shade(s, gl_FragCoord.xy, GiLight(vec4(0.0), vec4(0.0)));
		color = lighting.direct + lighting.indirect_diffuse + lighting.indirect_specular + s.emission;
	}
	out_color = vec4(clamp(color, vec3(-65000.0), vec3(65000.0)), alpha * v_opacity);
}
