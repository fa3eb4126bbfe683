// SPDX-License-Identifier: MIT
#include "servers/rendering/gi/sdfgi/sdfgi_cascades.h"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace lucent;

TEST_CASE("a cascade surrounds the camera and stands on multiples of the probe spacing") {
	const Vector3 cell(0.2f, 0.2f / 1.5f, 0.2f);
	for (const Vector3 &camera : { Vector3(0.0f), Vector3(3.3f, -7.1f, 12.9f), Vector3(-1000.0f, 20.0f, 5000.0f) }) {
		const Vector3i origin = cascade_origin_cells(camera, cell, 128, 8, nullptr);
		for (int axis = 0; axis < 3; axis++) {
			CHECK(origin[axis] % 8 == 0);
			const float local = camera[axis] / cell[axis] - float(origin[axis]);
			CHECK(local >= 64.0f - 4.01f);
			CHECK(local <= 64.0f + 4.01f);
		}
	}
}

TEST_CASE("a cascade stays while the camera moves less than one probe") {
	const Vector3 cell(0.2f);
	const Vector3i origin = cascade_origin_cells(Vector3(0.0f), cell, 128, 8, nullptr);
	CHECK(cascade_origin_cells(Vector3(1.5f, 0.0f, 0.0f), cell, 128, 8, &origin) == origin);
	const Vector3i moved = cascade_origin_cells(Vector3(1.7f, 0.0f, 0.0f), cell, 128, 8, &origin);
	CHECK(moved == origin + Vector3i(8, 0, 0));
	// Back across the same border: no toggling.
	CHECK(cascade_origin_cells(Vector3(1.5f, 0.0f, 0.0f), cell, 128, 8, &moved) == moved);
}
