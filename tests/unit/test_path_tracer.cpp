// SPDX-License-Identifier: MIT
// Light transport against closed forms. Margins are 4 standard deviations: a right tracer fails once in 16,000 runs, and seeds are fixed.
#include "tests/unit/trace_test_scene.h"

using namespace lucent;
using namespace lucent::test;

namespace {

constexpr double PI = 3.14159265358979;

PathTracerSettings settings(uint32_t p_spp, uint32_t p_size = 8) {
	PathTracerSettings result;
	result.width = result.height = p_size;
	result.spp = p_spp;
	result.threads = 2;
	return result;
}

void check_estimate(const PathTracerResult &p_result, double p_truth, double p_max_margin) {
	const Estimate found = estimate(p_result);
	CHECK(std::abs(found.mean - p_truth) <= found.margin + 1e-5 * p_truth);
	CHECK(found.margin < p_max_margin);
}

} // namespace

TEST_CASE("path tracer: a white sphere under a white sky is invisible") {
	TraceTestScene test;
	test.set_sky_color(Vector3(1.0f));
	// Flat normals: smooth ones on a polyhedron lose what lies below its faces.
	MeshSurface sphere = TraceTestScene::sphere(0.4f, 16);
	sphere.normals.clear();
	test.add_mesh(sphere, TraceTestScene::lambertian(Vector3(1.0f)));
	test.scene.cameras.get(test.camera)->size_m = 1.0f;
	check_estimate(test.render(settings(16, 16)), 1.0, 1e-3);
}

TEST_CASE("path tracer: a closed room of albedo 0.5 and emission 1 reads 2") {
	TraceTestScene test;
	Material material = TraceTestScene::lambertian(Vector3(0.5f));
	material.emission = Vector3(1.0f);
	MeshSurface room = TraceTestScene::sphere(2.0f, 6, true);
	room.normals.clear();
	test.add_mesh(room, material);
	check_estimate(test.render(settings(256)), 2.0, 0.02);
}

TEST_CASE("path tracer: a square light over a floor follows the form factor") {
	TraceTestScene test;
	test.add_mesh(TraceTestScene::square(5.0f), TraceTestScene::lambertian(Vector3(0.5f)));
	Material light = TraceTestScene::lambertian(Vector3(0.0f));
	light.emission = Vector3(3.0f);
	test.add_mesh(TraceTestScene::square(0.5f), light, TraceTestScene::upside_down(Vector3(0, 1.0f, 0)));
	// Differential area to a parallel rectangle above its corner (Howell, A catalog of radiation configuration factors, B-3), four times.
	const double a = 0.5;
	const double factor = 4.0 / (2.0 * PI) * 2.0 * a / std::sqrt(1 + a * a) * std::atan(a / std::sqrt(1 + a * a));
	check_estimate(test.render(settings(256)), 0.5 * 3.0 * factor, 0.01);
}

TEST_CASE("path tracer: emission leaves from visible sides only") {
	for (const auto &[cull, expected] : { std::pair(MaterialCull::BACK, false), std::pair(MaterialCull::FRONT, true), std::pair(MaterialCull::DISABLED, true) }) {
		TraceTestScene test;
		test.add_mesh(TraceTestScene::square(5.0f), TraceTestScene::lambertian(Vector3(0.5f)));
		Material light = TraceTestScene::lambertian(Vector3(0.0f));
		light.emission = Vector3(3.0f);
		light.cull = cull;
		test.add_mesh(TraceTestScene::square(0.5f), light, { Basis(1.0f), Vector3(0, 1.0f, 0) });
		CHECK((estimate(test.render(settings(16))).mean > 0.1) == expected);
	}
}

