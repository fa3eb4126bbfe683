#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
// SPDX-License-Identifier: MIT
// The background without suns, by world direction, for ambient light and GI. 4x4 samples a texel.
#include "servers/rendering/passes/sky_inc.glsl"
#include "servers/rendering/shaders/octahedral_inc.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = SKY_TARGET, rgba16f) uniform writeonly image2D target;

void main() {
	ivec2 size = imageSize(target);
	ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(texel, size))) {
		return;
	}
	vec3 sum = vec3(0.0);
	for (uint i = 0u; i < 16u; i++) {
		vec2 uv = (vec2(texel) + (vec2(i & 3u, i >> 2u) + 0.5) * 0.25) / vec2(size);
		sum += sky_light(direction_from_octahedral(uv * 2.0 - 1.0), false, 0.5 * SKY_PI / float(size.x));
	}
	imageStore(target, texel, vec4(min(sum / 16.0, vec3(65000.0)), 1.0));
}
