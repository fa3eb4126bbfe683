// SPDX-License-Identifier: MIT
// Whole frames with known radiance, through the RenderingServer.
#include "drivers/vulkan/vulkan_driver.h"
#include "servers/rendering/device/rendering_device.h"
#include "servers/rendering/rendering_server.h"
#include "tests/test_support.h"

#include <doctest/doctest.h>

using namespace lucent;

namespace {
constexpr uint32_t SIZE = 64;

MeshSurface quad(float p_half, MaterialRid p_material) {
	MeshSurface surface;
	surface.positions = { Vector3(-p_half, 0, p_half), Vector3(p_half, 0, p_half), Vector3(p_half, 0, -p_half), Vector3(-p_half, 0, -p_half) };
	surface.normals.assign(4, Vector3(0, 1, 0));
	surface.uvs = { Vector2(0, 1), Vector2(1, 1), Vector2(1, 0), Vector2(0, 0) };
	surface.indices = { 0, 1, 2, 0, 2, 3 };
	surface.material = p_material;
	return surface;
}

Material lambertian(float p_albedo) {
	Material material;
	material.albedo = Vector4(Vector3(p_albedo), 1.0f);
	material.specular = 0.0f;
	return material;
}

Transform3D looking_down(const Vector3 &p_origin) {
	return { Basis(Vector3(1, 0, 0), Vector3(0, 0, -1), Vector3(0, 1, 0)), p_origin };
}

// One for all cases: its pipelines are compiled once.
RenderingDevice &test_device() {
	static const std::unique_ptr<RenderingDevice> device = [] {
		Result<std::unique_ptr<RenderingDeviceDriver>> driver = create_vulkan_driver({ test::options().device, true });
		REQUIRE_MESSAGE(driver.ok(), driver.error().message);
		Result<std::unique_ptr<RenderingDevice>> created = RenderingDevice::create(driver.take());
		REQUIRE_MESSAGE(created.ok(), created.error().message);
		return created.take();
	}();
	return *device;
}

// A floor of 4 m, seen from 3 m above; the camera's up is -z.
struct Stage {
	std::unique_ptr<RenderingServer> server;
	ScenarioRid scenario;
	EnvironmentRid environment;
	MaterialRid floor_material;
	ViewportRid viewport;
	CameraRid camera;

	Stage() {
		server = std::make_unique<RenderingServer>(&test_device());
		scenario = server->scenario_create();
		environment = server->environment_create();
		server->environment_set_background(environment, BackgroundMode::COLOR);
		server->environment_set_ambient_light(environment, Vector3(0.0f), AmbientSource::DISABLED, 1.0f, 1.0f);
		server->scenario_set_environment(scenario, environment);
		floor_material = server->material_create();
		server->material_set(floor_material, lambertian(0.5f));
		add_quad(2.0f, floor_material, Transform3D());
		camera = server->camera_create();
		Camera parameters;
		parameters.fov_degrees = 60.0f;
		parameters.transform = looking_down(Vector3(0, 3, 0));
		server->camera_set(camera, parameters);
		viewport = server->viewport_create();
		server->viewport_set_size(viewport, SIZE, SIZE);
		server->viewport_set_scenario(viewport, scenario);
		server->viewport_attach_camera(viewport, camera);
	}
	InstanceRid add_quad(float p_half, MaterialRid p_material, const Transform3D &p_transform) {
		const MeshRid mesh = server->mesh_create();
		server->mesh_add_surface(mesh, quad(p_half, p_material));
		const InstanceRid instance = server->instance_create();
		server->instance_set_base(instance, mesh);
		server->instance_set_scenario(instance, scenario);
		server->instance_set_transform(instance, p_transform);
		return instance;
	}
	void add_light(LightRid p_light, const Light &p_parameters, const Transform3D &p_transform) {
		server->light_set(p_light, p_parameters);
		const InstanceRid instance = server->instance_create();
		server->instance_set_base(instance, p_light);
		server->instance_set_scenario(instance, scenario);
		server->instance_set_transform(instance, p_transform);
	}
	void add_sun(bool p_shadow) {
		Light light;
		light.energy = 2.0f;
		light.shadow_enabled = p_shadow;
		add_light(server->directional_light_create(), light, looking_down(Vector3(0.0f)));
	}
	ViewportImage draw(ViewportBuffer p_buffer = ViewportBuffer::COLOR_LINEAR) {
		server->draw();
		return server->viewport_get_image(viewport, p_buffer);
	}
};

Vector3 pixel(const ViewportImage &p_image, float p_u, float p_v) {
	const size_t index = size_t(p_v * float(p_image.height)) * p_image.width + size_t(p_u * float(p_image.width));
	return Vector3(p_image.values[index * 3], p_image.values[index * 3 + 1], p_image.values[index * 3 + 2]);
}
} // namespace

