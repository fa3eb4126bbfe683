// SPDX-License-Identifier: MIT
#include "servers/rendering/rendering_server.h"

#include <doctest/doctest.h>

using namespace lucent;

namespace {
// Collects what the server says.
struct LogCapture {
	std::vector<std::string> messages;
	LogHandler old = set_log_handler([this](LogLevel, std::string_view p_message) { messages.emplace_back(p_message); });
	~LogCapture() { set_log_handler(old); }
};

MeshSurface triangle() {
	MeshSurface surface;
	surface.positions = { Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0) };
	surface.indices = { 0, 1, 2 };
	return surface;
}

struct World {
	RenderingServer server{ nullptr };
	ScenarioRid scenario = server.scenario_create();
	MeshRid mesh = server.mesh_create();
	InstanceRid instance = server.instance_create();
	World() {
		server.mesh_add_surface(mesh, triangle());
		server.instance_set_base(instance, mesh);
		server.instance_set_scenario(instance, scenario);
	}
	const Scenario &state() const { return *server.scenario_snapshot().scenarios.get(scenario); }
};
} // namespace

TEST_CASE("rendering server: stale ids say so and return defaults") {
	World world;
	world.server.free(world.mesh);
	const uint64_t version = world.state().geometry_version;
	LogCapture log;
	CHECK(world.server.mesh_get_aabb(world.mesh).is_empty());
	world.server.mesh_add_surface(world.mesh, triangle());
	world.server.free(world.mesh);
	world.server.instance_set_base(world.instance, world.mesh);
	world.server.draw();
	CHECK(log.messages.size() == 5);
	CHECK(world.state().geometry_version == version);
	CHECK_FALSE(world.server.scenario_snapshot().instances.get(world.instance)->mesh.is_valid());
}

TEST_CASE("rendering server: broken surfaces are refused") {
	RenderingServer server(nullptr);
	const MeshRid mesh = server.mesh_create();
	LogCapture log;
	MeshSurface surface = triangle();
	surface.positions[1].y = std::numeric_limits<float>::quiet_NaN();
	server.mesh_add_surface(mesh, surface);
	surface = triangle();
	surface.indices[2] = 3;
	server.mesh_add_surface(mesh, surface);
	surface = triangle();
	surface.uvs = { Vector2(0.0f) };
	server.mesh_add_surface(mesh, surface);
	surface = triangle();
	surface.indices.pop_back();
	server.mesh_add_surface(mesh, surface);
	CHECK(log.messages.size() == 4);
	CHECK(server.scenario_snapshot().meshes.get(mesh)->surfaces.empty());
}

TEST_CASE("rendering server: a move dirties where the instance was and is") {
	World world;
	const uint64_t version = world.state().geometry_version;
	const size_t before = world.state().dirty.size();
	Transform3D transform;
	transform.origin = Vector3(5, 0, 0);
	world.server.instance_set_transform(world.instance, transform);
	REQUIRE(world.state().dirty.size() == before + 1);
	const DirtyBox dirty = world.state().dirty.back();
	CHECK(dirty.box == AABB{ Vector3(0, 0, 0), Vector3(6, 1, 0) });
	CHECK(dirty.geometry);
	CHECK(dirty.version > version);
	CHECK(world.state().geometry_version == dirty.version);
	world.server.instance_set_transform(world.instance, transform);
	CHECK(world.state().dirty.size() == before + 1);
}

TEST_CASE("rendering server: materials, meshes and visibility dirty their instances") {
	World world;
	const MaterialRid material = world.server.material_create();
	uint64_t version = world.state().geometry_version;
	const auto grew = [&] {
		const bool result = world.state().geometry_version > version;
		version = world.state().geometry_version;
		return result;
	};
	world.server.material_set(material, Material());
	CHECK_FALSE(grew());
	world.server.mesh_surface_set_material(world.mesh, 0, material);
	CHECK(grew());
	world.server.material_set(material, Material());
	CHECK(grew());
	world.server.instance_set_visible(world.instance, false);
	CHECK(grew());
	world.server.material_set(material, Material());
	CHECK_FALSE(grew());
	world.server.instance_set_visible(world.instance, true);
	CHECK(grew());
	world.server.mesh_clear(world.mesh);
	CHECK(grew());
}

