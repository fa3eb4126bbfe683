// SPDX-License-Identifier: MIT
// Octahedral map, signed form (Cigolle et al., JCGT 3(2) 2014): unit sphere <-> [-1, 1]^2.
#ifndef OCTAHEDRAL_INC
#define OCTAHEDRAL_INC

vec2 octahedral_sign(vec2 v) {
	return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec2 octahedral_from_direction(vec3 direction) {
	vec2 p = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
	return direction.z >= 0.0 ? p : (1.0 - abs(p.yx)) * octahedral_sign(p);
}

vec3 direction_from_octahedral(vec2 p) {
	vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
	if (v.z < 0.0) {
		v.xy = (1.0 - abs(v.yx)) * octahedral_sign(v.xy);
	}
	return normalize(v);
}

#endif
