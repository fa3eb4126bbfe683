// SPDX-License-Identifier: MIT
#pragma once
// Where the device's coordinates begin. The server's scene is in world coordinates; everything that goes to the device (instances, lights,
// cameras, shadow maps, GI's cells) is relative to a point near the camera, subtracted before any other arithmetic. So
// - far from the world's origin nothing is less exact than near it, but for what the world's floats themselves can't hold;
// - a scene that is moved together with its camera, by a multiple of the spacing of SDFGI's coarsest probes and where all coordinates stay exact,
//   gives the same picture bit for bit.
// Shaders and the code that fills their buffers say "world" for these coordinates.

#include "servers/core/math_types.h"
#include "servers/rendering/gi/sdfgi/sdfgi_settings.h"

namespace lucent {

class RenderOrigin {
public:
	// Once a frame, for the first viewport that shows the scenario: two cameras far from one another must not fight over it, and the device's
	// copy of the scene can't change within a frame. True: the origin moved, so nothing on the device that is a position is valid any more.
	bool follow(const Vector3 &p_camera_m, const SdfgiSettings &p_sdfgi);
	const Vector3 &position_m() const { return origin_m; } // world
	Transform3D render_from_world(const Transform3D &p_world) const { return { p_world.basis, p_world.origin - origin_m }; }

private:
	bool chosen = false;
	Vector3 step_m{ 16.0f }; // origin_m is a multiple of it; until there is SDFGI any step will do
	Vector3 origin_m{ 0.0f };
};

} // namespace lucent
