#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// SPDX-License-Identifier: MIT
// World normal with its map, roughness, motion.
#include "servers/rendering/passes/depth_prepass_inc.glsl"

void main() {
	write_surface();
}
