// SPDX-License-Identifier: MIT
// What nodes and their resources tell the RenderingServer.
#include "modules/scene/camera_3d.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/primitive_meshes.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/scene_tree.h"

#include <doctest/doctest.h>

using namespace lucent;

TEST_CASE("a move is one server call") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	const RenderScene &snapshot = server.scenario_snapshot();
	{
		scene::SceneTree tree(&server);
		scene::Node3D *pivot = tree.get_root()->create_child<scene::Node3D>("pivot");
		pivot->set_position(Vector3(0, 1, 0));
		auto made = std::make_unique<scene::MeshInstance3D>();
		auto material = std::make_shared<scene::StandardMaterial3D>();
		auto mesh = std::make_shared<scene::BoxMesh>();
		mesh->set_material(material);
		made->set_mesh(mesh);
		made->set_position(Vector3(1, 0, 0));
		scene::MeshInstance3D *box = pivot->add(std::move(made));
		const Instance *instance = snapshot.instances.get(box->get_instance());
		REQUIRE(instance);
		CHECK(instance->transform.origin == Vector3(1, 1, 0));
		CHECK(instance->scenario == tree.get_scenario());
		REQUIRE(snapshot.meshes.get(instance->mesh));
		CHECK(snapshot.meshes.get(instance->mesh)->surfaces.size() == 1);
		tree.flush();
		// What one call costs in versions, to count calls by.
		uint64_t edits = snapshot.version;
		server.instance_set_transform(box->get_instance(), { Basis(1.0f), Vector3(0, 9, 0) });
		const uint64_t move_cost = snapshot.version - edits;
		REQUIRE(move_cost > 0);
		edits = snapshot.version;
		pivot->set_position(Vector3(0, 2, 0));
		pivot->set_rotation_degrees(Vector3(0, 180, 0));
		box->set_position(Vector3(3, 0, 0));
		CHECK(snapshot.version == edits);
		tree.flush();
		CHECK(snapshot.version == edits + move_cost);
		CHECK(glm::length(instance->transform.origin - Vector3(-3, 2, 0)) < 1e-5f);
		tree.flush();
		CHECK(snapshot.version == edits + move_cost);

		// Materials: many edits, one call.
		const MaterialRid rid = snapshot.meshes.get(instance->mesh)->surfaces[0]->material;
		REQUIRE(snapshot.materials.get(rid));
		edits = snapshot.version;
		lucent::Material direct = *snapshot.materials.get(rid);
		direct.metallic = 0.75f;
		server.material_set(rid, direct);
		const uint64_t material_cost = snapshot.version - edits;
		REQUIRE(material_cost > 0);
		edits = snapshot.version;
		material->set("albedo_color", Color{ 0.5f, 0, 0, 1 });
		material->set("roughness", 0.25);
		material->set("emission_enabled", true);
		material->set("emission", Color{ 1, 1, 1, 1 });
		material->set("emission_energy_multiplier", 4.0);
		tree.flush();
		CHECK(snapshot.version == edits + material_cost);
		CHECK(snapshot.materials.get(rid)->albedo.x == doctest::Approx(0.21404).epsilon(1e-4));
		CHECK(snapshot.materials.get(rid)->emission == Vector3(4.0f));

		auto other = std::make_shared<scene::StandardMaterial3D>();
		CHECK(box->set("surface_material_override/0", Variant(other)));
		CHECK_FALSE(box->set("surface_material_override/0", 3));
		CHECK(box->get_active_material(0) == other);
		CHECK(snapshot.materials.get(instance->surface_override_materials.at(0)));
		pivot->set_visible(false);
		CHECK_FALSE(instance->visible);
		pivot->set_visible(true);
		CHECK(instance->visible);
		CHECK(box->set("gi_mode", 0));
		CHECK(instance->gi_mode == GiMode::DISABLED);
		mesh->set("size", Vector3(4, 4, 4));
		tree.flush();
		CHECK(server.mesh_get_aabb(instance->mesh).size() == Vector3(4, 4, 4));
	}
	CHECK(snapshot.instances.size() == 0);
	CHECK(snapshot.meshes.size() == 0);
	CHECK(snapshot.materials.size() == 0);
	CHECK(snapshot.scenarios.size() == 0);
}

