// SPDX-License-Identifier: MIT
// What must not change when the scene is told differently, and what must change in proportion: true on any driver.
#include "tests/gpu/gi_test_scene.h"
#include "tests/gpu/gpu_fixture.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace lucent;
using lucent::test::GpuFixture;

namespace {

struct Telling {
	int turn = 0; // axes: x y z become y z x so many times
	float emission = 1.0f;
	bool panel = true;
	bool lamps[2] = { false, false };
	uint32_t copies = 1; // of each lamp, which share its light
	uint32_t ray_cache_mib = 96;
	GiTestOrder order;
};

SdfgiSettings metamorphic_settings(const Telling &p_telling, uint32_t p_turns) {
	SdfgiSettings settings;
	settings.enabled = true;
	settings.cascades = 2;
	settings.grid_size_cells = 64;
	settings.min_cell_size_m = 0.25f; // all sizes are exact
	settings.y_scale = SdfgiYScale::SCALE_100_PERCENT;
	settings.frames_to_converge = p_turns;
	settings.ray_cache_mib = p_telling.ray_cache_mib;
	return settings;
}

// What holds for settled light holds on the way. Means of other random numbers need more rays than bits or sums do.
constexpr uint32_t FRAMES = 10;
constexpr uint32_t FEW_TURNS = 4;
constexpr uint32_t TURNS = 16;

struct Place {
	const Telling &telling;
	Vector3 direction(Vector3 p_vector) const {
		for (int i = 0; i < telling.turn; i++) {
			p_vector = Vector3(p_vector.z, p_vector.x, p_vector.y);
		}
		return p_vector;
	}
};

// A room of 5 x 3 x 4 m with an opening to the sky, a pillar, a red wall panel and a lamp panel below the ceiling.
GiSceneView build(GiTestScene &r_scene, const Telling &p_telling) {
	const Place place = { p_telling };
	const auto box = [&](const Vector3 &p_min, const Vector3 &p_max, uint32_t p_material) {
		const Vector3 a = place.direction(p_min), b = place.direction(p_max);
		r_scene.add_box(glm::min(a, b), glm::max(a, b), p_material);
	};
	const uint32_t white = r_scene.add_material(Vector3(0.75f));
	const uint32_t red = r_scene.add_material(Vector3(0.75f, 0.25f, 0.125f));
	const uint32_t lamp = r_scene.add_material(Vector3(0.5f), Vector3(16.0f, 12.0f, 8.0f) * (p_telling.panel ? p_telling.emission : 0.0f));
	const float t = 0.25f;
	box({ -2.5f - t, -1.5f - t, -2.0f - t }, { 2.5f + t, -1.5f, 2.0f + t }, white);
	box({ -2.5f - t, 1.5f, -2.0f - t }, { 2.5f + t, 1.5f + t, 2.0f + t }, white);
	box({ -2.5f - t, -1.5f, -2.0f }, { -2.5f, 1.5f, 2.0f }, red);
	box({ 2.5f, -1.5f, -2.0f }, { 2.5f + t, 1.5f, 1.0f }, white);
	box({ -2.5f - t, -1.5f, -2.0f - t }, { 2.5f + t, 1.5f, -2.0f }, white);
	box({ -2.5f - t, -1.5f, 2.0f }, { 2.5f + t, 1.5f, 2.0f + t }, white);
	box({ -0.5f, -1.5f, -0.75f }, { 0.0f, 0.5f, -0.25f }, white);
	box({ -1.5f, 1.25f, 0.25f }, { -0.5f, 1.375f, 1.25f }, lamp);
	for (int i = 0; i < 2; i++) {
		shader::LightData light{};
		light.position = place.direction(i == 0 ? Vector3(1.5f, 0.5f, 0.5f) : Vector3(-1.5f, -0.5f, -1.0f));
		light.range = 8.0f;
		light.attenuation = 2.0f;
		light.color = (i == 0 ? Vector3(1.0f, 0.75f, 0.5f) : Vector3(0.5f, 1.0f, 0.75f)) * p_telling.emission;
		light.indirect_energy = 1.0f;
		light.type = LIGHT_TYPE_OMNI;
		light.flags = LIGHT_FLAG_GI;
		light.shadow_index = -1;
		light.color /= float(p_telling.copies);
		for (uint32_t k = 0; k < p_telling.copies && p_telling.lamps[i]; k++) {
			r_scene.add_light(light);
		}
	}
	if (p_telling.panel) {
		r_scene.set_sky(Vector3(0.5f, 0.75f, 1.0f) * p_telling.emission, Vector3(0.5f, 0.75f, 1.0f) * p_telling.emission);
	}
	return r_scene.upload(p_telling.order);
}

// What points on floor, ceiling, walls and pillar get.
std::vector<Vector3> light_of(RenderingDevice &p_device, const Telling &p_telling, uint32_t p_turns = FEW_TURNS, uint32_t p_frames = FRAMES) {
	GiTestScene scene(p_device);
	Sdfgi sdfgi(p_device);
	const GiSceneView view = build(scene, p_telling);
	const Place place = { p_telling };
	run_sdfgi(p_device, sdfgi, metamorphic_settings(p_telling, p_turns), view, place.direction(Vector3(0.25f, 0.125f, 0.375f)), p_frames < FRAMES ? p_frames : p_turns + p_frames);
	std::vector<Vector3> points, normals;
	// Many, for each surface cell has noise of its own; none in the pillar, above the lamp or in the opening.
	constexpr float ROWS[][4] = { { -1.3125f, -0.0625f, 0.6875f, 1.6875f }, { -1.3125f, -0.4375f, -0.0625f, 1.6875f }, { -1.0625f, -0.3125f, 0.1875f, 0.9375f }, { -1.3125f, -0.5625f, 0.4375f, 1.3125f }, { -1.3125f, -0.5625f, 0.1875f, 0.6875f } };
	for (float a = -1.8125f; a < 2.0f; a += 0.5f) {
		for (int i = 0; i < 4; i++) {
			points.insert(points.end(), { { a, -1.5f, ROWS[0][i] }, { a, 1.5f, ROWS[1][i] }, { a, ROWS[2][i], -2.0f }, { -2.5f, a * 0.75f, ROWS[3][i] }, { 2.5f, a * 0.75f, ROWS[4][i] } });
			normals.insert(normals.end(), { { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { -1, 0, 0 } });
		}
	}
	points.insert(points.end(), { { -0.25f, 0.5f, -0.5f }, { 0.0f, -0.5f, -0.5f } });
	normals.insert(normals.end(), { { 0, 1, 0 }, { 1, 0, 0 } });
	for (size_t i = 0; i < points.size(); i++) {
		points[i] = place.direction(points[i]);
		normals[i] = place.direction(normals[i]);
	}
	return gather_at(p_device, sdfgi, points, normals);
}

struct Difference {
	size_t other_bits = 0; // values that differ at all
	double largest = 0.0; // |a - b|, over the mean of a
	double mean = 0.0; // mean of b over the mean of a, minus 1

	std::string text() const { return fmt::format("{} values differ, the largest by {} of the mean, the means by {}", other_bits, largest, mean); }
};

Difference difference(const std::vector<Vector3> &p_a, const std::vector<Vector3> &p_b) {
	Difference result;
	double sum_a = 0.0, sum_b = 0.0, largest = 0.0;
	for (size_t i = 0; i < p_a.size(); i++) {
		for (int k = 0; k < 3; k++) {
			result.other_bits += std::memcmp(&p_a[i][k], &p_b[i][k], 4) != 0 ? 1 : 0;
			largest = std::max(largest, double(std::abs(p_a[i][k] - p_b[i][k])));
			sum_a += p_a[i][k];
			sum_b += p_b[i][k];
		}
	}
	result.largest = largest / (sum_a / double(3 * p_a.size()));
	result.mean = sum_b / sum_a - 1.0;
	return result;
}

} // namespace

TEST_SUITE_BEGIN("gpu");

TEST_CASE("metamorphic: order of triangles and surfaces, meshes split in two: the same bits") {
	GpuFixture fixture;
	Telling telling;
	telling.lamps[0] = true;
	const std::vector<Vector3> before = light_of(fixture.device(), telling);
	REQUIRE(before[0].x > 0.0f);
	for (const GiTestOrder &order : { GiTestOrder{}, GiTestOrder{ .reversed = true, .split = false }, GiTestOrder{ .reversed = false, .split = true } }) {
		telling.order = order;
		const Difference found = difference(before, light_of(fixture.device(), telling));
		CHECK_MESSAGE(found.other_bits == 0, found.text());
	}
}

TEST_CASE("metamorphic: axes swapped at y scale 100 %") {
	GpuFixture fixture;
	Telling telling;
	telling.lamps[0] = true;
	const std::vector<Vector3> before = light_of(fixture.device(), telling, TURNS);
	for (telling.turn = 1; telling.turn < 3; telling.turn++) {
		// Other random numbers: a cell's come from its coordinates.
		const Difference found = difference(before, light_of(fixture.device(), telling, TURNS));
		CHECK_MESSAGE(std::abs(found.mean) < 0.01, found.text());
	}
}

TEST_CASE("metamorphic: a lamp told as nine, light after two frames") {
	GpuFixture fixture;
	Telling telling;
	telling.panel = false;
	telling.lamps[0] = true;
	const std::vector<Vector3> before = light_of(fixture.device(), telling, FEW_TURNS, 2);
	telling.copies = 9; // more than a record has lanes
	const Difference found = difference(before, light_of(fixture.device(), telling, FEW_TURNS, 2));
	CHECK_MESSAGE(std::abs(found.mean) < 0.02, found.text());
}

TEST_CASE("metamorphic: a ray cache too small for the set of rays makes noise, not less light") {
	GpuFixture fixture;
	Telling telling;
	telling.lamps[0] = true;
	const std::vector<Vector3> before = light_of(fixture.device(), telling, TURNS);
	telling.ray_cache_mib = 1;
	const Difference found = difference(before, light_of(fixture.device(), telling, TURNS));
	CHECK(found.other_bits > 0);
	CHECK_MESSAGE(std::abs(found.mean) < 0.03, found.text());
}

TEST_CASE("metamorphic: twice the emission is twice the light") {
	GpuFixture fixture;
	Telling telling;
	telling.lamps[0] = true;
	std::vector<Vector3> before = light_of(fixture.device(), telling);
	telling.emission = 2.0f;
	const std::vector<Vector3> after = light_of(fixture.device(), telling);
	for (Vector3 &value : before) {
		value *= 2.0f;
	}
	// Records add emission up in fixed point.
	const Difference found = difference(before, after);
	CHECK_MESSAGE(found.largest < 0.001, found.text());
}

TEST_CASE("metamorphic: two lamps give the sum of each alone") {
	GpuFixture fixture;
	std::vector<Vector3> sum, both;
	for (int i = 0; i < 3; i++) {
		Telling telling;
		telling.panel = false;
		telling.lamps[0] = i != 1;
		telling.lamps[1] = i != 0;
		const std::vector<Vector3> values = light_of(fixture.device(), telling);
		sum.resize(values.size(), Vector3(0.0f));
		for (size_t k = 0; k < values.size() && i < 2; k++) {
			sum[k] += values[k];
		}
		both = values;
	}
	const Difference found = difference(sum, both);
	CHECK_MESSAGE(found.largest < 0.01, found.text());
}

TEST_SUITE_END();
