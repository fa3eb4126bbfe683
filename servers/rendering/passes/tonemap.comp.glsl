#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
// SPDX-License-Identifier: MIT
// Linear HDR to sRGB-encoded 8 bit with Godot 4's curves.
#include "servers/rendering/passes/tonemap_io.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = TONEMAP_SOURCE) uniform texture2D source;
layout(set = 0, binding = TONEMAP_TARGET, rgba8) uniform writeonly image2D target;
layout(push_constant, scalar) uniform Constants { TonemapConstants constants; };

vec3 reinhard(vec3 color, float white) {
	float white2 = white * white;
	return (white2 * color + color * color) / (white2 * color + white2);
}

// Hable, "Uncharted 2: HDR Lighting", GDC 2010; the bias of 2 is folded into the constants.
vec3 hable(vec3 x) {
	const float A = 0.22 * 4.0, B = 0.30 * 2.0, C = 0.10, D = 0.20, E = 0.01, F = 0.30;
	return (x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F) - E / F;
}

// Stephen Hill's fit of the ACES RRT and ODT (BakingLab); exposure bias 1.8 as Godot.
vec3 aces_curve(vec3 x) {
	return (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.432951) + 0.238081);
}

vec3 aces(vec3 color, float white) {
	const mat3 RRT_FROM_RGB = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
	const mat3 RGB_FROM_ODT = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
	vec3 mapped = RGB_FROM_ODT * aces_curve(RRT_FROM_RGB * (color * 1.8));
	return mapped / aces_curve(vec3(white * 1.8)).x;
}

// AgX (Sobotka), with the polynomial of its default contrast (Wrensch, "Minimal AgX implementation") over -12.47 to +4.03 EV and
// Rec. 2020 primaries folded into the inset and outset.
vec3 agx(vec3 color) {
	const mat3 INSET = mat3(0.544908136763, 0.140440058840, 0.088827411852, 0.373779459598, 0.754109598640, 0.178877124651, 0.081384976686, 0.105433585369, 0.732249999569);
	const mat3 OUTSET = mat3(1.964550960273, -0.299322433911, -0.164368338061, -0.855858451178, 1.326451074156, -0.238224640689, -0.108867108266, -0.027084020984, 1.402665347143);
	const float MIN_EV = -12.4739311883324;
	const float MAX_EV = 4.02606881166759;
	vec3 x = INSET * color;
	x = (clamp(log2(max(x, vec3(1e-10))), MIN_EV, MAX_EV) - MIN_EV) / (MAX_EV - MIN_EV);
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	x = 0.021 * x + 4.0111 * x2 - 25.682 * x2 * x + 70.359 * x4 - 74.778 * x4 * x + 27.069 * x4 * x2;
	return OUTSET * pow(max(x, vec3(0.0)), vec3(2.4));
}

vec3 encode_srgb(vec3 color) {
	return mix(1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, color * 12.92, lessThanEqual(color, vec3(0.0031308)));
}

void main() {
	ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(pixel, imageSize(target)))) {
		return;
	}
	vec3 color = max(texelFetch(source, pixel, 0).rgb * constants.exposure, vec3(0.0));
	switch (constants.tone_mapper) {
		case 1u:
			color = reinhard(color, constants.white);
			break;
		case 2u:
			color = hable(color) / hable(vec3(constants.white)).x;
			break;
		case 3u:
			color = aces(color, constants.white);
			break;
		case 4u:
			color = agx(color);
			break;
	}
	imageStore(target, pixel, vec4(encode_srgb(clamp(color, vec3(0.0), vec3(1.0))), 1.0));
}