TEST_SUITE_BEGIN("gpu");

TEST_CASE("frame: a sun of energy 2 on albedo 0.5 gives 1, the background its colour") {
	Stage stage;
	stage.add_sun(false);
	stage.server->environment_set_bg_color(stage.environment, Vector3(0.25f, 0.5f, 0.75f));
	const ViewportImage image = stage.draw();
	CHECK(pixel(image, 0.5f, 0.5f).x == doctest::Approx(1.0f).epsilon(0.002));
	stage.server->camera_set_transform(stage.camera, Transform3D{ Basis(1.0f), Vector3(0, 3, 0) });
	const Vector3 sky = pixel(stage.draw(), 0.5f, 0.1f);
	CHECK(sky.x == doctest::Approx(0.25f));
	CHECK(sky.z == doctest::Approx(0.75f));
}

TEST_CASE("frame: omni and spot lights attenuate as documented") {
	Stage stage;
	Light light;
	light.range_m = 4.0f;
	light.energy = 3.0f;
	stage.add_light(stage.server->omni_light_create(), light, looking_down(Vector3(0, 2, 0)));
	const float window = 1.0f - std::pow(2.0f / 4.0f, 4.0f);
	const float expected = 0.5f * 3.0f * window * window / 2.0f;
	CHECK(pixel(stage.draw(), 0.5f, 0.5f).x == doctest::Approx(expected).epsilon(0.01));
	light.spot_angle_degrees = 20.0f;
	stage.add_light(stage.server->spot_light_create(), light, looking_down(Vector3(0, 2, 0)));
	const ViewportImage image = stage.draw();
	// At the axis Godot's rim of 1e-4 is left of the cone's falloff.
	CHECK(pixel(image, 0.5f, 0.5f).x == doctest::Approx(expected * 2.0f).epsilon(0.01));
	// 1.3 m off the axis is outside of the cone: only the omni light.
	const float distance = std::sqrt(4.0f + 1.3f * 1.3f);
	const float omni_window = 1.0f - std::pow(distance / 4.0f, 4.0f);
	const float u = 0.5f + 0.5f * 1.3f / (3.0f * std::tan(glm::radians(30.0f)));
	CHECK(pixel(image, u, 0.5f).x == doctest::Approx(0.5f * 3.0f * omni_window * omni_window / distance * 2.0f / distance).epsilon(0.05));
}

TEST_CASE("frame: sun, omni and spot shadows fall under a panel and nowhere else") {
	for (int type = 0; type < 3; type++) {
		CAPTURE(type);
		Stage stage;
		Light light;
		light.energy = 2.0f;
		light.range_m = 10.0f;
		light.attenuation = 0.0f;
		light.shadow_enabled = true;
		light.spot_angle_degrees = 60.0f;
		const LightRid rid = type == 0 ? stage.server->directional_light_create() : type == 1 ? stage.server->omni_light_create()
																							  : stage.server->spot_light_create();
		stage.add_light(rid, light, looking_down(Vector3(-1, 2.5f, 0)));
		Transform3D above;
		above.origin = Vector3(-1.0f, 0.5f, 0.0f);
		const InstanceRid panel = stage.add_quad(0.4f, stage.floor_material, above);
		const ViewportImage lit_panel = stage.draw(ViewportBuffer::COLOR_LINEAR);
		stage.server->instance_geometry_set_cast_shadows_setting(panel, ShadowCasting::SHADOWS_ONLY);
		const ViewportImage image = stage.draw();
		const float u = 0.5f - 0.5f / (3.0f * std::tan(glm::radians(30.0f)));
		CHECK(pixel(lit_panel, u, 0.5f).x > 0.8f);
		CHECK(pixel(image, u, 0.5f).x == doctest::Approx(0.0f));
		CHECK(pixel(image, 0.5f, 0.5f).x > 0.5f);
		stage.server->instance_set_visible(panel, false);
		CHECK(pixel(stage.draw(), u, 0.5f).x > 0.8f);
	}
}

