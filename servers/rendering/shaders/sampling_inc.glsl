// SPDX-License-Identifier: MIT
// Hashes and low-discrepancy sequences.
#ifndef SAMPLING_INC
#define SAMPLING_INC

const float PI = 3.14159265358979;

// PCG output function (O'Neill 2014) on an LCG step.
uint hash_uint(uint v) {
	uint state = v * 747796405u + 2891336453u;
	uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
	return (word >> 22) ^ word;
}

float unit_float(uint bits) {
	return float(bits >> 8) * (1.0 / 16777216.0);
}

// Point `index` of the R2 sequence (Roberts 2018), rotated by a hashed offset (Cranley-Patterson). Integer arithmetic, so exact.
vec2 r2_point(uint index, uint seed) {
	uint x = hash_uint(seed) + index * 3242174889u; // 2^32 / plastic number
	uint y = hash_uint(seed ^ 0x9E3779B9u) + index * 2447445414u; // 2^32 / plastic number^2
	return vec2(unit_float(x), unit_float(y));
}

// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1) 2017.
mat3 basis_from_normal(vec3 n) {
	float s = n.z >= 0.0 ? 1.0 : -1.0;
	float a = -1.0 / (s + n.z);
	float b = n.x * n.y * a;
	return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

vec3 cosine_direction(vec2 u, vec3 normal) {
	float r = sqrt(u.x);
	float phi = 2.0 * PI * u.y;
	return basis_from_normal(normal) * vec3(r * cos(phi), r * sin(phi), sqrt(max(0.0, 1.0 - u.x)));
}

#endif
