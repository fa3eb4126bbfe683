// SPDX-License-Identifier: MIT
// Trees as Godot's importer makes them. What is right was read in its importer's documentation and source (Godot 4).
#include "modules/gltf/gltf_scene.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/skeleton_3d.h"
#include "modules/scene/visual_instance_3d.h"
#include "tests/unit/gltf_builder.h"

#include <doctest/doctest.h>

using namespace lucent;
using lucent::test::GltfBuilder;

namespace {

std::unique_ptr<scene::Node> make_scene(const std::string &p_json, const GltfImportSettings &p_settings = {}) {
	scene::register_scene_classes();
	GltfBuilder builder;
	builder.add(std::vector<float>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, "VEC3", 5126, 3);
	builder.add(std::vector<uint8_t>{ 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }, "VEC4", 5121, 3);
	builder.add(std::vector<float>{ 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 }, "VEC4", 5126, 3);
	return gltf_to_scene(builder.parse(p_json).take(), "file", -1, p_settings).value()->instantiate().take();
}

const char *const MESHES = R"("meshes":[{"name":"Plain","primitives":[{"attributes":{"POSITION":0}}]},{"name":"Skinned","primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],)";

// "Name:Class(children)", in order.
std::string outline(const scene::Node &p_node) {
	std::string text = p_node.get_name() + ":" + p_node.get_class();
	std::string below;
	for (const std::unique_ptr<scene::Node> &child : p_node.get_children()) {
		below += (below.empty() ? "" : " ") + outline(*child);
	}
	return below.empty() ? text : text + "(" + below + ")";
}

} // namespace

TEST_CASE("glTF tree: suffixes of names") {
	const std::string json = std::string(MESHES) + R"("scenes":[{"nodes":[0,1,2,4,5,6,7,8,9,10]}],"nodes":[{"name":"Crate-col","mesh":0},{"name":"Hull-colonly.001","mesh":0,"translation":[1,2,3]},
		{"name":"Helper-noimp","children":[3]},{"name":"Below","mesh":0},{"name":"Nav-navmesh","mesh":0},{"name":"Wall-occ","mesh":0},{"name":"Box-occonly","mesh":0},
		{"name":"Barrel-rigid","mesh":0,"translation":[4,5,6]},{"name":"Column","mesh":0},{"name":"Car-vehicle"},{"name":"Protocol","mesh":0}],)";
	const std::unique_ptr<scene::Node> root = make_scene(json);
	CHECK(outline(*root) == "file:Node3D(Crate:MeshInstance3D(StaticBody3D:Node3D(CollisionShape3D:Node3D)) Hull_001:Node3D(CollisionShape3D:Node3D) Nav:Node3D "
							"Wall:MeshInstance3D Barrel-rigid:Node3D(Barrel-rigid:MeshInstance3D CollisionShape3D:Node3D) Column:MeshInstance3D Car:Node3D(Car:Node3D) Protocol:MeshInstance3D)");
	CHECK(root->get_node(NodePath("Hull_001"))->get("position") == Variant(Vector3(1, 2, 3)));
	CHECK(root->get_node(NodePath("Barrel-rigid"))->get("position") == Variant(Vector3(4, 5, 6)));
	CHECK(root->get_node(NodePath("Barrel-rigid/Barrel-rigid"))->get("position") == Variant(Vector3(0, 0, 0)));
	GltfImportSettings settings;
	settings.use_node_type_suffixes = false;
	CHECK(make_scene(json, settings)->get_child_count() == 9); // only -noimp acts
	settings.use_name_suffixes = false;
	CHECK(make_scene(json, settings)->get_child_count() == 10);
}

TEST_CASE("glTF tree: a scene's name does not take a node's; a single root is the root") {
	const std::string json = std::string(MESHES) + R"("scenes":[{"name":"robot","nodes":[1]}],"nodes":[{"name":"hat","mesh":0},{"name":"robot","mesh":0,"children":[0],"translation":[1,0,0]}],)";
	CHECK(outline(*make_scene(json)) == "robot:Node3D(robot:MeshInstance3D(hat:MeshInstance3D))");
	GltfImportSettings old;
	old.naming_version = 1;
	CHECK(outline(*make_scene(json, old)) == "robot:Node3D(robot2:MeshInstance3D(hat:MeshInstance3D))");
	const std::unique_ptr<scene::Node> single = make_scene(json + R"("extensionsUsed":["GODOT_single_root"],)");
	CHECK(outline(*single) == "robot:MeshInstance3D(hat:MeshInstance3D)");
	CHECK(single->get("position") == Variant(Vector3(1, 0, 0)));
	old.root_name = "Boss";
	old.root_scale = 2.0f;
	const std::unique_ptr<scene::Node> scaled = make_scene(json, old);
	CHECK(scaled->get_name() == "Boss");
	CHECK(scaled->get_child(0)->get("position") == Variant(Vector3(2, 0, 0)));
	CHECK(scaled->get_child(0)->get("scale") == Variant(Vector3(2, 2, 2)));
}

