#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// SPDX-License-Identifier: MIT
// Also of the transparent pass. gl_Position is computed as in depth_prepass, bit for bit.
#include "servers/rendering/passes/vertex_inc.glsl"
layout(set = 0, binding = RASTER_FRAME, scalar) uniform Frame { FrameData frame; };
#define VARYING out
#include "servers/rendering/passes/surface_varyings_inc.glsl"
invariant gl_Position;

void main() {
	InstanceData instance = instances[draw_instances[gl_InstanceIndex]];
	vec3 position = world_position(instance, positions[gl_VertexIndex]);
	v_position = position;
	v_normal = world_normal(instance, attributes[gl_VertexIndex].normal);
	vec4 tangent = attributes[gl_VertexIndex].tangent;
	vec3 along = world_vector(instance, tangent.xyz);
	float mirror = (instance.flags & INSTANCE_FLAG_MIRRORED) != 0u ? -1.0 : 1.0;
	v_tangent = vec4(along * inversesqrt(max(dot(along, along), 1e-30)), tangent.w * mirror);
	v_uvs = vec4(attributes[gl_VertexIndex].uv, attributes[gl_VertexIndex].uv2);
	v_color = unpackUnorm4x8(attributes[gl_VertexIndex].color);
	v_opacity = 1.0 - instance.transparency;
	gl_Position = frame.views[0].clip_from_world * vec4(position, 1.0);
}
