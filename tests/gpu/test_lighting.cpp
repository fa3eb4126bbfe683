// SPDX-License-Identifier: MIT
// Frames against the path tracer on the same scene: one BRDF, one falloff, one rule for lamps.
#include "modules/reference/path_tracer.h"
#include "servers/rendering/rendering_server.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/unit/trace_test_scene.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace lucent;
using lucent::test::GpuFixture;

namespace {
constexpr uint32_t SIZE = 64;

// A sphere of radius 1 around the origin that an orthogonal camera of 2 m looks at along -z.
struct SphereStage {
	RenderingServer server;
	ScenarioRid scenario;
	EnvironmentRid environment;
	MaterialRid material;
	CameraRid camera;
	ViewportRid viewport;

	explicit SphereStage(RenderingDevice &p_device) :
			server(&p_device) {
		scenario = server.scenario_create();
		environment = server.environment_create();
		server.environment_set_background(environment, BackgroundMode::COLOR);
		server.scenario_set_environment(scenario, environment);
		set_sky(0.0f);
		material = server.material_create();
		MeshSurface surface = test::TraceTestScene::sphere(1.0f, 64);
		surface.uvs.assign(surface.positions.size(), Vector2(0.0f));
		surface.material = material;
		const MeshRid mesh = server.mesh_create();
		server.mesh_add_surface(mesh, surface);
		add(mesh, {});
		camera = server.camera_create();
		Camera parameters;
		parameters.kind = Camera::Kind::ORTHOGONAL;
		parameters.size_m = 2.0f;
		parameters.transform.origin = Vector3(0, 0, 3);
		server.camera_set(camera, parameters);
		viewport = server.viewport_create();
		server.viewport_set_size(viewport, SIZE, SIZE);
		server.viewport_set_scenario(viewport, scenario);
		server.viewport_attach_camera(viewport, camera);
	}
	template <typename T>
	InstanceRid add(T p_base, const Transform3D &p_transform) {
		const InstanceRid instance = server.instance_create();
		server.instance_set_base(instance, p_base);
		server.instance_set_scenario(instance, scenario);
		server.instance_set_transform(instance, p_transform);
		return instance;
	}
	void set_sky(float p_radiance) {
		server.environment_set_bg_color(environment, Vector3(p_radiance));
		server.environment_set_ambient_light(environment, Vector3(0.0f), p_radiance > 0.0f ? AmbientSource::BACKGROUND : AmbientSource::DISABLED, 1.0f, 1.0f);
	}
	void add_light(LightRid p_light, const Light &p_parameters, const Transform3D &p_transform) {
		server.light_set(p_light, p_parameters);
		add(p_light, p_transform);
	}
};

// Means over the sphere, but for its last 3 % of radius; the truth's with its interval at four standard deviations.
struct Means {
	double drawn = 0, truth = 0, margin = 0;
};

Means compare(SphereStage &r_stage, uint32_t p_spp) {
	r_stage.server.draw();
	const ViewportImage drawn = r_stage.server.viewport_get_image(r_stage.viewport, ViewportBuffer::COLOR_LINEAR);
	Result<std::unique_ptr<PathTracer>> tracer = PathTracer::create(r_stage.server.scenario_snapshot(), r_stage.scenario, r_stage.camera);
	REQUIRE(tracer.ok());
	PathTracerSettings settings;
	settings.width = settings.height = SIZE;
	settings.spp = p_spp;
	Result<PathTracerResult> truth = tracer.value()->render(settings);
	REQUIRE(truth.ok());
	Means means;
	double variance = 0, count = 0;
	for (uint32_t y = 0; y < SIZE; y++) {
		for (uint32_t x = 0; x < SIZE; x++) {
			const Vector2 place = (Vector2(float(x), float(y)) + 0.5f) * (2.0f / SIZE) - 1.0f;
			if (glm::length(place) > 0.97f) {
				continue;
			}
			const size_t i = 3 * (size_t(y) * SIZE + x);
			means.drawn += drawn.values[i];
			means.truth += truth.value().radiance[i];
			variance += truth.value().variance[i];
			count++;
		}
	}
	means.drawn /= count;
	means.truth /= count;
	means.margin = 4.0 * std::sqrt(variance) / count;
	return means;
}

// A highlight is noise to the truth: metals may need more samples than surfaces that are mostly diffuse.
void check_materials(SphereStage &r_stage, uint32_t p_spp, uint32_t p_metal_spp) {
	for (const float metallic : { 0.0f, 1.0f }) {
		for (const float roughness : { 0.3f, 0.7f }) {
			for (const float albedo : { 0.05f, 0.8f }) {
				if (metallic > 0.0f && albedo < 0.5f) {
					continue; // a metal's light is nearly proportional to it
				}
				Material material;
				material.albedo = Vector4(Vector3(albedo), 1.0f);
				material.metallic = metallic;
				material.roughness = roughness;
				r_stage.server.material_set(r_stage.material, material);
				const Means means = compare(r_stage, metallic > 0.0f ? p_metal_spp : p_spp);
				CAPTURE(metallic);
				CAPTURE(roughness);
				CAPTURE(albedo);
				CAPTURE(means.truth);
				MESSAGE("metallic " << metallic << " roughness " << roughness << " albedo " << albedo << ": " << means.drawn / means.truth << " +- " << means.margin / means.truth);
				REQUIRE(means.margin < 0.004 * means.truth);
				CHECK(means.drawn == doctest::Approx(means.truth).epsilon(0.01));
			}
		}
	}
}
} // namespace