TEST_CASE("glTF tree: skeletons, attachments and skinned meshes") {
	const std::unique_ptr<scene::Node> root = make_scene(std::string(MESHES) + R"("scenes":[{"nodes":[0]}],"skins":[{"joints":[2,4]}],"nodes":[{"name":"Armature","children":[1,2],"translation":[0,0,9]},
		{"name":"Body","mesh":1,"skin":0,"translation":[7,7,7]},{"name":"Hip","children":[3,5],"translation":[0,1,0]},{"name":"Between","children":[4],"translation":[0,1,0]},
		{"name":"Head","children":[6],"translation":[0,1,0]},{"name":"Belt","mesh":0,"translation":[3,0,0]},{"name":"Hat","mesh":0,"translation":[0,0.5,0]}],)");
	CHECK(outline(*root) == "file:Node3D(Armature:Node3D(Skeleton3D:Skeleton3D(Hat:BoneAttachment3D(Hat:MeshInstance3D) Belt:BoneAttachment3D(Belt:MeshInstance3D) Body:MeshInstance3D)))");
	const scene::Skeleton3D *skeleton = dynamic_cast<scene::Skeleton3D *>(root->get_node(NodePath("Armature/Skeleton3D")));
	REQUIRE(skeleton);
	REQUIRE(skeleton->get_bone_count() == 3);
	CHECK(skeleton->get_bone_name(1) == "Between");
	CHECK(skeleton->get_bone_parent(2) == 1);
	const scene::Node3D *hat = dynamic_cast<scene::Node3D *>(root->get_node(NodePath("Armature/Skeleton3D/Hat/Hat")));
	REQUIRE(hat);
	CHECK(glm::length(hat->get_global_transform().origin - Vector3(0, 3.5f, 9)) < 1e-5f);
	const scene::MeshInstance3D *body = dynamic_cast<scene::MeshInstance3D *>(root->get_node(NodePath("Armature/Skeleton3D/Body")));
	REQUIRE(body);
	CHECK(body->get_transform().origin == Vector3(0.0f)); // a skin ignores its node's place
	// Identity as inverse bind: the hip's pose in the skeleton's space.
	CHECK(glm::length(body->get_mesh()->surface_get_arrays(0)->positions[0] - Vector3(0, 1, 0)) < 1e-5f);
}

TEST_CASE("bone attachments follow their bone by name or index") {
	scene::register_scene_classes();
	scene::Skeleton3D skeleton;
	CHECK(skeleton.add_bone("hip", -1, { Basis(1.0f), Vector3(0, 1, 0) }) == 0);
	CHECK(skeleton.add_bone("hip", -1, {}) == -1);
	CHECK(skeleton.set("bones/1/name", "head"));
	CHECK_FALSE(skeleton.set("bones/1/name", "hip"));
	CHECK(skeleton.set("bones/1/parent", 0));
	CHECK_FALSE(skeleton.set("bones/1/parent", 1));
	CHECK(skeleton.set("bones/1/position", Vector3(0, 2, 0)));
	scene::BoneAttachment3D *hat = skeleton.create_child<scene::BoneAttachment3D>("Hat");
	hat->set("bone_name", "head");
	CHECK(hat->get_bone_idx() == 1);
	CHECK(hat->get_position() == Vector3(0, 3, 0));
	CHECK(skeleton.set("bones/0/position", Vector3(0, 5, 0)));
	CHECK(hat->get_position() == Vector3(0, 7, 0));
	const std::unique_ptr<scene::Node> copy = skeleton.duplicate();
	CHECK(dynamic_cast<scene::Skeleton3D &>(*copy).find_bone("head") == 1);
	CHECK(copy->get_child(0)->get("position") == Variant(Vector3(0, 7, 0)));
	hat->set("bone_idx", 0);
	CHECK(hat->get_bone_name() == "hip");
	CHECK(hat->get_position() == Vector3(0, 5, 0));
}
