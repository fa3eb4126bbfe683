// SPDX-License-Identifier: MIT
// Levels of detail by distance, and skies that follow the sun.
#include "modules/scene/camera_3d.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/primitive_meshes.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/scene_tree.h"
#include "modules/scene/world_environment.h"

#include <doctest/doctest.h>

using namespace lucent;

TEST_CASE("visibility ranges: one level of detail shows; margins keep it or fade it") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	const RenderScene &snapshot = server.scenario_snapshot();
	scene::SceneTree tree(&server);
	const auto mesh = std::make_shared<scene::BoxMesh>();
	const auto add = [&](const char *p_name) {
		scene::MeshInstance3D *node = tree.get_root()->create_child<scene::MeshInstance3D>(p_name);
		node->set_mesh(mesh);
		return node;
	};
	scene::MeshInstance3D *near = add("Near");
	scene::MeshInstance3D *far = add("Far");
	scene::MeshInstance3D *always = add("Always");
	near->set("visibility_range_end", 10.0);
	far->set("visibility_range_begin", 10.0);
	scene::Camera3D *camera = tree.get_root()->create_child<scene::Camera3D>("Camera");
	const auto shows = [&](const scene::MeshInstance3D *p_node) { return snapshot.instances.get(p_node->get_instance())->visible; };
	const auto look_from = [&](float p_distance) {
		camera->set_position(Vector3(0, 0, p_distance));
		tree.flush();
	};
	look_from(5.0f);
	CHECK(shows(near));
	CHECK_FALSE(shows(far));
	CHECK(shows(always));
	look_from(11.0f);
	CHECK_FALSE(shows(near));
	CHECK(shows(far));
	near->set("visibility_range_end_margin", 2.0); // stays to 12, comes back at 8
	look_from(9.0f);
	CHECK_FALSE(shows(near));
	look_from(7.0f);
	CHECK(shows(near));
	look_from(11.5f);
	CHECK(shows(near));
	near->set("visibility_range_fade_mode", scene::GeometryInstance3D::FadeMode::SELF);
	look_from(11.0f); // three quarters of the way from 8 to 12
	CHECK(shows(near));
	CHECK(snapshot.instances.get(near->get_instance())->transparency == doctest::Approx(0.75f));
	CHECK(near->get_transparency() == 0.0f);
	near->set("visibility_range_end", 0.0);
	far->set("visible", false);
	look_from(50.0f);
	CHECK(shows(near));
	CHECK(snapshot.instances.get(near->get_instance())->transparency == 0.0f);
	CHECK_FALSE(shows(far));
}

TEST_CASE("PhysicalSkyMaterial: blue above, red at a low sun, dark without one; the panorama follows the sun") {
	scene::register_scene_classes();
	const scene::PhysicalSkyMaterial material;
	const Vector3 noon = material.radiance(Vector3(0, 1, 0), { glm::normalize(Vector3(0.5f, 1, 0)), 1.0f });
	CHECK(noon.b > noon.g);
	CHECK(noon.g > noon.r);
	CHECK(noon.b > 0.05f);
	const Vector3 dusk = material.radiance(glm::normalize(Vector3(1, 0.02f, 0)), { glm::normalize(Vector3(1, 0.05f, 0)), 1.0f });
	CHECK(dusk.r > dusk.b);
	CHECK(material.radiance(Vector3(0, 1, 0), {}) == Vector3(0.0f));

	RenderingServer server(nullptr);
	const RenderScene &snapshot = server.scenario_snapshot();
	scene::SceneTree tree(&server);
	const auto sky = std::make_shared<scene::Sky>();
	sky->set("sky_material", std::make_shared<scene::PhysicalSkyMaterial>());
	const auto environment = std::make_shared<scene::Environment>();
	environment->set("sky", sky);
	tree.get_root()->create_child<scene::WorldEnvironment>("World")->set("environment", environment);
	tree.flush();
	const auto brightest = [&] {
		float most = 0.0f;
		snapshot.skies.for_each([&](SkyRid, const lucent::Sky &p_sky) {
			const auto *texture = snapshot.textures.get(p_sky.panorama);
			REQUIRE(texture);
			const float *texels = reinterpret_cast<const float *>(texture->image->texels.data());
			for (size_t i = 0; i < texture->image->texels.size() / 16; i++) {
				most = std::max(most, texels[i * 4 + 2]);
			}
		});
		return most;
	};
	CHECK(brightest() == 0.0f);
	scene::DirectionalLight3D *sun = tree.get_root()->create_child<scene::DirectionalLight3D>("Sun");
	sun->set_rotation_degrees(Vector3(-60, 0, 0));
	tree.flush();
	tree.flush();
	const float high = brightest();
	CHECK(high > 0.1f);
	sun->set_rotation_degrees(Vector3(60, 0, 0)); // below the horizon
	tree.flush();
	CHECK(brightest() < 0.1f * high);
}
