// SPDX-License-Identifier: MIT
#pragma once

#include "servers/rendering/render_scene.h"

#include <vector>

namespace lucent {

// Around every visible mesh of the scene, in world space; empty without any.
AABB visible_bounds(const RenderScene &p_scene);

// Around what makes up the scene, without the ground that it stands on: the largest boxes are left out as long as they are flat and over four times
// as wide as all others together.
AABB bounds_without_backdrop(std::vector<AABB> p_boxes);
// The boxes of every visible mesh, in world space.
std::vector<AABB> visible_boxes(const RenderScene &p_scene);

struct Framing {
	Transform3D transform;
	float near_m = 0.05f; // in proportion to the bounds, as all of it
	float far_m = 4000.0f;
};
// Where a perspective camera stands so that p_bounds just fits into the picture, seen from the front, the right and above.
Framing frame_bounds(const AABB &p_bounds, float p_fov_y_degrees, float p_aspect);

} // namespace lucent
