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
shared vec4 tile[64]; // radiance * solid angle, solid angle
shared vec3 tile_direction[64];

void main() {
	ivec2 size = imageSize(target);
	ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
	ivec2 source_size = textureSize(source, 0);
	vec3 normal = direction_from_octahedral((vec2(texel) + 0.5) / vec2(size) * 2.0 - 1.0);
	vec3 sum = vec3(0.0);
	float weight = 0.0;
	for (int y = 0; y < source_size.y; y += 8) {
		for (int x = 0; x < source_size.x; x += 8) {
			ivec2 position = ivec2(x, y) + ivec2(gl_LocalInvocationID.xy);
			vec2 p = (vec2(position) + 0.5) / vec2(source_size) * 2.0 - 1.0;
			// The octahedron's density: solid angle is proportional to |v|^-3 of the unnormalised direction.
			vec3 flat_direction = vec3(p, 1.0 - abs(p.x) - abs(p.y));
			if (flat_direction.z < 0.0) {
				flat_direction.xy = (1.0 - abs(p.yx)) * octahedral_sign(p);
			}
			float inverse = inversesqrt(dot(flat_direction, flat_direction));
			float solid_angle = inverse * inverse * inverse;
			barrier();
			tile[gl_LocalInvocationIndex] = vec4(texelFetch(source, position, 0).rgb, 1.0) * solid_angle;
			tile_direction[gl_LocalInvocationIndex] = flat_direction * inverse;
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
