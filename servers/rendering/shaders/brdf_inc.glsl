// SPDX-License-Identifier: MIT
// The one BRDF: opaque and transparent surfaces (GLSL), the path tracer and gi_reflectance (C++, shaders/brdf.h) compile this text. Hence
// the f suffixes, no swizzled writes and no out parameters. Per steradian; multiply by pi for Godot's light energies, by cos where the
// caller integrates. Which parts are Godot's and which glTF's: doc/conventions.md.
//   albedo (1 - metallic) / pi + D V F: GGX, height-correlated Smith, Schlick (glTF 2.0, appendix B.3; Filament, section 4.4).
#ifndef BRDF_INC
#define BRDF_INC
#ifndef __cplusplus
#define SHADER_FUNC
#endif

#define BRDF_PI 3.14159265358979f
#define BRDF_MIN_ROUGHNESS 0.045f // keeps D below 1e5, within fp16

struct BrdfLobes {
	vec3 diffuse; // reflectance: divide by pi for the BRDF
	vec3 f0; // specular at normal incidence
	float f90; // specular at grazing incidence
	float alpha; // GGX width: roughness squared
};

// p_specular is Godot's: f0 = 0.16 specular^2. At 0 a dielectric has no specular lobe at all: f90 follows f0 (Lagarde and de Rousiers 2014,
// section 4.9.1; the factor of 16.5 a channel is Godot's).
SHADER_FUNC BrdfLobes brdf_lobes(vec3 p_albedo, float p_metallic, float p_roughness, float p_specular, vec3 p_specular_tint) {
	BrdfLobes lobes;
	float roughness = clamp(p_roughness, BRDF_MIN_ROUGHNESS, 1.0f);
	lobes.diffuse = p_albedo * (1.0f - p_metallic);
	lobes.f0 = mix(min(p_specular_tint * (0.16f * p_specular * p_specular), vec3(1.0f)), p_albedo, p_metallic);
	lobes.f90 = clamp(dot(lobes.f0, vec3(16.5f)), p_metallic, 1.0f);
	lobes.alpha = roughness * roughness;
	return lobes;
}

SHADER_FUNC float brdf_distribution_ggx(float p_n_dot_h, float p_alpha) {
	float a2 = p_alpha * p_alpha;
	float f = (p_n_dot_h * a2 - p_n_dot_h) * p_n_dot_h + 1.0f;
	return a2 / (BRDF_PI * f * f);
}

// G / (4 n.l n.v)
SHADER_FUNC float brdf_visibility_smith(float p_n_dot_l, float p_n_dot_v, float p_alpha) {
	float a2 = p_alpha * p_alpha;
	float v = p_n_dot_l * sqrt(p_n_dot_v * p_n_dot_v * (1.0f - a2) + a2);
	float l = p_n_dot_v * sqrt(p_n_dot_l * p_n_dot_l * (1.0f - a2) + a2);
	return 0.5f / max(v + l, 1e-7f);
}

SHADER_FUNC vec3 brdf_fresnel_schlick(vec3 p_f0, float p_f90, float p_v_dot_h) {
	float m = clamp(1.0f - p_v_dot_h, 0.0f, 1.0f);
	float m2 = m * m;
	return p_f0 + (vec3(p_f90) - p_f0) * (m2 * m2 * m);
}

// The specular lobe for unit normal, view (towards the eye) and light (towards the light). 0 below the horizon.
SHADER_FUNC vec3 brdf_specular(BrdfLobes p_lobes, vec3 p_normal, vec3 p_view, vec3 p_light) {
	float n_dot_l = dot(p_normal, p_light);
	float n_dot_v = max(dot(p_normal, p_view), 1e-4f);
	if (n_dot_l <= 0.0f || p_lobes.f90 <= 0.0f) {
		return vec3(0.0f);
	}
	vec3 h = normalize(p_view + p_light);
	float d = brdf_distribution_ggx(clamp(dot(p_normal, h), 0.0f, 1.0f), p_lobes.alpha);
	float v = brdf_visibility_smith(n_dot_l, n_dot_v, p_lobes.alpha);
	return brdf_fresnel_schlick(p_lobes.f0, p_lobes.f90, clamp(dot(p_view, h), 0.0f, 1.0f)) * (d * v);
}

// What the specular lobe reflects of light that is the same from all directions: p_environment is brdf_table.h's pair for the view's
// cosine and the roughness (the split sum's second factor: Karis, "Real Shading in Unreal Engine 4", 2013).
SHADER_FUNC vec3 brdf_environment(BrdfLobes p_lobes, vec2 p_environment) {
	return p_lobes.f0 * p_environment.x + vec3(p_lobes.f90 * p_environment.y);
}

SHADER_FUNC vec3 brdf_diffuse(BrdfLobes p_lobes) {
	return p_lobes.diffuse * (1.0f / BRDF_PI);
}

#endif