TEST_CASE("frame: a floor has no acne under slanted lights with shadows") {
	for (int type = 0; type < 2; type++) {
		CAPTURE(type);
		Stage stage;
		Light light;
		light.range_m = 10.0f;
		light.attenuation = 0.0f;
		const float angle = glm::radians(15.0f); // above the floor
		const Vector3 back(std::cos(angle), std::sin(angle), 0.0f);
		const Transform3D transform = { Basis(Vector3(0, 0, -1), glm::cross(back, Vector3(0, 0, -1)), back), back * 3.0f };
		const LightRid rid = type == 0 ? stage.server->directional_light_create() : stage.server->omni_light_create();
		stage.add_light(rid, light, transform);
		const ViewportImage without = stage.draw();
		light.shadow_enabled = true;
		stage.server->light_set(rid, light);
		const ViewportImage with = stage.draw();
		uint32_t differing = 0;
		for (size_t i = 0; i < with.values.size(); i++) {
			differing += std::abs(with.values[i] - without.values[i]) > 0.01f * without.values[i] + 1e-4f ? 1 : 0;
		}
		CHECK(differing == 0);
	}
}

TEST_CASE("frame: emission, unshaded materials and the parts of the light") {
	Stage stage;
	stage.add_sun(false);
	Material material = lambertian(0.5f);
	material.emission = Vector3(3.0f, 2.0f, 1.0f);
	stage.server->material_set(stage.floor_material, material);
	stage.server->viewport_set_aov(stage.viewport, true);
	stage.server->environment_set_ambient_light(stage.environment, Vector3(0.2f), AmbientSource::COLOR, 2.0f, 1.0f);
	CHECK(pixel(stage.draw(), 0.5f, 0.5f).y == doctest::Approx(3.2f).epsilon(0.002));
	const auto at_center = [&](ViewportBuffer p_buffer) { return pixel(stage.server->viewport_get_image(stage.viewport, p_buffer), 0.5f, 0.5f).y; };
	CHECK(at_center(ViewportBuffer::DIRECT) == doctest::Approx(1.0f).epsilon(0.002));
	CHECK(at_center(ViewportBuffer::INDIRECT_DIFFUSE) == doctest::Approx(0.2f).epsilon(0.002));
	CHECK(at_center(ViewportBuffer::INDIRECT_SPECULAR) == 0.0f);
	CHECK(at_center(ViewportBuffer::EMISSION) == doctest::Approx(2.0f));
	CHECK(at_center(ViewportBuffer::ALBEDO) == doctest::Approx(0.5f));
	CHECK(at_center(ViewportBuffer::NORMAL) == doctest::Approx(1.0f));
	const ViewportImage depth = stage.server->viewport_get_image(stage.viewport, ViewportBuffer::DEPTH);
	CHECK(depth.channels == 1);
	CHECK(depth.values[SIZE / 2 * SIZE + SIZE / 2] == doctest::Approx(3.0f).epsilon(0.001));
	material.unshaded = true;
	stage.server->material_set(stage.floor_material, material);
	CHECK(pixel(stage.draw(), 0.5f, 0.5f).y == doctest::Approx(0.5f));
}