TEST_CASE("a resource outlives its tree and serves the next") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	auto mesh = std::make_shared<scene::SphereMesh>();
	for (int i = 0; i < 2; i++) {
		scene::SceneTree tree(&server);
		auto ball = std::make_unique<scene::MeshInstance3D>();
		ball->set_mesh(mesh);
		scene::MeshInstance3D *node = tree.get_root()->add(std::move(ball));
		CHECK(server.scenario_snapshot().meshes.get(server.scenario_snapshot().instances.get(node->get_instance())->mesh));
	}
	CHECK(server.scenario_snapshot().meshes.size() == 0);
}

TEST_CASE("textures serve as colour and as data") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	scene::SceneTree tree(&server);
	auto image = std::make_shared<Image>();
	image->width = image->height = 1;
	image->texels.resize(4);
	auto texture = std::make_shared<scene::ImageTexture>(image);
	auto material = std::make_shared<scene::StandardMaterial3D>();
	material->set("albedo_texture", Variant(texture));
	material->set("roughness_texture", Variant(texture));
	material->set("roughness_texture_channel", 1);
	material->set("uv1_scale", Vector3(2, 3, 1));
	material->set("texture_repeat", false);
	const RenderScene &snapshot = server.scenario_snapshot();
	const lucent::Material &sent = *snapshot.materials.get(material->get_rid(*tree.get_context()));
	const TextureRef &albedo = sent.textures[size_t(TextureSlot::ALBEDO)];
	const TextureRef &roughness = sent.textures[size_t(TextureSlot::ROUGHNESS)];
	REQUIRE(snapshot.textures.size() == 2);
	CHECK(snapshot.textures.get(albedo.texture)->srgb);
	CHECK_FALSE(snapshot.textures.get(roughness.texture)->srgb);
	CHECK(roughness.channel == TextureChannel::GREEN);
	CHECK(albedo.uv_scale == Vector2(2, 3));
	CHECK(albedo.wrap_u == TextureWrap::CLAMP);
	CHECK_FALSE(sent.textures[size_t(TextureSlot::NORMAL)].texture.is_valid());
}

TEST_CASE("lights and cameras") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	const RenderScene &snapshot = server.scenario_snapshot();
	scene::SceneTree tree(&server);
	scene::SpotLight3D *spot = tree.get_root()->create_child<scene::SpotLight3D>("spot");
	const Instance &instance = *snapshot.instances.get(spot->get_instance());
	CHECK(snapshot.lights.get(instance.light)->type == LightType::SPOT);
	CHECK(snapshot.lights.get(instance.light)->shadow_bias == 0.03f);
	CHECK(spot->set("light_color", Color{ 0.5f, 1, 0, 1 }));
	CHECK(spot->set("spot_range", 12.0));
	CHECK(snapshot.lights.get(instance.light)->color.x == doctest::Approx(0.21404).epsilon(1e-4));
	CHECK(snapshot.lights.get(instance.light)->range_m == 12.0f);
	CHECK(spot->set("editor_only", true));
	CHECK_FALSE(instance.visible);

	scene::Camera3D *first = tree.get_root()->create_child<scene::Camera3D>("first");
	scene::Camera3D *second = tree.get_root()->create_child<scene::Camera3D>("second");
	CHECK(tree.get_camera_3d() == first);
	second->make_current();
	CHECK(tree.get_camera_3d() == second);
	CHECK_FALSE(first->is_current());
	second->set_position(Vector3(0, 0, 4));
	second->set_scale(Vector3(3));
	CHECK(second->set("h_offset", 1.0));
	CHECK(second->set("fov", 60));
	CHECK(second->set("keep_aspect", 0));
	CHECK_FALSE(second->set("fov", 180));
	tree.flush();
	const lucent::Camera &camera = *snapshot.cameras.get(second->get_camera_rid());
	CHECK(camera.transform.origin == Vector3(1, 0, 4));
	CHECK(camera.transform.basis == Basis(1.0f));
	CHECK(camera.fov_degrees == 60.0f);
	CHECK_FALSE(camera.keep_height);
	tree.get_root()->remove_child(second);
	CHECK(tree.get_camera_3d() == first);
	CHECK(snapshot.cameras.size() == 1);
}
