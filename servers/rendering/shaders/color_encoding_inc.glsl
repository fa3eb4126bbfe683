// SPDX-License-Identifier: MIT
// Packed colours. RGB9E5: EXT_texture_shared_exponent's definition, rounded to nearest.
#ifndef COLOR_ENCODING_INC
#define COLOR_ENCODING_INC

uint rgb9e5_from_color(vec3 color) {
	vec3 c = clamp(color, vec3(0.0), vec3(65408.0));
	float largest = max(c.r, max(c.g, c.b));
	if (!(largest > 0.0)) {
		return 0u;
	}
	float exponent = max(-16.0, floor(log2(largest))) + 1.0;
	float scale = exp2(exponent - 9.0);
	if (floor(largest / scale + 0.5) >= 512.0) {
		exponent += 1.0;
		scale *= 2.0;
	}
	uvec3 mantissa = uvec3(floor(c / scale + 0.5));
	return mantissa.r | (mantissa.g << 9) | (mantissa.b << 18) | (uint(exponent + 15.0) << 27);
}

vec3 color_from_rgb9e5(uint bits) {
	float scale = exp2(float(bits >> 27) - 24.0);
	return vec3(float(bits & 511u), float((bits >> 9) & 511u), float((bits >> 18) & 511u)) * scale;
}

uint unorm111110_from_color(vec3 color) {
	uvec3 q = uvec3(clamp(color, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0) + 0.5);
	return q.r | (q.g << 11) | (q.b << 22);
}

vec3 color_from_unorm111110(uint bits) {
	return vec3(float(bits & 2047u), float((bits >> 11) & 2047u), float(bits >> 22)) / vec3(2047.0, 2047.0, 1023.0);
}

uvec2 half4_from_vec4(vec4 v) {
	vec4 c = clamp(v, vec4(-65504.0), vec4(65504.0));
	return uvec2(packHalf2x16(c.xy), packHalf2x16(c.zw));
}

vec4 vec4_from_half4(uvec2 bits) {
	return vec4(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y));
}

#endif
