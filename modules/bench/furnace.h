// SPDX-License-Identifier: MIT
#pragma once
// A scene's own furnace: every surface reflects rho of the light and emits 1 - rho, the sky is 1 and no lamp shines. Then radiance is exactly 1 at
// every pixel, whatever the geometry, because L = (1 - rho) + rho * L has the one solution 1: a truth for any scene without a path tracer.

#include "modules/reference/image_metrics.h"
#include "servers/rendering/rendering_server.h"

namespace lucent {

// Edits what p_viewport shows: all meshes get one Lambertian material (albedo p_albedo, emission 1 - p_albedo, both sides, opaque, no textures, no
// vertex colours), lights go out, the environment becomes a background of colour 1 with the scene's SDFGI settings, but enabled, bounce feedback and
// energy 1 and sky light on. Masked and blended surfaces are whole then. p_albedo: 0 to 1, below 1.
void make_furnace(RenderingServer &r_server, ViewportRid p_viewport, float p_albedo);

// A pixel counts as the mean of its channels; the truth is 1.
struct FurnaceError {
	double mean = 0;
	double p1 = 0; // percentiles over the pixels
	double p5 = 0;
	double p50 = 0;
	double p95 = 0;
	double p99 = 0;
	double off = 0; // share of pixels further than FURNACE_OFF from 1
};
inline constexpr double FURNACE_OFF = 0.05;

// Fails where there is no pixel or a value is not finite.
Result<FurnaceError> measure_furnace(const MetricImage &p_picture);

// RGB8: black where a pixel is 1, red where it is too dark, cyan (green and blue) where too bright; full colour from 0.25 on.
std::vector<uint8_t> furnace_map(const MetricImage &p_picture);

} // namespace lucent
