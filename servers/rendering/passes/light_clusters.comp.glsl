#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// SPDX-License-Identifier: MIT
// Which positional lights reach which cluster (tile x slice): 32 lights a thread, sphere against view-space box.
#include "servers/rendering/passes/frame_io.h"
#include "servers/rendering/passes/light_clusters_io.h"
#include "servers/rendering/shaders/scene_io.h"
layout(local_size_x = 64) in;
layout(set = 0, binding = LIGHT_CLUSTERS_FRAME, scalar) uniform Frame { FrameData frame; };
layout(set = 0, binding = LIGHT_CLUSTERS_LIGHTS, scalar) readonly buffer Lights { LightData lights[]; };
layout(set = 0, binding = LIGHT_CLUSTERS_MASKS, scalar) writeonly buffer Masks { uint masks[]; };
layout(push_constant, scalar) uniform Constants { LightClustersConstants constants; };

// The view-space point at a distance along the ray through a point of the screen.
vec3 screen_point(vec2 ndc, float distance_m) {
	vec4 a = constants.view_from_clip * vec4(ndc, 1.0, 1.0);
	vec4 b = constants.view_from_clip * vec4(ndc, 0.5, 1.0);
	vec3 from = a.xyz / a.w;
	vec3 to = b.xyz / b.w;
	return from + (to - from) * ((-distance_m - from.z) / min(to.z - from.z, -1e-9));
}

void main() {
	uvec3 count = frame.cluster_count;
	uint cluster = gl_GlobalInvocationID.x / frame.cluster_words;
	uint word = gl_GlobalInvocationID.x % frame.cluster_words;
	if (cluster >= count.x * count.y * count.z) {
		return;
	}
	uvec3 cell = uvec3(cluster % count.x, (cluster / count.x) % count.y, cluster / (count.x * count.y));
	// The first slice also holds what is nearer, the last what is farther.
	float near_m = cell.z == 0u ? 0.0 : frame.cluster_near_m * exp2(float(cell.z) / frame.cluster_slices_per_log2);
	float far_m = frame.cluster_near_m * exp2(float(cell.z + 1u) / frame.cluster_slices_per_log2);
	if (cell.z + 1u == count.z) {
		far_m *= 1e4;
	}
	vec3 low = vec3(1e30);
	vec3 high = vec3(-1e30);
	for (uint corner = 0u; corner < 8u; corner++) {
		vec2 pixel = vec2(cell.xy + uvec2(corner & 1u, (corner >> 1u) & 1u)) * float(CLUSTER_TILE_PIXELS);
		vec3 p = screen_point(pixel / vec2(frame.size_pixels) * 2.0 - 1.0, corner < 4u ? near_m : far_m);
		low = min(low, p);
		high = max(high, p);
	}
	uint mask = 0u;
	for (uint i = 0u; i < 32u; i++) {
		uint index = 32u * word + i;
		if (index >= constants.light_count) {
			break;
		}
		if (lights[index].type == LIGHT_TYPE_DIRECTIONAL) {
			continue;
		}
		vec3 center = (frame.views[0].view_from_world * vec4(lights[index].position, 1.0)).xyz;
		vec3 offset = center - clamp(center, low, high);
		if (dot(offset, offset) <= lights[index].range * lights[index].range) {
			mask |= 1u << i;
		}
	}
	masks[gl_GlobalInvocationID.x] = mask;
}
