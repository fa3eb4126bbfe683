#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
// SPDX-License-Identifier: MIT
// The background where nothing was drawn (reversed z: depth 0).
#include "servers/rendering/passes/sky_inc.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = SKY_DEPTH) uniform texture2D depth;
layout(set = 0, binding = SKY_TARGET, rgba16f) uniform writeonly image2D target;

void main() {
	ivec2 size = imageSize(target);
	ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(pixel, size)) || texelFetch(depth, pixel, 0).r > 0.0) {
		return;
	}
	vec2 ndc = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
	vec4 near_point = sky.world_direction_from_clip * vec4(ndc, 1.0, 1.0);
	vec4 far_point = sky.world_direction_from_clip * vec4(ndc, 0.0, 1.0);
	vec3 direction = normalize(far_point.xyz / far_point.w - near_point.xyz / near_point.w);
	imageStore(target, pixel, vec4(min(sky_light(direction, true, SKY_PI / float(size.y) * 0.25), vec3(65000.0)), 1.0));
}
