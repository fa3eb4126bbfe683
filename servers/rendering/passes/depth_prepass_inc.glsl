// SPDX-License-Identifier: MIT
#include "servers/rendering/passes/material_inc.glsl"
#define VARYING in
#include "servers/rendering/passes/surface_varyings_inc.glsl"
layout(location = 6) in vec4 v_clip;
layout(location = 7) in vec4 v_previous_clip;
layout(location = 0) out vec4 out_normal_roughness;
layout(location = 1) out vec2 out_motion; // uv now - uv before
layout(push_constant, scalar) uniform Constants { DrawConstants draw; };

void write_surface() {
	MaterialUvs uvs = MaterialUvs(v_uvs.xy, v_uvs.zw);
	vec3 mapped = material_normal(draw.material, uvs, normalize(v_normal), v_tangent);
	bool no_specular = materials[draw.material].specular == 0.0 && materials[draw.material].metallic == 0.0;
	out_normal_roughness = vec4(gl_FrontFacing ? mapped : -mapped, no_specular ? PREPASS_NO_SPECULAR : material_roughness(draw.material, uvs));
	bool seen = v_previous_clip.w > 1e-6 && v_clip.w > 1e-6;
	out_motion = seen ? 0.5 * (v_clip.xy / v_clip.w - v_previous_clip.xy / v_previous_clip.w) : vec2(0.0);
}
