// SPDX-License-Identifier: MIT
// Worlds and cameras of viewports inside of a scene.
#include "modules/scene/camera_3d.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/primitive_meshes.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/scene_tree.h"
#include "modules/scene/viewport.h"
#include "modules/scene/world_environment.h"

#include <doctest/doctest.h>

using namespace lucent;

namespace {

int count_instances(const RenderScene &p_scene) {
	int count = 0;
	p_scene.instances.for_each([&](InstanceRid, const Instance &) { count++; });
	return count;
}

} // namespace

TEST_CASE("viewports: a world of its own stays out, another shares geometry and lamps; cameras never show for the parent") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	const RenderScene &snapshot = server.scenario_snapshot();
	scene::SceneTree tree(&server);
	scene::Node3D *room = tree.get_root()->create_child<scene::Node3D>("Room");
	scene::SubViewport *hud = room->create_child<scene::SubViewport>("Hud");
	hud->set("own_world_3d", true);
	scene::Node3D *coin = hud->create_child<scene::MeshInstance3D>("Coin");
	coin->create_child<scene::OmniLight3D>("Lamp");
	scene::Camera3D *hud_camera = hud->create_child<scene::Camera3D>("HudCamera");
	hud_camera->set_current(true);
	const auto environment = std::make_shared<scene::Environment>();
	hud->create_child<scene::WorldEnvironment>("HudEnvironment")->set("environment", environment);
	// A viewport that shares the world, inside of the one that does not.
	hud->create_child<scene::SubViewport>("Inner")->create_child<scene::MeshInstance3D>("Gem");
	CHECK(count_instances(snapshot) == 0);
	CHECK(tree.get_camera_3d() == nullptr);
	CHECK(tree.get_world_environment() == nullptr);
	CHECK_FALSE(hud_camera->get_camera_rid().is_valid());
	CHECK(hud_camera->is_current()); // for its own viewport

	scene::SubViewport *mirror = room->create_child<scene::SubViewport>("Mirror");
	mirror->create_child<scene::MeshInstance3D>("Frame");
	scene::Camera3D *mirror_camera = mirror->create_child<scene::Camera3D>("MirrorCamera");
	mirror_camera->set_current(true);
	CHECK(count_instances(snapshot) == 1);
	CHECK(tree.get_camera_3d() == nullptr);
	CHECK(mirror_camera->get_camera_rid().is_valid()); // it can be asked for by name

	scene::Camera3D *camera = room->create_child<scene::Camera3D>("Camera");
	CHECK(tree.get_camera_3d() == camera);
	mirror_camera->make_current();
	CHECK(tree.get_camera_3d() == camera);

	hud->set("own_world_3d", false);
	CHECK(count_instances(snapshot) == 4);
	REQUIRE(tree.get_world_environment() != nullptr);
	CHECK(tree.get_world_environment()->get_environment() == environment);
	CHECK(tree.get_camera_3d() == camera);
	hud->set("world_3d", std::make_shared<scene::World3D>());
	CHECK(count_instances(snapshot) == 1);
	CHECK(tree.get_world_environment() == nullptr);
}