TEST_CASE("frame: a blended panel of alpha 1 equals the opaque one") {
	Stage stage;
	stage.add_sun(true);
	stage.server->environment_set_ambient_light(stage.environment, Vector3(0.2f), AmbientSource::COLOR, 1.0f, 1.0f);
	Material material;
	material.albedo = Vector4(0.8f, 0.4f, 0.2f, 1.0f);
	material.roughness = 0.4f;
	const MaterialRid rid = stage.server->material_create();
	stage.server->material_set(rid, material);
	Transform3D above;
	above.origin.y = 0.5f;
	stage.add_quad(0.5f, rid, above);
	const Vector3 solid = pixel(stage.draw(), 0.5f, 0.5f);
	material.transparency = TransparencyMode::ALPHA_BLEND;
	stage.server->material_set(rid, material);
	const Vector3 blended = pixel(stage.draw(), 0.5f, 0.5f);
	material.albedo.a = 0.25f;
	stage.server->material_set(rid, material);
	const Vector3 glass = pixel(stage.draw(), 0.5f, 0.5f);
	for (int k = 0; k < 3; k++) {
		CHECK(blended[k] == doctest::Approx(solid[k]).epsilon(0.01));
		// The floor below is lit: what blends casts no shadow.
		CHECK(glass[k] == doctest::Approx(0.25f * solid[k] + 0.75f * (1.0f + 0.1f)).epsilon(0.01));
	}
}

TEST_CASE("frame: GI lights a blended panel of alpha 1 as an opaque one") {
	Vector3 colors[2];
	for (const TransparencyMode mode : { TransparencyMode::OPAQUE, TransparencyMode::ALPHA_BLEND }) {
		Stage stage;
		SdfgiSettings settings;
		settings.enabled = true;
		settings.cascades = 1;
		settings.grid_size_cells = 64;
		settings.min_cell_size_m = 0.15f;
		settings.y_scale = SdfgiYScale::SCALE_100_PERCENT; // 9.6 m around the camera at 3 m
		stage.server->environment_set_sdfgi(stage.environment, settings);
		stage.server->environment_set_bg_color(stage.environment, Vector3(0.5f, 1.0f, 2.0f));
		Material material;
		material.albedo = Vector4(0.8f, 0.4f, 0.2f, 1.0f);
		material.roughness = 0.3f;
		material.transparency = mode;
		const MaterialRid rid = stage.server->material_create();
		stage.server->material_set(rid, material);
		stage.add_quad(0.5f, rid, Transform3D{ Basis(1.0f), Vector3(0, 0.5f, 0) });
		for (int frame = 0; frame < 4; frame++) {
			stage.server->draw();
		}
		colors[size_t(mode)] = pixel(stage.draw(), 0.5f, 0.5f);
	}
	for (int k = 0; k < 3; k++) {
		CHECK(colors[0][k] > 0.05f);
		CHECK(colors[1][k] == doctest::Approx(colors[0][k]).epsilon(0.01));
	}
}

TEST_CASE("frame: a constant sky lights every direction alike") {
	Stage stage;
	const SkyRid sky = stage.server->sky_create();
	Sky parameters;
	parameters.sky_top_color = parameters.sky_horizon_color = parameters.ground_bottom_color = parameters.ground_horizon_color = Vector3(0.6f);
	stage.server->sky_set(sky, parameters);
	stage.server->environment_set_sky(stage.environment, sky);
	stage.server->environment_set_background(stage.environment, BackgroundMode::SKY);
	stage.server->environment_set_ambient_light(stage.environment, Vector3(0.0f), AmbientSource::BACKGROUND, 1.0f, 1.0f);
	const ViewportImage image = stage.draw();
	CHECK(pixel(image, 0.5f, 0.5f).x == doctest::Approx(0.3f).epsilon(0.005));
	// A mirror of white metal gives the sky back.
	Material mirror;
	mirror.metallic = 1.0f;
	mirror.roughness = 0.0f;
	stage.server->material_set(stage.floor_material, mirror);
	CHECK(pixel(stage.draw(), 0.5f, 0.5f).x == doctest::Approx(0.6f).epsilon(0.03));
}