TEST_CASE("sdfgi settings: values out of their ranges are named") {
	CHECK(sdfgi_settings_error(SdfgiSettings()).empty());
	SdfgiSettings settings;
	settings.min_cell_size_m = 0.01f;
	settings.probe_irradiance_texels = 14;
	CHECK(sdfgi_settings_error(settings).empty());
	settings.probe_irradiance_texels = 15;
	CHECK(sdfgi_settings_error(settings).find("probe_irradiance_texels 15") != std::string::npos);
	settings = {};
	settings.grid_size_cells = 96;
	CHECK(sdfgi_settings_error(settings).find("grid_size_cells 96") != std::string::npos);
	settings.grid_size_cells = 256;
	settings.probe_spacing_cells = 4;
	CHECK(sdfgi_settings_error(settings).find("33 probes") != std::string::npos);
	settings = {};
	settings.min_cell_size_m = std::nanf("");
	CHECK_FALSE(sdfgi_settings_error(settings).empty());
}

TEST_CASE("rendering server: lights and environments change only the light's version") {
	World world;
	const uint64_t geometry = world.state().geometry_version;
	const LightRid light = world.server.omni_light_create();
	const InstanceRid instance = world.server.instance_create();
	world.server.instance_set_base(instance, light);
	world.server.instance_set_scenario(instance, world.scenario);
	uint64_t version = world.state().light_version;
	Light parameters;
	parameters.type = LightType::SPOT;
	parameters.range_m = 2.0f;
	world.server.light_set(light, parameters);
	CHECK(world.server.scenario_snapshot().lights.get(light)->type == LightType::OMNI);
	CHECK(world.state().light_version > version);
	CHECK(world.state().dirty.back().box == AABB{ Vector3(-5.0f), Vector3(5.0f) });
	CHECK_FALSE(world.state().dirty.back().geometry);
	version = world.state().light_version;
	const EnvironmentRid environment = world.server.environment_create();
	world.server.scenario_set_environment(world.scenario, environment);
	CHECK(world.state().light_version > version);
	version = world.state().light_version;
	world.server.environment_set_bg_energy(environment, 2.0f);
	CHECK(world.state().light_version > version);
	version = world.state().light_version;
	SdfgiSettings sdfgi;
	sdfgi.energy = 2.0f;
	world.server.environment_set_sdfgi(environment, sdfgi);
	CHECK(world.state().light_version == version);
	CHECK(world.server.scenario_snapshot().environments.get(environment)->sdfgi.energy == 2.0f);
	CHECK(world.state().geometry_version == geometry);
}

TEST_CASE("camera projection: reversed z, y down in clip space") {
	Camera camera;
	camera.fov_degrees = 90.0f;
	camera.near_m = 0.1f;
	camera.far_m = 100.0f;
	const Projection projection = camera_projection(camera, 2.0f);
	const Vector4 near_top = projection * Vector4(0.2f, 0.1f, -0.1f, 1.0f);
	CHECK(near_top.x / near_top.w == doctest::Approx(1.0f));
	CHECK(near_top.y / near_top.w == doctest::Approx(-1.0f));
	CHECK(near_top.z / near_top.w == doctest::Approx(1.0f));
	const Vector4 far_point = projection * Vector4(0.0f, 0.0f, -100.0f, 1.0f);
	CHECK(far_point.z / far_point.w == doctest::Approx(0.0f));
	camera.kind = Camera::Kind::ORTHOGONAL;
	camera.size_m = 4.0f;
	const Projection orthogonal = camera_projection(camera, 2.0f);
	const Vector4 corner = orthogonal * Vector4(4.0f, 2.0f, -0.1f, 1.0f);
	CHECK(corner.x == doctest::Approx(1.0f));
	CHECK(corner.y == doctest::Approx(-1.0f));
	CHECK(corner.z == doctest::Approx(1.0f));
}
