// SPDX-License-Identifier: MIT
// Shades an opaque surface; the fragment shaders differ in what they keep.
#include "servers/rendering/passes/shading_inc.glsl"
layout(set = 0, binding = SHADE_GI_IRRADIANCE) uniform texture2D gi_irradiance;
layout(set = 0, binding = SHADE_GI_RADIANCE) uniform texture2D gi_radiance;
#define VARYING in
#include "servers/rendering/passes/surface_varyings_inc.glsl"
layout(push_constant, scalar) uniform Constants { DrawConstants draw; };

GiLight screen_gi() {
	if (frame.gi_enabled == 0u) {
		return GiLight(vec4(0.0), vec4(0.0));
	}
	ivec2 pixel = ivec2(gl_FragCoord.xy);
	return GiLight(texelFetch(gi_irradiance, pixel, 0), texelFetch(gi_radiance, pixel, 0));
}

Surface fragment_surface(out Lighting r_lighting) {
	MaterialUvs uvs = MaterialUvs(v_uvs.xy, v_uvs.zw);
	vec3 albedo = material_albedo(draw.material, uvs, v_color).rgb;
	Surface s = make_surface(draw.material, uvs, albedo, v_position, normalize(v_normal), v_tangent, gl_FrontFacing ? 1.0 : -1.0);
	if ((materials[draw.material].flags & MATERIAL_FLAG_UNSHADED) != 0u) {
		r_lighting = Lighting(vec3(0.0), vec3(0.0), vec3(0.0));
		s.emission = albedo;
	} else {
		r_lighting = shade(s, gl_FragCoord.xy, screen_gi());
	}
	return s;
}

// What a surface sends, which isn't negative, whatever its parts are: negative lamps take no more than there is.
vec3 sent_color(Lighting lighting, Surface s) {
	return max(lighting.direct + lighting.indirect_diffuse + lighting.indirect_specular + s.emission, vec3(0.0));
}

// Half floats end at 65504.
vec4 half_color(vec3 color) {
	return vec4(clamp(color, vec3(-65000.0), vec3(65000.0)), 1.0);
}
