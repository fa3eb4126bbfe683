// SPDX-License-Identifier: MIT
// Octahedral radiance to octahedral irradiance / pi, a work group a probe: each texel sums all radiance texels by cosine and solid
// angle, divided by the sum of the same weights, so that constant radiance stays what it is. Writes both maps' borders.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "servers/rendering/gi/sdfgi/probe_list_inc.glsl"
#include "servers/rendering/gi/world/fetch_counts_inc.glsl"

#define FILTER_PROBES_RADIANCE 20
#define FILTER_PROBES_IRRADIANCE 21

layout(constant_id = PROBE_RADIANCE_TEXELS_ID) const uint RADIANCE_TEXELS = 8u; // an axis
layout(constant_id = PROBE_IRRADIANCE_TEXELS_ID) const uint IRRADIANCE_TEXELS = 6u; // an axis, without the border
layout(local_size_x_id = PROBE_FILTER_LANES_ID, local_size_y_id = PROBE_FILTER_LANES_ID) in; // IRRADIANCE_TEXELS + 2: a lane a texel
layout(set = 0, binding = FILTER_PROBES_RADIANCE, rgba16f) uniform image2D radiance_atlas;
layout(set = 0, binding = FILTER_PROBES_IRRADIANCE, rgba16f) uniform writeonly image2D irradiance_atlas;
shared uvec2 group_radiance[RADIANCE_TEXELS * RADIANCE_TEXELS]; // half x 4

// Direction to the centre of a radiance texel; w: its solid angle up to a constant. A face of the octahedron, seen from its
// centre: area * cos / r^2, and cos is proportional to 1 / r.
vec4 texel_direction(uint texel) {
	vec2 p = (vec2(uvec2(texel % RADIANCE_TEXELS, texel / RADIANCE_TEXELS)) + 0.5) / float(RADIANCE_TEXELS) * 2.0 - 1.0;
	vec3 on_octahedron = vec3(p, 1.0 - abs(p.x) - abs(p.y));
	if (on_octahedron.z < 0.0) {
		on_octahedron.xy = (1.0 - abs(p.yx)) * octahedral_sign(p);
	}
	float inverse_length = inversesqrt(dot(on_octahedron, on_octahedron));
	return vec4(on_octahedron * inverse_length, inverse_length * inverse_length * inverse_length);
}

// The n-th texel of a tile's border, from its corner on.
ivec2 border_texel(uint n) {
	const uint BORDERED = RADIANCE_TEXELS + 2u;
	if (n < 2u * BORDERED) {
		return ivec2(int(n % BORDERED), n < BORDERED ? 0 : int(BORDERED) - 1);
	}
	n -= 2u * BORDERED;
	return ivec2(n < RADIANCE_TEXELS ? 0 : int(BORDERED) - 1, 1 + int(n % RADIANCE_TEXELS));
}

void main() {
	uint place = place_of_slot(gl_WorkGroupID.x);
	if (place == NO_PLACE) {
		return;
	}
	const uint TEXELS = RADIANCE_TEXELS * RADIANCE_TEXELS;
	const uint LANES = (IRRADIANCE_TEXELS + 2u) * (IRRADIANCE_TEXELS + 2u);
	uint index = constants.cascade * probes_in_cascade() + place;
	ivec2 radiance_tile = probe_tile(index, int(RADIANCE_TEXELS) + 2);
	ivec2 thread = ivec2(gl_LocalInvocationID.xy);
	uint lane = gl_LocalInvocationIndex;
	for (uint i = lane; i < TEXELS; i += LANES) {
		count_fetch(8u);
		group_radiance[i] = half4_from_vec4(imageLoad(radiance_atlas, radiance_tile + 1 + ivec2(int(i % RADIANCE_TEXELS), int(i / RADIANCE_TEXELS))));
	}
	barrier();

	ivec2 source = octahedral_wrap(thread - 1, int(IRRADIANCE_TEXELS));
	vec3 normal = direction_of_texel(source, int(IRRADIANCE_TEXELS), vec2(0.5));
	vec3 sum = vec3(0.0);
	float weight_sum = 0.0;
	[[unroll]] for (uint i = 0u; i < TEXELS; i++) {
		vec4 direction = texel_direction(i);
		float weight = max(dot(normal, direction.xyz), 0.0) * direction.w;
		sum += weight * vec4_from_half4(group_radiance[i]).rgb;
		weight_sum += weight;
	}
	imageStore(irradiance_atlas, probe_tile(index, int(IRRADIANCE_TEXELS) + 2) + thread, vec4(sum / weight_sum, 1.0));

	for (uint i = lane; i < 4u * (RADIANCE_TEXELS + 1u); i += LANES) {
		ivec2 border = border_texel(i);
		ivec2 inside = octahedral_wrap(border - 1, int(RADIANCE_TEXELS));
		imageStore(radiance_atlas, radiance_tile + border, vec4_from_half4(group_radiance[uint(inside.y) * RADIANCE_TEXELS + uint(inside.x)]));
	}
	store_fetches(constants.far == 0u ? FETCHES_FILTER_PROBES : FETCHES_FILTER_FAR_PROBES);
}
