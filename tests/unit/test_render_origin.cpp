// SPDX-License-Identifier: MIT
#include "servers/rendering/render_origin.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>

using namespace lucent;

namespace {
SdfgiSettings exact_settings() {
	SdfgiSettings settings;
	settings.enabled = true;
	settings.cascades = 2;
	settings.min_cell_size_m = 0.25f; // probes of the coarsest cascade are 4 m apart, 2 m in y
	settings.y_scale = SdfgiYScale::SCALE_50_PERCENT;
	return settings;
}
} // namespace

TEST_CASE("render origin: the coarsest probe nearest to the camera, wherever the scene is") {
	const Vector3 camera_m(5.5f, 2.75f, -1.0f);
	for (const Vector3 &shift_m : { Vector3(0.0f), Vector3(4.0f, -4.0f, 12.0f), Vector3(131072.0f, -131072.0f, 65536.0f) }) {
		RenderOrigin origin;
		CHECK(origin.follow(camera_m + shift_m, exact_settings()));
		CHECK(origin.position_m() == Vector3(4.0f, 2.0f, 0.0f) + shift_m);
		const Transform3D camera = origin.render_from_world({ Basis(2.0f), camera_m + shift_m });
		CHECK(camera == Transform3D{ Basis(2.0f), Vector3(1.5f, 0.75f, -1.0f) });
	}
}

TEST_CASE("render origin: stays until the camera is far away or the spacing changes") {
	RenderOrigin origin;
	SdfgiSettings settings = exact_settings();
	CHECK_FALSE(origin.follow(Vector3(0.5f), settings));
	CHECK_FALSE(origin.follow(Vector3(-1000.0f, 1000.0f, 1000.0f), settings));
	CHECK(origin.position_m() == Vector3(0.0f));
	CHECK(origin.follow(Vector3(-1030.0f, 1.0f, 1000.0f), settings));
	CHECK(origin.position_m() == Vector3(-1028.0f, 2.0f, 1000.0f));
	CHECK_FALSE(origin.follow(Vector3(-1025.0f, 7.0f, 1005.0f), settings));
	settings.enabled = false;
	CHECK_FALSE(origin.follow(Vector3(-1025.0f, 7.0f, 1005.0f), settings));
	settings.enabled = true;
	settings.cascades = 3;
	CHECK(origin.follow(Vector3(-1025.0f, 7.0f, 1005.0f), settings));
	CHECK(origin.position_m() == Vector3(-1024.0f, 8.0f, 1008.0f));
	settings.cascades = 8; // 4096 m wide, four of them
	CHECK(origin.follow(Vector3(0.0f), settings));
	CHECK_FALSE(origin.follow(Vector3(16000.0f, 0.0f, 0.0f), settings));
	CHECK(origin.follow(Vector3(16400.0f, 0.0f, 0.0f), settings));
}

TEST_CASE("render origin: a camera that is nowhere leaves it at the world's") {
	RenderOrigin origin;
	CHECK_FALSE(origin.follow(Vector3(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3.0f), SdfgiSettings()));
	CHECK(origin.position_m() == Vector3(0.0f));
}
