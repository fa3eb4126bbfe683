// SPDX-License-Identifier: MIT
#include "servers/rendering/render_origin.h"

#include <algorithm>

namespace lucent {

namespace {
// How far along an axis a camera may go: moving the origin costs GI a start from nothing, so it shall be rare. At 1024 m floats are 0.06 to 0.12 mm
// apart; wide cascades have coarse cells, so they may reach as many cells instead.
constexpr float REACH_M = 1024.0f;
constexpr float REACH_CASCADES = 4.0f;

// The spacing of the coarsest cascade's probes: cascades then stand on the same cells of a scene wherever it is.
Vector3 probe_step_m(const SdfgiSettings &p_sdfgi) {
	const float step_m = std::ldexp(p_sdfgi.min_cell_size_m, int(p_sdfgi.cascades) - 1) * float(p_sdfgi.probe_spacing_cells);
	return Vector3(step_m, step_m / sdfgi_y_multiplier(p_sdfgi.y_scale), step_m);
}

float nearest_multiple(float p_value, float p_step) {
	const float multiple = float(std::floor(double(p_value) / double(p_step) + 0.5) * double(p_step));
	return std::isfinite(multiple) ? multiple : 0.0f;
}
} // namespace

bool RenderOrigin::follow(const Vector3 &p_camera_m, const SdfgiSettings &p_sdfgi) {
	// Without SDFGI any step will do, so that switching it off and on again moves nothing.
	const Vector3 step = p_sdfgi.enabled ? probe_step_m(p_sdfgi) : step_m;
	const float cascade_m = step.x / float(p_sdfgi.probe_spacing_cells) * float(p_sdfgi.grid_size_cells);
	const float reach_m = p_sdfgi.enabled ? std::max(REACH_M, REACH_CASCADES * cascade_m) : REACH_M;
	const Vector3 distance_m = glm::abs(p_camera_m - origin_m);
	const bool within_reach = std::max({ distance_m.x, distance_m.y, distance_m.z }) <= reach_m;
	if (chosen && step == step_m && within_reach) {
		return false;
	}
	const Vector3 old_m = origin_m;
	for (int axis = 0; axis < 3; axis++) {
		origin_m[axis] = nearest_multiple(p_camera_m[axis], step[axis]);
	}
	chosen = true;
	step_m = step;
	return origin_m != old_m;
}

} // namespace lucent
