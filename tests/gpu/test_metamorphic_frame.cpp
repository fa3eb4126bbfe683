// SPDX-License-Identifier: MIT
// Whole frames: what the camera's direction, the place in the world and the contents of fresh memory must not change.
#include "servers/rendering/rendering_server.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/gpu/scoped_environment.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace lucent;
using lucent::test::GpuFixture;
using lucent::test::ScopedEnvironment;

namespace {

MeshSurface box(const Vector3 &p_half, bool p_inward, MaterialRid p_material) {
	MeshSurface surface;
	surface.material = p_material;
	for (int axis = 0; axis < 3; axis++) {
		for (int side = 0; side < 2; side++) {
			Vector3 normal(0.0f), u(0.0f), v(0.0f);
			normal[axis] = side == 0 ? 1.0f : -1.0f;
			u[(axis + 1) % 3] = normal[axis];
			v[(axis + 2) % 3] = 1.0f;
			const uint32_t first = uint32_t(surface.positions.size());
			for (const Vector3 &corner : { normal - u - v, normal + u - v, normal + u + v, normal - u + v }) {
				surface.positions.push_back(corner * p_half);
				surface.normals.push_back(p_inward ? -normal : normal);
				surface.uvs.push_back(Vector2(0.0f));
			}
			for (const uint32_t i : { 0u, 1u, 2u, 0u, 2u, 3u }) {
				surface.indices.push_back(first + (p_inward ? (3 - i) : i));
			}
		}
	}
	return surface;
}

// A closed room with a block, a lamp panel and an omni light with a shadow; the camera stands in a corner.
struct Room {
	RenderingServer server;
	ScenarioRid scenario;
	EnvironmentRid environment;
	CameraRid camera;
	ViewportRid viewport;
	Vector3 shift_m;

	explicit Room(RenderingDevice &p_device, const Vector3 &p_shift_m = Vector3(0.0f)) :
			server(&p_device), shift_m(p_shift_m) {
		scenario = server.scenario_create();
		environment = server.environment_create();
		SdfgiSettings settings;
		settings.enabled = true;
		settings.cascades = 2;
		settings.grid_size_cells = 64;
		settings.min_cell_size_m = 0.25f; // all sizes are exact
		settings.y_scale = SdfgiYScale::SCALE_100_PERCENT;
		settings.frames_to_converge = 2;
		server.environment_set_sdfgi(environment, settings);
		server.environment_set_background(environment, BackgroundMode::COLOR);
		server.environment_set_bg_color(environment, Vector3(0.25f, 0.5f, 1.0f));
		server.scenario_set_environment(scenario, environment);
		add_box(Vector3(2.5f, 1.5f, 2.0f), true, Vector3(0.75f, 0.5f, 0.25f), 0.0f, Vector3(0.0f));
		add_box(Vector3(0.5f, 0.75f, 0.5f), false, Vector3(0.25f, 0.5f, 0.75f), 0.0f, Vector3(0.75f, -0.75f, -0.5f));
		add_box(Vector3(0.5f, 0.0625f, 0.5f), false, Vector3(0.5f), 8.0f, Vector3(-1.0f, 1.25f, 0.0f));
		Light light;
		light.range_m = 6.0f;
		light.shadow_enabled = true;
		const LightRid lamp = server.omni_light_create();
		server.light_set(lamp, light);
		add(lamp, { Basis(1.0f), shift_m + Vector3(1.5f, 1.0f, 1.0f) });
		camera = server.camera_create();
		Camera parameters;
		parameters.fov_degrees = 75.0f;
		server.camera_set(camera, parameters);
		turn(0.0f);
		viewport = server.viewport_create();
		server.viewport_set_size(viewport, 64, 36);
		server.viewport_set_scenario(viewport, scenario);
		server.viewport_attach_camera(viewport, camera);
	}
	void add_box(const Vector3 &p_half, bool p_inward, const Vector3 &p_albedo, float p_emission, const Vector3 &p_origin) {
		Material material;
		material.albedo = Vector4(p_albedo, 1.0f);
		material.emission = Vector3(p_emission);
		material.roughness = 0.6f;
		const MaterialRid rid = server.material_create();
		server.material_set(rid, material);
		const MeshRid mesh = server.mesh_create();
		server.mesh_add_surface(mesh, box(p_half, p_inward, rid));
		add(mesh, { Basis(1.0f), shift_m + p_origin });
	}
	template <typename BaseRid>
	void add(BaseRid p_base, const Transform3D &p_transform) {
		const InstanceRid instance = server.instance_create();
		server.instance_set_base(instance, p_base);
		server.instance_set_scenario(instance, scenario);
		server.instance_set_transform(instance, p_transform);
	}
	void turn(float p_angle) {
		const float c = std::cos(p_angle), s = std::sin(p_angle);
		server.camera_set_transform(camera, { Basis(Vector3(c, 0, -s), Vector3(0, 1, 0), Vector3(s, 0, c)), shift_m + Vector3(-0.5f, 0.0f, 1.5f) });
	}
	std::vector<float> draw(ViewportBuffer p_buffer = ViewportBuffer::COLOR_LINEAR) {
		server.draw();
		return server.viewport_get_image(viewport, p_buffer).values;
	}
};

// Picture and indirect light after two frames: what holds for settled light holds on the way.
std::vector<float> light_of(Room &r_room) {
	r_room.server.viewport_set_aov(r_room.viewport, true);
	r_room.server.draw();
	std::vector<float> values = r_room.draw();
	const std::vector<float> indirect = r_room.server.viewport_get_image(r_room.viewport, ViewportBuffer::INDIRECT_DIFFUSE).values;
	values.insert(values.end(), indirect.begin(), indirect.end());
	return values;
}

double mean(const std::vector<float> &p_values) {
	double sum = 0.0;
	for (const float value : p_values) {
		sum += value;
	}
	return sum / double(p_values.size());
}

} // namespace

