// SPDX-License-Identifier: MIT
// SDFGI against answers that are known exactly.
#include "tests/gpu/gi_test_scene.h"
#include "tests/gpu/gpu_fixture.h"

#include <doctest/doctest.h>

using namespace lucent;
using lucent::test::GpuFixture;

namespace {

const Vector3 AXES[] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };

SdfgiSettings small_settings(SdfgiYScale p_scale) {
	SdfgiSettings settings;
	settings.enabled = true;
	settings.cascades = 2;
	settings.grid_size_cells = 64;
	settings.y_scale = p_scale;
	settings.frames_to_converge = 8;
	return settings;
}

} // namespace

TEST_SUITE("gpu") {
	TEST_CASE("white furnace: constant sky over a lone box reads 1 on every side, at every y scale") {
		GpuFixture fixture;
		for (const SdfgiYScale scale : { SdfgiYScale::SCALE_50_PERCENT, SdfgiYScale::SCALE_75_PERCENT, SdfgiYScale::SCALE_100_PERCENT }) {
			GiTestScene scene(fixture.device());
			scene.add_box(Vector3(-0.55f), Vector3(0.55f), scene.add_material(Vector3(0.5f)));
			scene.set_sky(Vector3(1.0f), Vector3(1.0f));
			Sdfgi sdfgi(fixture.device());
			run_sdfgi(fixture.device(), sdfgi, small_settings(scale), scene.upload(), Vector3(0.0f), 64);
			std::vector<Vector3> points, normals(std::begin(AXES), std::end(AXES));
			for (const Vector3 &axis : AXES) {
				points.push_back(axis * 0.55f);
			}
			for (const Vector3 &value : gather_at(fixture.device(), sdfgi, points, normals)) {
				CHECK(value.x == doctest::Approx(1.0f).epsilon(0.003));
			}
		}
	}

	TEST_CASE("white furnace: a closed room of albedo 0.5 and emission 1 reads 2 on every side, at every y scale") {
		GpuFixture fixture;
		for (const SdfgiYScale scale : { SdfgiYScale::SCALE_50_PERCENT, SdfgiYScale::SCALE_75_PERCENT, SdfgiYScale::SCALE_100_PERCENT }) {
			GiTestScene scene(fixture.device());
			scene.add_box(Vector3(-2.03f, -1.51f, -1.77f), Vector3(2.11f, 1.43f, 1.91f), scene.add_material(Vector3(0.5f), Vector3(1.0f)), true);
			Sdfgi sdfgi(fixture.device());
			// 64 rays to emitters a record leave noise of 2.5 %, four times as many half of it.
			SdfgiSettings settings = small_settings(scale);
			settings.frames_to_converge = 32;
			run_sdfgi(fixture.device(), sdfgi, settings, scene.upload(), Vector3(0.0f), 200);
			const std::vector<Vector3> points = { { -2.03f, 0.1f, 0.2f }, { 2.11f, 0.1f, 0.2f }, { 0.1f, -1.51f, 0.2f }, { 0.1f, 1.43f, 0.2f }, { 0.1f, 0.2f, -1.77f }, { 0.1f, 0.2f, 1.91f } };
			const std::vector<Vector3> normals(std::begin(AXES), std::end(AXES));
			for (const Vector3 &value : gather_at(fixture.device(), sdfgi, points, normals)) {
				// The gathered value is without the point's own emission: incoming radiance everywhere is 2.
				CHECK(value.x == doctest::Approx(2.0f).epsilon(0.02));
			}
		}
	}

	TEST_CASE("a light that changes in every frame starves no probe") {
		GpuFixture fixture;
		GiTestScene scene(fixture.device());
		scene.add_box(Vector3(-0.55f), Vector3(0.55f), scene.add_material(Vector3(0.5f)));
		scene.set_sky(Vector3(1.0f), Vector3(1.0f));
		Sdfgi sdfgi(fixture.device());
		GiSceneView view = scene.upload();
		for (uint32_t frame = 0; frame < 12; frame++) {
			view.light_version++;
			run_sdfgi(fixture.device(), sdfgi, small_settings(SdfgiYScale::SCALE_100_PERCENT), view, Vector3(0.0f), 1);
		}
		// In the air beside the box, where probes alone answer: they see the sky but for what the box hides, and light from that.
		const std::vector<Vector3> points(6, Vector3(1.5f, 0.1f, 0.1f));
		const std::vector<Vector3> normals(std::begin(AXES), std::end(AXES));
		for (const Vector3 &value : gather_at(fixture.device(), sdfgi, points, normals)) {
			CHECK(value.x > 0.8f);
			CHECK(value.x < 1.01f);
		}
	}

	TEST_CASE("white furnace: probes of any resolution read a constant sky as 1") {
		GpuFixture fixture;
		for (const auto &[radiance, irradiance] : { std::pair(4u, 14u), std::pair(16u, 4u) }) {
			SdfgiSettings settings = small_settings(SdfgiYScale::SCALE_100_PERCENT);
			settings.probe_radiance_texels = radiance;
			settings.probe_irradiance_texels = irradiance;
			settings.probe_rays = 32; // more than 4 x 4 texels have room for
			GiTestScene scene(fixture.device());
			scene.add_box(Vector3(-0.55f), Vector3(0.55f), scene.add_material(Vector3(1.0f)));
			scene.set_sky(Vector3(1.0f), Vector3(1.0f));
			Sdfgi sdfgi(fixture.device());
			run_sdfgi(fixture.device(), sdfgi, settings, scene.upload(), Vector3(0.0f), 200);
			REQUIRE(sdfgi.stats().converged);
			const std::vector<Vector3> points(6, Vector3(1.5f, 0.1f, 0.1f)); // in the air, where probes alone answer
			for (const Vector3 &value : gather_at(fixture.device(), sdfgi, points, { std::begin(AXES), std::end(AXES) })) {
				CHECK(value.x == doctest::Approx(1.0f).epsilon(0.01));
			}
		}
	}

	TEST_CASE("fetches are counted by pass, and counting changes no light") {
		GpuFixture fixture;
		GiTestScene scene(fixture.device());
		scene.add_box(Vector3(-2.03f, -1.51f, -1.77f), Vector3(2.11f, 1.43f, 1.91f), scene.add_material(Vector3(0.5f), Vector3(1.0f)), true);
		const GiSceneView view = scene.upload();
		const std::vector<Vector3> points(6, Vector3(0.1f, 0.2f, 0.3f));
		std::vector<std::vector<Vector3>> light;
		std::vector<GiFetches> fetches;
		for (const bool counts : { false, true }) {
			SdfgiSettings settings = small_settings(SdfgiYScale::SCALE_100_PERCENT);
			settings.count_fetches = counts;
			Sdfgi sdfgi(fixture.device());
			run_sdfgi(fixture.device(), sdfgi, settings, view, Vector3(0.0f), 1);
			fetches = sdfgi.stats().fetches;
			CHECK(fetches.empty() == !counts);
			run_sdfgi(fixture.device(), sdfgi, settings, view, Vector3(0.0f), 200);
			// A frame at rest: the gather below is all that it counts.
			sdfgi.update(fixture.device().begin_frame(), settings, view, Vector3(0.0f));
			fixture.device().end_frame();
			light.push_back(gather_at(fixture.device(), sdfgi, points, { std::begin(AXES), std::end(AXES) }));
			sdfgi.after_frame();
			if (counts) {
				// At rest only the gather loads anything: each of the six pixels, which no record answers, its depth and normal twice.
				for (const GiFetches &pass : sdfgi.stats().fetches) {
					CHECK_MESSAGE((pass.fetches > 0) == pass.pass.starts_with("sdfgi.gather"), pass.pass);
				}
				CHECK(sdfgi.stats().fetches.back().fetches > 6 * 3);
			}
		}
		CHECK(light[0] == light[1]);
		for (const GiFetches &pass : fetches) {
			if (pass.pass == "sdfgi.light_lamps" || pass.pass.starts_with("sdfgi.gather")) {
				CHECK_MESSAGE(pass.fetches == 0, pass.pass);
			} else {
				CHECK_MESSAGE(pass.fetches > 0, pass.pass);
				CHECK_MESSAGE(pass.bytes >= 4 * pass.fetches, pass.pass);
			}
		}
	}

	// Shelves with twice as many surface cells as a cascade usually has room for.
	TEST_CASE("a scene of many surfaces gets a world with room for it") {
		GpuFixture fixture;
		GiTestScene scene(fixture.device());
		const uint32_t white = scene.add_material(Vector3(0.5f));
		for (int i = -4; i < 4; i++) {
			scene.add_box(Vector3(-1.5f, 0.37f * float(i), -1.5f), Vector3(1.5f, 0.37f * float(i) + 0.02f, 1.5f), white);
		}
		scene.set_sky(Vector3(1.0f), Vector3(1.0f));
		SdfgiSettings settings = small_settings(SdfgiYScale::SCALE_100_PERCENT);
		settings.cascades = 1;
		settings.grid_size_cells = 32;
		settings.min_cell_size_m = 0.1f;
		settings.frames_to_converge = 2;
		const GiSceneView view = scene.upload();
		Sdfgi sdfgi(fixture.device());
		run_sdfgi(fixture.device(), sdfgi, settings, view, Vector3(0.0f), 1);
		const uint64_t bytes = sdfgi.stats().bytes;
		run_sdfgi(fixture.device(), sdfgi, settings, view, Vector3(0.0f), 64);
		const GiStats stats = sdfgi.stats();
		CHECK(stats.bytes > bytes);
		CHECK(stats.surface_cells > 32 * 32 * 32 / 8);
		CHECK(stats.gather_rays[5] == 0); // no cell without memory
		CHECK(stats.gather_rays[1] > 0);
		// The top sees the sky alone; it was the last to get a place.
		CHECK(gather_at(fixture.device(), sdfgi, { { 0.3f, 1.13f, 0.3f } }, { { 0, 1, 0 } })[0].x == doctest::Approx(1.0f).epsilon(0.003));
	}

	TEST_CASE("opposite walls under a symmetric sky agree") {
		GpuFixture fixture;
		GiTestScene scene(fixture.device());
		scene.add_box(Vector3(-0.55f), Vector3(0.55f), scene.add_material(Vector3(0.5f)));
		scene.set_sky(Vector3(1.0f), Vector3(0.0f));
		Sdfgi sdfgi(fixture.device());
		run_sdfgi(fixture.device(), sdfgi, small_settings(SdfgiYScale::SCALE_75_PERCENT), scene.upload(), Vector3(0.0f), 64);
		std::vector<Vector3> points, normals(std::begin(AXES), std::end(AXES));
		for (const Vector3 &axis : AXES) {
			points.push_back(axis * 0.55f);
		}
		const std::vector<Vector3> values = gather_at(fixture.device(), sdfgi, points, normals);
		for (const int wall : { 0, 1, 4, 5 }) {
			CHECK(values[size_t(wall)].x == doctest::Approx(0.5f).epsilon(0.03));
		}
		CHECK(values[2].x == doctest::Approx(1.0f).epsilon(0.01));
		CHECK(values[3].x < 0.01f);
	}

	TEST_CASE("a sealed room beside a bright one stays exactly black behind a 5 cm wall") {
		GpuFixture fixture;
		for (const float offset : { 0.0f, 0.03f, 0.07f, 0.11f, 0.16f }) {
			GiTestScene scene(fixture.device());
			const uint32_t white = scene.add_material(Vector3(0.8f));
			const uint32_t lamp = scene.add_material(Vector3(0.8f), Vector3(50.0f));
			const float wall = offset;
			// Two rooms as one closed shell of boxes, 5 cm walls.
			scene.add_box(Vector3(wall, -1.0f, -1.2f), Vector3(wall + 0.05f, 1.0f, 1.2f), white);
			scene.add_box(Vector3(-2.2f, -1.05f, -1.2f), Vector3(2.2f, -1.0f, 1.2f), white);
			scene.add_box(Vector3(-2.2f, 1.0f, -1.2f), Vector3(2.2f, 1.05f, 1.2f), white);
			scene.add_box(Vector3(-2.2f, -1.0f, -1.25f), Vector3(2.2f, 1.0f, -1.2f), white);
			scene.add_box(Vector3(-2.2f, -1.0f, 1.2f), Vector3(2.2f, 1.0f, 1.25f), white);
			scene.add_box(Vector3(-2.25f, -1.0f, -1.2f), Vector3(-2.2f, 1.0f, 1.2f), white);
			scene.add_box(Vector3(2.2f, -1.0f, -1.2f), Vector3(2.25f, 1.0f, 1.2f), white);
			scene.add_box(Vector3(-1.2f, -0.2f, -0.2f), Vector3(-0.8f, 0.2f, 0.2f), lamp);
			Sdfgi sdfgi(fixture.device());
			run_sdfgi(fixture.device(), sdfgi, small_settings(SdfgiYScale::SCALE_75_PERCENT), scene.upload(), Vector3(0.0f), 32);
			const std::vector<Vector3> points = { { wall + 0.06f, -1.0f, 0.0f }, { wall + 0.05f, 0.0f, 0.3f }, { wall + 0.15f, 1.0f, 0.5f }, { 1.5f, -1.0f, 0.0f }, { 2.2f, 0.0f, 0.0f }, { 0.0f + wall, 0.0f, 0.0f } };
			const std::vector<Vector3> normals = { { 0, 1, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { -1, 0, 0 } };
			const std::vector<Vector3> values = gather_at(fixture.device(), sdfgi, points, normals);
			for (size_t i = 0; i + 1 < values.size(); i++) {
				CHECK(values[i] == Vector3(0.0f));
			}
			CHECK(values.back().x > 0.5f); // the lit side
		}
	}
}
