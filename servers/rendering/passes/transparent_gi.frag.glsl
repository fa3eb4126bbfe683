#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
// SPDX-License-Identifier: MIT
#define TRANSPARENT_GI
#include "servers/rendering/passes/transparent_inc.glsl"