TEST_SUITE_BEGIN("gpu");

TEST_CASE_FIXTURE(GpuFixture, "lighting: dielectrics and metals under a lamp are the path tracer's within 1 %") {
	SphereStage stage(device());
	Light light;
	light.range_m = 20.0f;
	light.attenuation = 2.0f;
	light.energy = 10.0f;
	stage.add_light(stage.server.omni_light_create(), light, { Basis(1.0f), Vector3(1.5f, 2.0f, 3.0f) });
	check_materials(stage, 192, 1024);
}

TEST_CASE_FIXTURE(GpuFixture, "lighting: dielectrics and metals under a white sky are the path tracer's within 1 %") {
	SphereStage stage(device());
	stage.set_sky(1.0f);
	check_materials(stage, 192, 192);
}

TEST_CASE_FIXTURE(GpuFixture, "lighting: a spot's cone and its highlight are the path tracer's within 1 %") {
	SphereStage stage(device());
	Material material;
	material.albedo = Vector4(Vector3(0.3f), 1.0f);
	material.roughness = 0.5f;
	stage.server.material_set(stage.material, material);
	Light light;
	light.range_m = 4.0f;
	light.energy = 10.0f;
	light.specular = 0.5f;
	light.spot_angle_degrees = 18.0f;
	light.spot_attenuation = 0.4f;
	const LightRid rid = stage.server.spot_light_create();
	stage.add_light(rid, light, { Basis(1.0f), Vector3(0.2f, 0.1f, 3.0f) });
	const Means means = compare(stage, 64);
	CHECK(means.margin < 0.004 * means.truth);
	CHECK(means.drawn == doctest::Approx(means.truth).epsilon(0.01));
	light.specular = 0.0f;
	stage.server.light_set(rid, light);
	const Means matt = compare(stage, 64);
	CHECK(matt.drawn < 0.98 * means.drawn); // the highlight is worth comparing
	CHECK(matt.drawn == doctest::Approx(matt.truth).epsilon(0.01));
}

namespace {
// Two rooms of 2 x 2 x 2 m, a wall of 0.25 m between them; the camera is in the one of x < 0.
struct Rooms {
	RenderingServer server;
	ScenarioRid scenario;
	MaterialRid material;
	CameraRid camera;
	ViewportRid viewport;
	static constexpr uint32_t WIDTH = 48, HEIGHT = 32;

