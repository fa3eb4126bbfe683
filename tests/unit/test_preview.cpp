// SPDX-License-Identifier: MIT
// What the program adds to a scene without lights and camera keeps its proportions at every size.
#include "modules/app/framing.h"
#include "modules/app/preview.h"
#include "modules/scene/camera_3d.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/world_environment.h"

#include <doctest/doctest.h>

using namespace lucent;

TEST_CASE("preview: camera, cells and shadows in proportion from a millimetre to 100 km") {
	scene::register_scene_classes();
	const AABB unit{ Vector3(-1.0f, -0.5f, -2.0f), Vector3(1.0f, 1.5f, 2.0f) };
	const Framing expected = frame_bounds(unit, 50.0f, 16.0f / 9.0f);
	for (const float scale : { 1e-3f, 0.06f, 1.0f, 100.0f, 1e5f }) {
		INFO(scale);
		const AABB bounds{ unit.min * scale, unit.max * scale };
		const Framing framing = frame_bounds(bounds, 50.0f, 16.0f / 9.0f);
		CHECK(glm::length(framing.transform.origin / scale - expected.transform.origin) < 1e-4f);
		CHECK(framing.near_m / scale == doctest::Approx(expected.near_m).epsilon(1e-3));
		CHECK(framing.far_m / scale == doctest::Approx(expected.far_m).epsilon(1e-3));
		scene::Node3D root;
		const PreviewNodes nodes = add_preview_environment(root);
		REQUIRE(nodes.environment);
		REQUIRE(nodes.sun);
		fit_preview(nodes, bounds);
		const float radius = 0.5f * glm::length(bounds.size());
		CHECK(nodes.environment->get_environment()->get_sdfgi_min_cell_size() / radius == doctest::Approx(0.01f));
		CHECK(nodes.environment->get_environment()->get_sdfgi_max_distance() > framing.far_m * 0.1f);
		CHECK(nodes.sun->get_parameters().shadow_max_distance_m > framing.far_m * 0.1f);
		const scene::Camera3D *camera = add_framing_camera(root, bounds, 16.0f / 9.0f);
		CHECK(camera->parameters.near_m == framing.near_m);
	}
}

TEST_CASE("preview: a ground plane around a room does not set the size of GI's cells") {
	const AABB table{ Vector3(-1.0f, 0.0f, -0.5f), Vector3(1.0f, 0.8f, 0.5f) };
	const AABB room{ Vector3(-4.0f, 0.0f, -3.0f), Vector3(4.0f, 3.0f, 3.0f) };
	const AABB ground{ Vector3(-110.0f, -0.2f, -110.0f), Vector3(110.0f, -0.2f, 110.0f) };
	CHECK(bounds_without_backdrop({ ground, table, room }).size() == room.size());
	CHECK(bounds_without_backdrop({ room, table }).size() == room.size());
	CHECK(bounds_without_backdrop({ ground }).size() == ground.size());
	CHECK(bounds_without_backdrop({}).is_empty());
}