TEST_CASE("path tracer: lamps have Godot's units and attenuation") {
	TraceTestScene test;
	test.add_mesh(TraceTestScene::square(5.0f), TraceTestScene::lambertian(Vector3(0.5f)));
	Light light;
	light.energy = 2.0f;
	light.shadow_enabled = true;

	SUBCASE("the sun reflects albedo * cos * energy") {
		light.type = LightType::DIRECTIONAL;
		light.angular_size_degrees = 0.5f;
		// Shines down by 60 degrees from the normal.
		const Vector3 back(std::sin(float(PI) / 3), std::cos(float(PI) / 3), 0);
		test.add_light(light, { Basis(Vector3(0, 0, 1), glm::cross(back, Vector3(0, 0, 1)), back), Vector3(0.0f) });
		CHECK(estimate(test.render(settings(16))).mean == doctest::Approx(0.5 * 0.5 * 2.0).epsilon(0.001));
	}
	SUBCASE("omni: inverse square within its range") {
		light.range_m = 10.0f;
		light.attenuation = 2.0f;
		for (float height : { 0.7f, 1.4f, 2.8f, 11.0f }) {
			const InstanceRid instance = test.add_light(light, { Basis(1.0f), Vector3(0, height, 0) });
			const double window = std::max(0.0, 1.0 - std::pow(height / 10.0, 4));
			CHECK(estimate(test.render(settings(1))).mean == doctest::Approx(0.5 * 2.0 * window * window / (height * height)).epsilon(0.001));
			test.scene.instances.free(instance);
		}
	}
	SUBCASE("omni of a size lights a floor far away as a point does") {
		light.range_m = 1000.0f;
		light.attenuation = 2.0f;
		light.size_m = 0.1f;
		test.add_light(light, { Basis(1.0f), Vector3(0, 2.0f, 0) });
		CHECK(estimate(test.render(settings(64))).mean == doctest::Approx(0.5 * 2.0 / 4.0).epsilon(0.005));
	}
	SUBCASE("spot: a cone with a soft rim") {
		light.type = LightType::SPOT;
		light.range_m = 1e6f;
		light.attenuation = 0.0f;
		light.spot_angle_degrees = 30.0f;
		for (float degrees : { 0.0f, 15.0f, 29.0f, 31.0f }) {
			const double angle = degrees * PI / 180.0;
			const Vector3 back(float(std::sin(angle)), float(std::cos(angle)), 0);
			const InstanceRid instance = test.add_light(light, { Basis(Vector3(0, 0, 1), glm::cross(back, Vector3(0, 0, 1)), back), Vector3(0, 1.0f, 0) });
			// Godot's: the exponent is the property's inverse.
			light.spot_attenuation = degrees == 15.0f ? 0.5f : 1.0f;
			test.scene.lights.get(test.scene.instances.get(instance)->light)->spot_attenuation = light.spot_attenuation;
			const double rim = std::pow(std::max(1e-4, (1 - std::cos(angle)) / (1 - std::cos(PI / 6))), 1.0 / light.spot_attenuation);
			CHECK(estimate(test.render(settings(4))).mean == doctest::Approx(0.5 * 2.0 * std::max(0.0, 1.0 - rim)).epsilon(0.01));
			test.scene.instances.free(instance);
		}
	}
	SUBCASE("a negative lamp takes light away") {
		light.type = LightType::DIRECTIONAL;
		const Transform3D down = { Basis(Vector3(1, 0, 0), Vector3(0, 0, -1), Vector3(0, 1, 0)), Vector3(0.0f) };
		test.add_light(light, down);
		light.negative = true;
		light.energy = 0.5f;
		test.add_light(light, down);
		check_estimate(test.render(settings(256)), 0.5 * 1.5, 0.05);
		light.energy = 5.0f;
		test.add_light(light, down);
		CHECK(estimate(test.render(settings(4))).mean == 0.0); // no more than there is
	}
}

TEST_CASE("path tracer: a lamp without shadows lights what is seen through walls, but no bounce") {
	TraceTestScene test;
	const Material white = TraceTestScene::lambertian(Vector3(0.5f));
	test.add_mesh(TraceTestScene::square(5.0f), white);
	test.add_mesh(TraceTestScene::square(5.0f), white, TraceTestScene::upside_down(Vector3(0, 3.0f, 0)));
	test.add_mesh(TraceTestScene::sphere(0.3f, 8), white, { Basis(1.0f), Vector3(0, 2.0f, 0) }); // around the lamp
	Light light;
	light.range_m = 100.0f;
	light.attenuation = 2.0f;
	light.energy = 2.0f;
	test.add_light(light, { Basis(1.0f), Vector3(0, 2.0f, 0) });
	PathTracerSettings run = settings(64);
	run.aov = true;
	const PathTracerResult result = test.render(run);
	for (size_t i = 0; i < result.direct.size(); i++) {
		CHECK(result.direct[i] == doctest::Approx(0.5 * 2.0 / 4.0).epsilon(0.01));
		CHECK(result.indirect[i] == 0.0f);
	}
}

