// SPDX-License-Identifier: MIT
#include "modules/scene/node_3d.h"
#include "modules/scene/property_path.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/scene_tree.h"
#include "modules/scene/world_environment.h"

#include <doctest/doctest.h>

using namespace lucent;

TEST_CASE("the three SDFGI distances are one number") {
	scene::register_scene_classes();
	scene::Environment environment;
	CHECK(environment.get("sdfgi_cascade0_distance").to_string() == "12.8");
	CHECK(environment.get("sdfgi_max_distance").to_string() == "204.8");
	CHECK(environment.set("sdfgi_min_cell_size", 0.5));
	CHECK(environment.get_sdfgi_cascade0_distance() == 32.0f);
	CHECK(environment.get_sdfgi_max_distance() == 512.0f);
	CHECK(environment.set("sdfgi_cascades", 6)); // the cell stays
	CHECK(environment.get_sdfgi_min_cell_size() == 0.5f);
	CHECK(environment.get_sdfgi_max_distance() == 2048.0f);
	CHECK(environment.set("sdfgi_max_distance", 4096.0));
	CHECK(environment.get_sdfgi_min_cell_size() == 1.0f);
	CHECK(environment.set("sdfgi_cascade0_distance", 6.4));
	CHECK(environment.get("sdfgi_min_cell_size").to_string() == "0.1");
}

TEST_CASE("ranges of the environment") {
	scene::register_scene_classes();
	scene::Environment environment;
	CHECK_FALSE(environment.set("sdfgi_cascades", 0));
	CHECK_FALSE(environment.set("sdfgi_cascades", 9));
	CHECK(environment.set("sdfgi_min_cell_size", 0.00001)); // a model of a millimetre
	CHECK_FALSE(environment.set("sdfgi_min_cell_size", 0));
	CHECK_FALSE(environment.set("sdfgi_min_cell_size", -1));
	CHECK_FALSE(environment.set("sdfgi_bounce_feedback", 2.5));
	CHECK_FALSE(environment.set("sdfgi_y_scale", 3));
	CHECK_FALSE(environment.set("tonemap_mode", 5));
	CHECK_FALSE(environment.set("sky", Variant(std::make_shared<scene::ProceduralSkyMaterial>())));
	CHECK(environment.set("tonemap_exposure", 100)); // the slider ends at 16, the property does not
	// A far reach with few cascades still has a legal cell.
	CHECK(environment.set("sdfgi_max_distance", 1e12));
	CHECK(environment.get_sdfgi_min_cell_size() == 1e6f);
	environment.set_sdfgi_cascades(-5);
	CHECK(environment.get_sdfgi_cascades() == 1);
}

TEST_CASE("the environment reaches the server, linear, and once a frame") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	scene::SceneTree tree(&server);
	auto environment = std::make_shared<scene::Environment>();
	environment->set("background_mode", 2);
	environment->set("ambient_light_color", Color{ 0.5f, 0.5f, 0.5f, 1.0f });
	environment->set("sdfgi_enabled", true);
	CHECK(environment->set("sky_custom_fov", 75.0));
	CHECK_FALSE(environment->set("sky_custom_fov", 181.0));
	auto sky = std::make_shared<scene::Sky>();
	auto sky_material = std::make_shared<scene::ProceduralSkyMaterial>();
	sky->set_material(sky_material);
	environment->set("sky", Variant(sky));
	scene::WorldEnvironment *node = tree.get_root()->create_child<scene::WorldEnvironment>("WorldEnvironment");
	node->set_environment(environment);
	const RenderScene &snapshot = server.scenario_snapshot();
	const EnvironmentRid rid = snapshot.scenarios.get(tree.get_scenario())->environment;
	REQUIRE(snapshot.environments.get(rid));
	CHECK(snapshot.environments.get(rid)->ambient_color.x == doctest::Approx(0.21404).epsilon(1e-4));
	CHECK(snapshot.environments.get(rid)->sdfgi.enabled);
	CHECK(snapshot.environments.get(rid)->sky_custom_fov_degrees == 75.0f);
	const SkyRid sky_rid = snapshot.environments.get(rid)->sky;
	REQUIRE(snapshot.skies.get(sky_rid));
	CHECK(snapshot.skies.get(sky_rid)->sky_top_color.z == doctest::Approx(srgb_to_linear(0.55f)));

	// Many edits, one call; an edit of the sky does not touch the environment.
	uint64_t edits = snapshot.version;
	server.sky_set(sky_rid, *snapshot.skies.get(sky_rid));
	const uint64_t sky_cost = snapshot.version - edits; // what one call costs in versions
	const uint64_t sky_before = snapshot.skies.get(sky_rid)->version;
	sky_material->set("sky_curve", 0.3);
	sky_material->set("energy_multiplier", 2.0);
	CHECK(snapshot.skies.get(sky_rid)->version == sky_before);
	edits = snapshot.version;
	tree.flush();
	CHECK(snapshot.skies.get(sky_rid)->sky_curve == 0.3f);
	CHECK(snapshot.skies.get(sky_rid)->energy_multiplier == 2.0f);
	CHECK(snapshot.version == edits + sky_cost);
	tree.flush();
	CHECK(snapshot.version == edits + sky_cost);

	node->set_environment(nullptr);
	CHECK_FALSE(snapshot.scenarios.get(tree.get_scenario())->environment.is_valid());
}

TEST_CASE("properties by path") {
	scene::register_scene_classes();
	scene::SceneTree tree;
	scene::Node *root = tree.get_root();
	scene::WorldEnvironment *node = root->create_child<scene::WorldEnvironment>("WorldEnvironment");
	const auto set = [&](const char *p_path, const Variant &p_value) {
		const Status status = scene::set_property_by_path(*root, NodePath(p_path), p_value);
		return status.ok() ? std::string() : status.error().message;
	};
	CHECK(set("WorldEnvironment:environment:sdfgi_enabled", true).find("is null") != std::string::npos);
	node->set_environment(std::make_shared<scene::Environment>());
	CHECK(set("WorldEnvironment:environment:sdfgi_enabled", true).empty());
	CHECK(node->get_environment()->sdfgi.enabled);
	CHECK(set("root/WorldEnvironment:environment:sdfgi_enabled", false).empty());
	CHECK_FALSE(node->get_environment()->sdfgi.enabled);
	CHECK(set("WorldEnvironment:environment:ambient_light_color:g", 0.5).empty());
	CHECK(node->get_environment()->state.ambient_light_color == Color{ 0, 0.5f, 0, 1 });
	CHECK(set("WorldEnvironment:environment:no_such", 1) == "'WorldEnvironment:environment:no_such': Environment has no property 'no_such'");
	CHECK(set("Nowhere:x", 1) == "'Nowhere:x': the scene has no node 'Nowhere'");
	CHECK_FALSE(set("WorldEnvironment", 1).empty());
	CHECK_FALSE(set("WorldEnvironment:environment:sdfgi_cascades", 20).empty());
	CHECK_FALSE(set("WorldEnvironment:environment:ambient_light_color:q", 1).empty());
	scene::Node3D *box = root->create_child<scene::Node3D>("Box");
	CHECK(set("Box:transform:origin:y", 3).empty());
	CHECK(box->get_position() == Vector3(0, 3, 0));
	CHECK(scene::get_property_by_path(*root, NodePath("Box:position:y")).value() == Variant(3.0));
}
