// SPDX-License-Identifier: MIT
// Blended surfaces: lit as opaque ones are, with GI sampled here (TRANSPARENT_GI) instead of read from the screen.
#ifndef TRANSPARENT_INC
#define TRANSPARENT_INC
#ifdef TRANSPARENT_GI
#define WORLD_BINDING(m_index) (m_index + GI_SAMPLE_BINDING_BASE)
#include "servers/rendering/gi/gi_sample_inc.glsl"
#endif
#include "servers/rendering/passes/shading_inc.glsl"
#define VARYING in
#include "servers/rendering/passes/surface_varyings_inc.glsl"
layout(push_constant, scalar) uniform Constants { DrawConstants draw; };
layout(location = 0) out vec4 out_color;

GiLight surface_gi(Surface s) {
#ifdef TRANSPARENT_GI
	// A surface without a specular lobe asks for no radiance, as in the prepass.
	GiSample gi = gi_sample(s.position, s.normal, s.view, s.lobes.f90 > 0.0 ? s.roughness : GI_NO_SPECULAR);
	float weight = max(gi.weight, 1e-6);
	return GiLight(vec4(gi.irradiance / weight, gi.weight), vec4(gi.radiance / weight, gi.weight));
#else
	return GiLight(vec4(0.0), vec4(0.0));
#endif
}

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
		Lighting lighting = shade(s, gl_FragCoord.xy, surface_gi(s));
		color = lighting.direct + lighting.indirect_diffuse + lighting.indirect_specular + s.emission;
	}
	out_color = vec4(clamp(color, vec3(0.0), vec3(65000.0)), alpha * v_opacity);
}

#endif