TEST_CASE("path tracer: a scene far from the origin gives the same picture") {
	std::vector<float> pictures[2];
	for (int far = 0; far < 2; far++) {
		// Floats at 100 km are 1/128 m apart; all places are multiples of it, and the move one of the origin's step.
		const Vector3 shift = far ? Vector3(102400.0f, -51200.0f, 204800.0f) : Vector3(0.0f);
		TraceTestScene test;
		test.set_sky_color(Vector3(0.2f, 0.3f, 0.4f));
		test.add_mesh(TraceTestScene::square(1.0f), TraceTestScene::lambertian(Vector3(0.5f)), { Basis(1.0f), shift });
		Material glossy;
		glossy.roughness = 0.4f;
		test.add_mesh(TraceTestScene::sphere(0.1f, 8), glossy, { Basis(1.0f), shift + Vector3(0.125f, 0.125f, 0) });
		Material panel = TraceTestScene::lambertian(Vector3(0.0f));
		panel.emission = Vector3(4.0f);
		test.add_mesh(TraceTestScene::square(0.1f), panel, TraceTestScene::upside_down(shift + Vector3(0, 0.375f, 0.25f)));
		Light light;
		light.shadow_enabled = true;
		test.add_light(light, { Basis(1.0f), shift + Vector3(-0.5f, 0.5f, 0) });
		Camera &camera = *test.scene.cameras.get(test.camera);
		camera.size_m = 0.5f;
		camera.transform.origin += shift;
		pictures[far] = test.render(settings(16, 16)).radiance;
	}
	CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("path tracer: many lamps add up") {
	TraceTestScene test;
	test.add_mesh(TraceTestScene::square(50.0f), TraceTestScene::lambertian(Vector3(0.5f)));
	Light light;
	light.range_m = 1000.0f;
	light.attenuation = 2.0f;
	double expected = 0;
	for (int i = 0; i < 7; i++) {
		const Vector3 position(float(i) - 3.0f, 1.0f + 0.3f * float(i), 0.5f);
		light.energy = 1.0f + float(i % 3);
		test.add_light(light, { Basis(1.0f), position });
		const double distance = glm::length(position);
		expected += 0.5 * light.energy * position.y / distance / (distance * distance);
	}
	check_estimate(test.render(settings(256)), expected, 0.05);
}

TEST_CASE("path tracer: a big emissive sphere and a sky of its colour light alike") {
	for (float roughness : { 1.0f, 0.4f, 0.1f }) {
		Material material;
		material.albedo = Vector4(0.6f, 0.6f, 0.6f, 1.0f);
		material.metallic = 0.5f;
		material.roughness = roughness;
		Estimate found[2];
		for (int emissive = 0; emissive < 2; emissive++) {
			TraceTestScene test;
			MeshSurface ball = TraceTestScene::sphere(0.4f, 24);
			test.add_mesh(ball, material);
			test.scene.cameras.get(test.camera)->size_m = 0.5f;
			test.set_sky_color(Vector3(emissive ? 0.0f : 1.0f));
			if (emissive) {
				Material sky = TraceTestScene::lambertian(Vector3(0.0f));
				sky.emission = Vector3(1.0f);
				test.add_mesh(TraceTestScene::sphere(20.0f, 12, true), sky);
			}
			found[emissive] = estimate(test.render(settings(64, 16)));
		}
		CHECK(std::abs(found[0].mean - found[1].mean) < found[0].margin + found[1].margin);
		CHECK(found[1].margin < 0.02);
	}
}

TEST_CASE("path tracer: intervals hold the truth as often as they say") {
	TraceTestScene test;
	test.add_mesh(TraceTestScene::square(5.0f), TraceTestScene::lambertian(Vector3(0.5f)));
	Material light = TraceTestScene::lambertian(Vector3(0.0f));
	light.emission = Vector3(3.0f);
	test.add_mesh(TraceTestScene::square(0.5f), light, TraceTestScene::upside_down(Vector3(0, 1.0f, 0)));
	const double truth = estimate(test.render(settings(4096))).mean;
	int inside = 0;
	constexpr int RUNS = 400;
	for (int seed = 1; seed <= RUNS; seed++) {
		PathTracerSettings run = settings(64, 1);
		run.threads = 1;
		run.seed = uint32_t(seed);
		const Estimate found = estimate(test.render(run), 0, 1.96);
		inside += std::abs(found.mean - truth) <= found.margin;
	}
	// Binomial, 0.95 of 400: 380 +- 4.4
	CHECK(inside >= 360);
	CHECK(inside <= 397);
}

TEST_CASE("path tracer: the picture doesn't depend on threads, layers add up") {
	TraceTestScene test;
	test.set_sky_color(Vector3(0.2f, 0.3f, 0.4f));
	test.add_mesh(TraceTestScene::square(0.3f), TraceTestScene::lambertian(Vector3(0.5f)));
	Material glowing;
	glowing.emission = Vector3(1.0f, 0.5f, 0.0f);
	test.add_mesh(TraceTestScene::sphere(0.1f, 8), glowing, { Basis(1.0f), Vector3(0.1f, 0.1f, 0) });
	Light light;
	test.add_light(light, { Basis(1.0f), Vector3(0, 1, 0) });
	test.scene.cameras.get(test.camera)->size_m = 1.0f;
	PathTracerSettings one = settings(8, 40);
	one.threads = 1;
	one.aov = true;
	const PathTracerResult a = test.render(one);
	PathTracerSettings three = one;
	three.threads = 3;
	const PathTracerResult b = test.render(three);
	CHECK(a.radiance == b.radiance);
	CHECK(a.variance == b.variance);
	three.seed = 1;
	CHECK(a.radiance != test.render(three).radiance);
	double largest = 0;
	for (size_t i = 0; i < a.radiance.size(); i++) {
		largest = std::max(largest, std::abs(double(a.radiance[i]) - a.direct[i] - a.indirect[i] - a.emission[i] - a.background[i]));
	}
	CHECK(largest < 1e-5);
	const size_t middle = size_t(20 * 40 + 12); // floor beside the sphere
	CHECK(a.depth[middle] == doctest::Approx(0.5));
	CHECK(a.normal[3 * middle + 1] == doctest::Approx(1.0));
	CHECK(a.albedo[3 * middle] == doctest::Approx(0.5));
	CHECK(a.background[0] == doctest::Approx(0.2));
	CHECK(a.depth[0] == 0.0f);
}

TEST_CASE("path tracer: refuses what it can't do, and stops when told") {
	TraceTestScene test;
	CHECK_FALSE(PathTracer::create(test.scene, test.scenario, CameraRid()).ok());
	CHECK_FALSE(PathTracer::create(test.scene, ScenarioRid(), test.camera).ok());
	Result<std::unique_ptr<PathTracer>> tracer = PathTracer::create(test.scene, test.scenario, test.camera);
	REQUIRE(tracer.ok());
	PathTracerSettings wrong = settings(1);
	wrong.width = 0;
	CHECK_FALSE(tracer.value()->render(wrong).ok());
	wrong = settings(0);
	CHECK_FALSE(tracer.value()->render(wrong).ok());
	std::atomic<bool> cancel{ false };
	PathTracerSettings cancelled = settings(1000000);
	cancelled.cancel = &cancel;
	const Result<PathTracerResult> partial = tracer.value()->render(cancelled, [&](const PathTracerProgress &) { cancel = true; });
	REQUIRE(partial.ok());
	CHECK(partial.value().spp == 1);
	CHECK(partial.value().untraced_pixels == 0);
	const Result<PathTracerResult> none = tracer.value()->render(cancelled);
	REQUIRE(none.ok());
	CHECK(none.value().spp == 0);
	CHECK(none.value().untraced_pixels == 64);
	PathTracerSettings limited = settings(1 << 24);
	limited.time_limit_s = 0.2;
	const Result<PathTracerResult> timed = tracer.value()->render(limited);
	REQUIRE(timed.ok());
	CHECK(timed.value().seconds < 2.0);
	limited = settings(1 << 24, 256);
	limited.time_limit_s = 1e-6;
	const Result<PathTracerResult> hurried = tracer.value()->render(limited);
	REQUIRE(hurried.ok());
	CHECK(hurried.value().spp == 1);
}

TEST_CASE("path tracer: layers of many samples stay exact") {
	TraceTestScene test;
	test.add_mesh(TraceTestScene::square(5.0f), TraceTestScene::lambertian(Vector3(0.569f)));
	PathTracerSettings many = settings(1 << 18, 1); // floats' sums would be off by more than a percent
	many.threads = 1;
	many.aov = true;
	const PathTracerResult result = test.render(many);
	CHECK(result.spp == many.spp);
	CHECK(result.albedo[0] == doctest::Approx(0.569).epsilon(1e-5));
	CHECK(result.depth[0] == doctest::Approx(0.5).epsilon(1e-5));
}
