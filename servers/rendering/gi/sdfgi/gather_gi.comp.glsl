// SPDX-License-Identifier: MIT
// Screen irradiance and radiance from GI, a thread a pixel. Glossy surfaces trace one ray for the mirror direction.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/gi_sample_inc.glsl"

#define GATHER_GI_DEPTH 20
#define GATHER_GI_NORMAL_ROUGHNESS 21
#define GATHER_GI_IRRADIANCE 22
#define GATHER_GI_RADIANCE 23

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = GATHER_GI_DEPTH) uniform texture2D depth_texture;
layout(set = 0, binding = GATHER_GI_NORMAL_ROUGHNESS) uniform texture2D normal_roughness;
layout(set = 0, binding = GATHER_GI_IRRADIANCE, rgba16f) uniform writeonly image2D irradiance_out;
layout(set = 0, binding = GATHER_GI_RADIANCE, rgba16f) uniform writeonly image2D radiance_out;
layout(push_constant, scalar) uniform GatherPush {
	GatherConstants constants;
};

vec3 traced_reflection(vec3 position_m, vec3 normal, vec3 view) {
	uint cascade = finest_cascade(position_m);
	if (cascade >= world.cascade_count) {
		return world_sky_radiance(reflect(-view, normal));
	}
	GiQuery query = GiQuery(position_m, normal, view, 0.0, position_m, false);
	find_query_start(query, cascade);
	vec3 direction = reflect(-view, normal);
	WorldHit hit = trace_world(query.start_m, direction, 1e6, cascade);
	return hit.hit ? hit_radiance(hit, direction, 1.0, true) : world_sky_radiance(direction);
}

void main() {
	ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
	if (pixel.x >= int(constants.width) || pixel.y >= int(constants.height)) {
		return;
	}
	float depth = texelFetch(depth_texture, pixel, 0).r;
	if (depth <= 0.0) {
		imageStore(irradiance_out, pixel, vec4(0.0));
		imageStore(radiance_out, pixel, vec4(0.0));
		return;
	}
	vec2 ndc = (vec2(pixel) + 0.5) / vec2(float(constants.width), float(constants.height)) * 2.0 - 1.0;
	vec4 h = constants.world_from_clip * vec4(ndc, depth, 1.0);
	vec3 position_m = h.xyz / h.w;
	vec4 surface = texelFetch(normal_roughness, pixel, 0);
	vec3 normal = normalize(surface.xyz);
	vec3 view = normalize(constants.camera_m - position_m);
	GiSample gi = gi_sample(position_m, normal, view, surface.w);
	vec3 radiance = gi.radiance;
	if (surface.w < GI_TRACED_ROUGHNESS + 0.15) {
		float traced = 1.0 - smoothstep(GI_TRACED_ROUGHNESS - 0.1, GI_TRACED_ROUGHNESS + 0.15, surface.w);
		radiance = mix(radiance, traced_reflection(position_m, normal, view) * probe_params.energy * gi.weight, traced);
	}
	imageStore(irradiance_out, pixel, vec4(gi.irradiance / max(gi.weight, 1e-6), gi.weight));
	imageStore(radiance_out, pixel, vec4(radiance / max(gi.weight, 1e-6), gi.weight));
}