	explicit Rooms(RenderingDevice &p_device) :
			server(&p_device) {
		scenario = server.scenario_create();
		const EnvironmentRid environment = server.environment_create();
		SdfgiSettings settings;
		settings.enabled = true;
		settings.cascades = 1;
		settings.grid_size_cells = 64;
		settings.min_cell_size_m = 0.125f;
		settings.frames_to_converge = 4;
		server.environment_set_sdfgi(environment, settings);
		server.environment_set_background(environment, BackgroundMode::COLOR);
		server.environment_set_bg_color(environment, Vector3(0.0f));
		server.environment_set_ambient_light(environment, Vector3(0.0f), AmbientSource::DISABLED, 1.0f, 1.0f);
		server.scenario_set_environment(scenario, environment);
		material = server.material_create();
		server.material_set(material, test::TraceTestScene::lambertian(Vector3(0.6f)));
		add_box(Vector3(0.0f), Vector3(0.125f, 1.0f, 1.0f)); // between the rooms
		for (int axis = 0; axis < 3; axis++) {
			for (const float side : { -1.0f, 1.0f }) {
				const Vector3 half(2.125f, 1.0f, 1.0f);
				Vector3 center(0.0f), size = half + 0.25f;
				center[axis] = side * (half[axis] + 0.125f);
				size[axis] = 0.125f;
				add_box(center, size);
			}
		}
		camera = server.camera_create();
		Camera parameters;
		parameters.fov_degrees = 75.0f;
		parameters.transform = { Basis(1.0f), Vector3(-1.1f, 0.0f, 0.9f) };
		server.camera_set(camera, parameters);
		viewport = server.viewport_create();
		server.viewport_set_size(viewport, WIDTH, HEIGHT);
		server.viewport_set_aov(viewport, true);
		server.viewport_set_scenario(viewport, scenario);
		server.viewport_attach_camera(viewport, camera);
	}
	template <typename T>
	void add(T p_base, const Transform3D &p_transform) {
		const InstanceRid instance = server.instance_create();
		server.instance_set_base(instance, p_base);
		server.instance_set_scenario(instance, scenario);
		server.instance_set_transform(instance, p_transform);
	}
	void add_box(const Vector3 &p_center, const Vector3 &p_half) {
		MeshSurface surface;
		for (int axis = 0; axis < 3; axis++) {
			for (const float side : { 1.0f, -1.0f }) {
				Vector3 normal(0.0f), u(0.0f), v(0.0f);
				normal[axis] = side;
				u[(axis + 1) % 3] = side;
				v[(axis + 2) % 3] = 1.0f;
				const uint32_t first = uint32_t(surface.positions.size());
				for (const Vector3 &corner : { normal - u - v, normal + u - v, normal + u + v, normal - u + v }) {
					surface.positions.push_back(corner * p_half);
					surface.normals.push_back(normal);
					surface.uvs.push_back(Vector2(0.0f));
				}
				for (const uint32_t i : { 0u, 1u, 2u, 0u, 2u, 3u }) {
					surface.indices.push_back(first + i);
				}
			}
		}
		surface.material = material;
		const MeshRid mesh = server.mesh_create();
		server.mesh_add_surface(mesh, surface);
		add(mesh, { Basis(1.0f), p_center });
	}
	LightRid add_lamp(const Vector3 &p_position, float p_energy, bool p_negative, bool p_shadow) {
		Light light;
		light.range_m = 6.0f;
		light.energy = p_energy;
		light.negative = p_negative;
		light.shadow_enabled = p_shadow;
		const LightRid rid = server.omni_light_create();
		server.light_set(rid, light);
		add(rid, { Basis(1.0f), p_position });
		return rid;
	}
};

struct RoomLight {
	double direct = 0, indirect = 0, color = 0; // means of the frame
	double least = 0; // of all values of the frame's colour
	double true_direct = 0, true_indirect = 0, true_color = 0, true_least = 0;
};

RoomLight light_of(Rooms &r_rooms, uint32_t p_spp) {
	for (int frame = 0; frame < 60; frame++) {
		r_rooms.server.draw();
		if (frame > 2 && r_rooms.server.get_frame_stats().gi.converged) {
			break;
		}
	}
	Result<std::unique_ptr<PathTracer>> tracer = PathTracer::create(r_rooms.server.scenario_snapshot(), r_rooms.scenario, r_rooms.camera);
	REQUIRE(tracer.ok());
	PathTracerSettings settings;
	settings.width = Rooms::WIDTH;
	settings.height = Rooms::HEIGHT;
	settings.spp = p_spp;
	settings.aov = true;
	const Result<PathTracerResult> truth = tracer.value()->render(settings);
	REQUIRE(truth.ok());
	CHECK(truth.value().bad_samples == 0);
	const auto mean = [](const std::vector<float> &p_values) {
		double sum = 0.0;
		for (const float value : p_values) {
			REQUIRE(std::isfinite(value));
			sum += value;
		}
		return sum / double(p_values.size());
	};
	const auto image = [&](ViewportBuffer p_buffer) { return r_rooms.server.viewport_get_image(r_rooms.viewport, p_buffer).values; };
	RoomLight light;
	const std::vector<float> color = image(ViewportBuffer::COLOR_LINEAR);
	light.color = mean(color);
	light.least = *std::min_element(color.begin(), color.end());
	light.direct = mean(image(ViewportBuffer::DIRECT));
	light.indirect = mean(image(ViewportBuffer::INDIRECT_DIFFUSE));
	light.true_color = mean(truth.value().radiance);
	light.true_least = *std::min_element(truth.value().radiance.begin(), truth.value().radiance.end());
	light.true_direct = mean(truth.value().direct);
	light.true_indirect = mean(truth.value().indirect);
	MESSAGE("direct " << light.direct << " (" << light.true_direct << "), indirect " << light.indirect << " (" << light.true_indirect << "), sum " << light.color << " (" << light.true_color << "), least " << light.least);
	return light;
}
} // namespace