TEST_CASE("frame: the sky keeps a field of view of its own") {
	Stage stage;
	const SkyRid sky = stage.server->sky_create();
	stage.server->sky_set(sky, Sky());
	stage.server->environment_set_sky(stage.environment, sky);
	stage.server->environment_set_background(stage.environment, BackgroundMode::SKY);
	const auto top_of = [&](float p_camera_degrees, float p_sky_degrees) {
		Camera camera;
		camera.fov_degrees = p_camera_degrees;
		camera.transform.origin = Vector3(0, 1, 9);
		stage.server->camera_set(stage.camera, camera);
		stage.server->environment_set_sky_custom_fov(stage.environment, p_sky_degrees);
		return pixel(stage.draw(), 0.5f, 0.0f);
	};
	const Vector3 wide = top_of(120.0f, 0.0f);
	CHECK(glm::length(top_of(20.0f, 120.0f) - wide) < 1e-4f);
	CHECK(glm::length(top_of(20.0f, 0.0f) - wide) > 0.05f);
}

TEST_CASE("frame: tone mapping curves") {
	Stage stage;
	stage.add_sun(false);
	const auto display = [&](ToneMapper p_mapper, float p_exposure, float p_white) {
		stage.server->environment_set_tonemap(stage.environment, p_mapper, p_exposure, p_white);
		return pixel(stage.draw(ViewportBuffer::COLOR_DISPLAY), 0.5f, 0.5f).x;
	};
	CHECK(display(ToneMapper::LINEAR, 0.5f, 1.0f) == doctest::Approx(linear_to_srgb(0.5f)).epsilon(0.01));
	CHECK(display(ToneMapper::REINHARD, 1.0f, 1.0f) == doctest::Approx(1.0f).epsilon(0.01));
	CHECK(display(ToneMapper::REINHARD, 1.0f, 1000.0f) == doctest::Approx(linear_to_srgb(0.5f)).epsilon(0.01));
	CHECK(display(ToneMapper::FILMIC, 1.0f, 1.0f) == doctest::Approx(1.0f).epsilon(0.01));
	CHECK(display(ToneMapper::ACES, 1.0f, 1.0f) > 0.97f);
	// AgX maps middle grey near itself.
	CHECK(display(ToneMapper::AGX, 0.18f, 1.0f) == doctest::Approx(linear_to_srgb(0.18f)).epsilon(0.1));
	CHECK(pixel(stage.draw(), 0.5f, 0.5f).x == doctest::Approx(1.0f).epsilon(0.002));
}

TEST_CASE("frame: a moved instance leaves motion for one frame") {
	Stage stage;
	stage.server->viewport_set_aov(stage.viewport, true);
	const InstanceRid panel = stage.add_quad(0.5f, stage.floor_material, Transform3D{ Basis(1.0f), Vector3(0, 1, 0) });
	CHECK(pixel(stage.draw(ViewportBuffer::MOTION), 0.5f, 0.5f).x == 0.0f);
	stage.server->instance_set_transform(panel, Transform3D{ Basis(1.0f), Vector3(0.2f, 1, 0) });
	const float expected = 0.5f * 0.2f / (2.0f * std::tan(glm::radians(30.0f)));
	CHECK(pixel(stage.draw(ViewportBuffer::MOTION), 0.5f, 0.5f).x == doctest::Approx(expected).epsilon(0.01));
	CHECK(pixel(stage.draw(ViewportBuffer::MOTION), 0.5f, 0.5f).x == 0.0f);
}

TEST_CASE("frame: forty lights in clusters equal their sum") {
	Stage stage;
	Light light;
	light.energy = 0.1f;
	light.range_m = 8.0f;
	light.attenuation = 0.0f;
	float expected = 0.0f;
	for (int i = 0; i < 40; i++) {
		const Vector3 position(float(i % 8) * 0.2f - 0.7f, 2.0f, float(i / 8) * 0.2f);
		stage.add_light(stage.server->omni_light_create(), light, looking_down(position));
		const float distance = glm::length(position);
		const float window = 1.0f - std::pow(distance / 8.0f, 4.0f);
		expected += 0.5f * 0.1f * window * window * 2.0f / distance;
	}
	const ViewportImage image = stage.draw();
	CHECK(pixel(image, 0.5f, 0.5f).x == doctest::Approx(expected).epsilon(0.01));
}

TEST_SUITE_END();
