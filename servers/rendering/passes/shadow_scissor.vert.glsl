#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// SPDX-License-Identifier: MIT
#include "servers/rendering/passes/vertex_inc.glsl"
layout(push_constant, scalar) uniform Constants { ShadowDrawConstants draw; };
layout(location = 0) out vec4 v_uvs;
layout(location = 1) out vec4 v_color;

void main() {
	InstanceData instance = instances[draw_instances[gl_InstanceIndex]];
	gl_Position = draw.clip_from_world * vec4(world_position(instance, positions[gl_VertexIndex]), 1.0);
	v_uvs = vec4(attributes[gl_VertexIndex].uv, attributes[gl_VertexIndex].uv2);
	v_color = unpackUnorm4x8(attributes[gl_VertexIndex].color);
}
