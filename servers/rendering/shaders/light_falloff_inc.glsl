// SPDX-License-Identifier: MIT
// How lamps fade: the one text for raster, GI (GLSL) and the path tracer (C++, shaders/light_falloff.h). Godot's definition, as its
// forward renderer and its SDFGI have it. Hence the f suffixes.
//   distance d, range R, decay p:      (1 - (d / R)^4)^2 d^-p, 0 from R on; d is at least 0.1 mm
//   spot, cosine c to its axis, a the angle's: 1 - max((1 - c) / (1 - cos a), 1e-4)^e, 0 outside; e = 1 / spot_angle_attenuation
#ifndef LIGHT_FALLOFF_INC
#define LIGHT_FALLOFF_INC
#ifndef __cplusplus
#define SHADER_FUNC
#endif

#define LIGHT_MIN_DISTANCE_M 1e-4f
#define LIGHT_MIN_RIM 1e-4f

SHADER_FUNC float light_distance_falloff(float p_distance_m, float p_range_m, float p_decay) {
	float ratio = p_distance_m / p_range_m;
	float window = max(1.0f - ratio * ratio * ratio * ratio, 0.0f);
	float near_m = max(p_distance_m, LIGHT_MIN_DISTANCE_M);
	return window * window * (p_decay == 2.0f ? 1.0f / (near_m * near_m) : pow(near_m, -p_decay));
}

// p_spot_cos: of the angle between axis and rim. p_exponent: of the rim, above 0.
SHADER_FUNC float light_cone_falloff(float p_cosine, float p_spot_cos, float p_exponent) {
	float rim = max((1.0f - p_cosine) / max(1.0f - p_spot_cos, 1e-6f), LIGHT_MIN_RIM);
	return rim < 1.0f ? 1.0f - pow(rim, p_exponent) : 0.0f;
}

#endif
