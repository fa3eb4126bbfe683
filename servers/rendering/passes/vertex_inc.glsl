// SPDX-License-Identifier: MIT
// Pulls a vertex and its instance from the scene's buffers.
#ifndef VERTEX_INC
#define VERTEX_INC
#include "servers/rendering/passes/frame_io.h"
#include "servers/rendering/shaders/scene_io.h"

layout(set = 0, binding = RASTER_POSITIONS, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = RASTER_ATTRIBUTES, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 0, binding = RASTER_INSTANCES, scalar) readonly buffer Instances { InstanceData instances[]; };
layout(set = 0, binding = RASTER_DRAW_INSTANCES, scalar) readonly buffer DrawInstances { uint draw_instances[]; };

vec3 world_position(InstanceData instance, vec3 local) {
	vec4 p = vec4(local, 1.0);
	return vec3(dot(instance.world_from_local[0], p), dot(instance.world_from_local[1], p), dot(instance.world_from_local[2], p));
}

vec3 previous_world_position(InstanceData instance, vec3 local) {
	vec4 p = vec4(local, 1.0);
	return vec3(dot(instance.previous_world_from_local[0], p), dot(instance.previous_world_from_local[1], p), dot(instance.previous_world_from_local[2], p));
}

vec3 world_vector(InstanceData instance, vec3 local) {
	return vec3(dot(instance.world_from_local[0].xyz, local), dot(instance.world_from_local[1].xyz, local), dot(instance.world_from_local[2].xyz, local));
}

// The cofactors are det * inverse transpose: right for every scale, flipped by mirrors.
vec3 world_normal(InstanceData instance, vec3 local) {
	vec3 x = instance.world_from_local[0].xyz;
	vec3 y = instance.world_from_local[1].xyz;
	vec3 z = instance.world_from_local[2].xyz;
	vec3 normal = vec3(dot(cross(y, z), local), dot(cross(z, x), local), dot(cross(x, y), local));
	if ((instance.flags & INSTANCE_FLAG_MIRRORED) != 0u) {
		normal = -normal;
	}
	return normal * inversesqrt(max(dot(normal, normal), 1e-30));
}
#endif
