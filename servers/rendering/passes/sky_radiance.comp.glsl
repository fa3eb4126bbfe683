#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// SPDX-License-Identifier: MIT
// Sky convolved with the GGX lobe of one roughness, view along the normal (Karis 2013), from sky_octahedral.
#include "servers/rendering/passes/sky_io.h"
#include "servers/rendering/shaders/octahedral_inc.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = SKY_SOURCE) uniform texture2D source;
layout(set = 0, binding = SKY_PANORAMA_SAMPLER) uniform sampler source_sampler;
layout(set = 0, binding = SKY_TARGET, rgba16f) uniform writeonly image2D target;
layout(push_constant, scalar) uniform Constants { SkyRadianceConstants constants; };
const uint SAMPLES = 128u;
const float TWO_PI = 6.28318530717959;

vec3 fetch_sky(vec3 direction) {
	return textureLod(sampler2D(source, source_sampler), octahedral_from_direction(direction) * 0.5 + 0.5, 0.0).rgb;
}

void main() {
	ivec2 size = imageSize(target);
	ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(texel, size))) {
		return;
	}
	vec3 normal = direction_from_octahedral((vec2(texel) + 0.5) / vec2(size) * 2.0 - 1.0);
	vec3 tangent = normalize(cross(abs(normal.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), normal));
	vec3 bitangent = cross(normal, tangent);
	float alpha = constants.roughness * constants.roughness;
	vec3 sum = vec3(0.0);
	float weight = 0.0;
	for (uint i = 0u; i < SAMPLES; i++) {
		vec2 xi = vec2((float(i) + 0.5) / float(SAMPLES), float(bitfieldReverse(i)) * 2.3283064365386963e-10);
		float cosine = sqrt((1.0 - xi.x) / (1.0 + (alpha * alpha - 1.0) * xi.x));
		float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
		vec3 halfway = tangent * (sine * cos(TWO_PI * xi.y)) + bitangent * (sine * sin(TWO_PI * xi.y)) + normal * cosine;
		vec3 direction = 2.0 * cosine * halfway - normal;
		float n_l = dot(normal, direction);
		if (n_l > 0.0) {
			sum += fetch_sky(direction) * n_l;
			weight += n_l;
		}
	}
	imageStore(target, texel, vec4(weight > 0.0 ? sum / weight : fetch_sky(normal), 1.0));
}
