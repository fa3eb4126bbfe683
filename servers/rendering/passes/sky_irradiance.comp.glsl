#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
// SPDX-License-Identifier: MIT
// Cosine-weighted mean of sky_octahedral by normal: irradiance over pi.
#include "servers/rendering/passes/sky_io.h"
#include "servers/rendering/shaders/octahedral_inc.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = SKY_SOURCE) uniform texture2D source;
layout(set = 0, binding = SKY_TARGET, rgba16f) uniform writeonly image2D target;
shared vec4 tile[64]; // radiance * solid angle, solid angle: of a block of 2 x 2 texels
shared vec3 tile_direction[64];

vec3 octahedron_point(vec2 p) { // direction_from_octahedral before it is made a unit vector
	vec3 point = vec3(p, 1.0 - abs(p.x) - abs(p.y));
	if (point.z < 0.0) {
		point.xy = (1.0 - abs(p.yx)) * octahedral_sign(p);
	}
	return point;
}

// One direction serves a block: the cosine hardly changes within it, and the loop below is four times shorter.
void load_block(ivec2 block, ivec2 source_size) {
	vec4 light = vec4(0.0);
	vec3 direction = vec3(0.0);
	for (int i = 0; i < 4; i++) {
		ivec2 position = block * 2 + ivec2(i & 1, i >> 1);
		vec3 point = octahedron_point((vec2(position) + 0.5) / vec2(source_size) * 2.0 - 1.0);
		// The octahedron's density: solid angle is proportional to |v|^-3 of the unnormalised direction.
		float inverse = inversesqrt(dot(point, point));
		float solid_angle = inverse * inverse * inverse;
		light += vec4(texelFetch(source, position, 0).rgb, 1.0) * solid_angle;
		direction += point * inverse;
	}
	tile[gl_LocalInvocationIndex] = light;
	tile_direction[gl_LocalInvocationIndex] = normalize(direction);
}

void main() {
	ivec2 size = imageSize(target);
	ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
	ivec2 source_size = textureSize(source, 0); // multiples of 16
	vec3 normal = direction_from_octahedral((vec2(texel) + 0.5) / vec2(size) * 2.0 - 1.0);
	vec3 sum = vec3(0.0);
	float weight = 0.0;
	for (int y = 0; y < source_size.y / 2; y += 8) {
		for (int x = 0; x < source_size.x / 2; x += 8) {
			barrier();
			load_block(ivec2(x, y) + ivec2(gl_LocalInvocationID.xy), source_size);
			barrier();
			for (uint i = 0u; i < 64u; i++) {
				float cosine = max(dot(tile_direction[i], normal), 0.0);
				sum += tile[i].rgb * cosine;
				weight += tile[i].a * cosine;
			}
		}
	}
	if (all(lessThan(texel, size))) {
		imageStore(target, texel, vec4(sum / max(weight, 1e-6), 1.0));
	}
}
