// SPDX-License-Identifier: MIT
// Frames against the path tracer on the same scene: one BRDF, one falloff, one rule for lamps.
#include "modules/reference/path_tracer.h"
#include "servers/rendering/rendering_server.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/unit/trace_test_scene.h"

#include <doctest/doctest.h>

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

void check_materials(SphereStage &r_stage, uint32_t p_spp) {
	for (const float metallic : { 0.0f, 1.0f }) {
		for (const float roughness : { 0.3f, 0.7f }) {
			for (const float albedo : { 0.05f, 0.8f }) {
				Material material;
				material.albedo = Vector4(Vector3(albedo), 1.0f);
				material.metallic = metallic;
				material.roughness = roughness;
				r_stage.server.material_set(r_stage.material, material);
				const Means means = compare(r_stage, p_spp);
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
	check_materials(stage, 16);
}

TEST_CASE_FIXTURE(GpuFixture, "lighting: dielectrics and metals under a white sky are the path tracer's within 1 %") {
	SphereStage stage(device());
	stage.set_sky(1.0f);
	check_materials(stage, 64);
}

TEST_SUITE_END();
