// SPDX-License-Identifier: MIT
// Octahedral radiance to octahedral irradiance / pi, a work group a probe: each texel sums all radiance texels by cosine and solid
// angle, divided by the sum of the same weights, so that constant radiance stays what it is. Writes both maps' borders.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "servers/rendering/gi/sdfgi/probe_list_inc.glsl"

#define FILTER_PROBES_RADIANCE 20
#define FILTER_PROBES_IRRADIANCE 21

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = FILTER_PROBES_RADIANCE, rgba16f) uniform image2D radiance_atlas;
layout(set = 0, binding = FILTER_PROBES_IRRADIANCE, rgba16f) uniform writeonly image2D irradiance_atlas;
shared uvec2 group_radiance[64]; // half x 4

// Direction to the centre of a radiance texel; w: its solid angle up to a constant. A face of the octahedron, seen from its
// centre: area * cos / r^2, and cos is proportional to 1 / r.
vec4 texel_direction(uint texel) {
	vec2 p = (vec2(uvec2(texel % PROBE_RADIANCE_TEXELS, texel / PROBE_RADIANCE_TEXELS)) + 0.5) / float(PROBE_RADIANCE_TEXELS) * 2.0 - 1.0;
	vec3 on_octahedron = vec3(p, 1.0 - abs(p.x) - abs(p.y));
	if (on_octahedron.z < 0.0) {
		on_octahedron.xy = (1.0 - abs(p.yx)) * octahedral_sign(p);
	}
	float inverse_length = inversesqrt(dot(on_octahedron, on_octahedron));
	return vec4(on_octahedron * inverse_length, inverse_length * inverse_length * inverse_length);
}

void main() {
	uint place = place_of_slot(gl_WorkGroupID.x);
	if (place == NO_PLACE) {
		return;
	}
	uint index = constants.cascade * probes_in_cascade() + place;
	ivec2 radiance_tile = probe_tile(index, PROBE_RADIANCE_BORDERED_TEXELS);
	ivec2 thread = ivec2(gl_LocalInvocationID.xy);
	uint lane = gl_LocalInvocationIndex;
	group_radiance[lane] = half4_from_vec4(imageLoad(radiance_atlas, radiance_tile + 1 + thread));
	barrier();

	ivec2 source = octahedral_wrap(thread - 1, PROBE_IRRADIANCE_TEXELS);
	vec3 normal = direction_of_texel(source, PROBE_IRRADIANCE_TEXELS, vec2(0.5));
	vec3 sum = vec3(0.0);
	float weight_sum = 0.0;
	[[unroll]] for (uint i = 0u; i < 64u; i++) {
		vec4 direction = texel_direction(i);
		float weight = max(dot(normal, direction.xyz), 0.0) * direction.w;
		sum += weight * vec4_from_half4(group_radiance[i]).rgb;
		weight_sum += weight;
	}
	imageStore(irradiance_atlas, probe_tile(index, PROBE_BORDERED_TEXELS) + thread, vec4(sum / weight_sum, 1.0));

	// The 36 texels around the radiance tile.
	if (lane < 36u) {
		const int LAST = PROBE_RADIANCE_BORDERED_TEXELS - 1;
		ivec2 border;
		if (lane < 20u) {
			border = ivec2(int(lane % 10u), lane < 10u ? 0 : LAST);
		} else {
			border = ivec2(lane < 28u ? 0 : LAST, 1 + int((lane - 20u) % 8u));
		}
		ivec2 inside = octahedral_wrap(border - 1, PROBE_RADIANCE_TEXELS);
		imageStore(radiance_atlas, radiance_tile + border, vec4_from_half4(group_radiance[inside.y * PROBE_RADIANCE_TEXELS + inside.x]));
	}
}