TEST_CASE_FIXTURE(GpuFixture, "lighting: a lamp without shadows shines through walls, but not what it lights behind them") {
	Rooms rooms(device());
	rooms.add_lamp(Vector3(1.1f, 0.2f, 0.1f), 3.0f, false, false);
	const RoomLight light = light_of(rooms, 16);
	CHECK(light.direct > 0.05);
	CHECK(light.direct == doctest::Approx(light.true_direct).epsilon(0.02));
	CHECK(light.indirect == 0.0);
	CHECK(light.true_indirect == 0.0);
}

TEST_CASE_FIXTURE(GpuFixture, "lighting: negative lamps take light away by one rule, and never more than there is") {
	Rooms rooms(device());
	rooms.add_lamp(Vector3(-1.6f, 0.5f, 0.3f), 4.0f, false, false);
	const LightRid lamp = rooms.add_lamp(Vector3(-0.6f, -0.4f, -0.4f), 1.0f, true, false);
	const RoomLight weak = light_of(rooms, 256);
	CHECK(weak.direct == doctest::Approx(weak.true_direct).epsilon(0.02));
	CHECK(weak.indirect == doctest::Approx(weak.true_indirect).epsilon(0.05));
	Light strong = *rooms.server.scenario_snapshot().lights.get(lamp);
	strong.energy = 3.0f;
	rooms.server.light_set(lamp, strong);
	const RoomLight dark = light_of(rooms, 256);
	CHECK(dark.direct == doctest::Approx(dark.true_direct).epsilon(0.05));
	CHECK(dark.indirect == doctest::Approx(dark.true_indirect).epsilon(0.1));
	CHECK(dark.color == doctest::Approx(dark.true_color).epsilon(0.05));
	CHECK(dark.color > dark.direct + dark.indirect); // where they would be below 0, pixels are 0
	CHECK(dark.least == 0.0);
	CHECK(dark.true_least == 0.0);
}

TEST_SUITE_END();