TEST_SUITE_BEGIN("gpu");

TEST_CASE("metamorphic: a camera that turns in place after convergence changes nothing in GI") {
	GpuFixture fixture;
	Room room(fixture.device());
	for (int frame = 0; frame < 100 && !room.server.get_frame_stats().gi.converged; frame++) {
		room.server.draw();
	}
	const std::vector<float> before = room.draw();
	const uint64_t frames = room.server.get_frame_stats().gi.frames;
	REQUIRE(room.server.get_frame_stats().gi.converged);
	CHECK(mean(before) > 0.05);
	for (const float angle : { 0.7f, 1.9f, -2.5f }) {
		room.turn(angle);
		CHECK(room.draw() != before);
		CHECK(room.server.get_frame_stats().gi.rays == 0);
	}
	room.turn(0.0f);
	CHECK(room.draw() == before);
	CHECK(room.server.get_frame_stats().gi.frames == frames);
	CHECK(room.server.get_frame_stats().gi.converged);
}

TEST_CASE("metamorphic: scene and camera shifted by multiples of the coarsest probe spacing: the same bits") {
	constexpr float COARSEST_PROBE_SPACING_M = 4.0f;
	GpuFixture fixture;
	std::vector<float> before;
	{
		Room room(fixture.device());
		before = light_of(room);
		CHECK(mean(before) > 0.05);
	}
	for (const Vector3 &steps : { Vector3(1, -2, 3), Vector3(8, 0, 0) }) {
		Room room(fixture.device(), steps * COARSEST_PROBE_SPACING_M);
		CHECK(light_of(room) == before);
	}
	// So far that floats are 1/64 m apart, and after a frame near the world's origin.
	Room room(fixture.device(), Vector3(32768, 8192, -32767) * COARSEST_PROBE_SPACING_M);
	room.server.camera_set_transform(room.camera, { Basis(1.0f), Vector3(0.0f, 0.0f, 1.0f) });
	room.server.draw();
	room.turn(0.0f);
	CHECK(light_of(room) == before);
	const std::vector<float> motion = room.draw(ViewportBuffer::MOTION);
	CHECK(std::all_of(motion.begin(), motion.end(), [](float p_value) { return p_value == 0.0f; }));
}

TEST_CASE("metamorphic: a camera that jumps to a distant part of the scene sees its lamps and shadows") {
	GpuFixture fixture;
	constexpr float FAR_M = 131072.0f;
	std::vector<float> pictures[2];
	for (const bool jump : { false, true }) {
		Room room(fixture.device(), Vector3(FAR_M, 0.0f, 0.0f));
		room.server.environment_set_sdfgi(room.environment, SdfgiSettings());
		// Straight down: about either origin the sun looks through the same matrix.
		const LightRid sun = room.server.directional_light_create();
		Light light;
		light.shadow_enabled = true;
		room.server.light_set(sun, light);
		room.add(sun, { Basis(Vector3(1, 0, 0), Vector3(0, 0, -1), Vector3(0, 1, 0)), Vector3(0.0f) });
		// A floor here and there, the room's block and lamps only there.
		room.shift_m = Vector3(0.0f);
		room.add_box(Vector3(4.0f, 0.25f, 4.0f), false, Vector3(0.5f), 0.0f, Vector3(0.0f, -2.0f, 0.0f));
		if (jump) {
			room.turn(0.0f);
			room.server.draw();
		}
		room.shift_m = Vector3(FAR_M, 0.0f, 0.0f);
		room.turn(0.0f);
		pictures[jump] = room.draw();
	}
	CHECK(mean(pictures[0]) > 0.05);
	CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("metamorphic: what fresh memory holds does not show") {
	std::vector<float> linear, display;
	for (const char *poison : { "ff", "00" }) {
		const ScopedEnvironment environment("LUCENT_POISON", poison);
		GpuFixture fixture;
		Room room(fixture.device());
		for (int frame = 0; frame < 100 && !room.server.get_frame_stats().gi.converged; frame++) {
			room.server.draw();
		}
		const std::vector<float> picture = room.draw();
		const std::vector<float> shown = room.server.viewport_get_image(room.viewport, ViewportBuffer::COLOR_DISPLAY).values;
		CHECK(mean(picture) > 0.05); // and no NaN
		CHECK((linear.empty() || picture == linear));
		CHECK((display.empty() || shown == display));
		linear = picture;
		display = shown;
	}
}

TEST_SUITE_END();
