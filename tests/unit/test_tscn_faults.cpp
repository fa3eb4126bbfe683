// SPDX-License-Identifier: MIT
// What is wrong in text scenes, or not to be found: the rest is shown, and what is said about it.
#include "modules/scene/load_report.h"
#include "modules/scene/material.h"
#include "servers/core/class_db.h"
#include "servers/rendering/rendering_server.h"
#include "tests/test_support.h"
#include "tests/unit/tscn_test_files.h"

using namespace lucent;
using namespace lucent::test;

TEST_CASE("tscn: one line a class, counted; silent without effect; lost geometry last") {
	const Project project;
	const LogCapture log;
	std::string text = "[gd_scene format=3]\n[node name=\"Root\" type=\"Node3D\"]\n";
	for (int i = 0; i < 5; i++) {
		text += fmt::format("[node name=\"Smoke{}\" type=\"GPUParticles3D\" parent=\".\"]\namount = 3\n[node name=\"Body{}\" type=\"StaticBody3D\" parent=\".\"]\n"
							"[node name=\"Box{}\" type=\"MeshInstance3D\" parent=\"Body{}\"]\nlod_bias = 2.0\nfancy = 1\nfancier = 2\n[node name=\"Odd{}\" type=\"MyOwn3D\" parent=\".\"]\n",
				i, i, i, i, i);
	}
	build(project.file("many.tscn", text));
	CHECK(log.messages.size() == 5);
	CHECK(log.infos == 2); // StaticBody3D, lod_bias
	CHECK(log.errors == 0);
	CHECK(log.count("many.tscn:4: class StaticBody3D") + log.count("many.tscn:5: class StaticBody3D") == 1);
	CHECK(log.count("class MyOwn3D is not supported: 5 left out") == 1);
	CHECK(log.count("MeshInstance3D has no property 'fancy', 'fancier'; skipped (10 times)") == 1);
	CHECK(log.messages.back().find("many.tscn:3: MISSING GEOMETRY: class GPUParticles3D is not supported (particles): 5 left out") != std::string::npos);
}

TEST_CASE("tscn: an unreadable part is an error line; the rest is there") {
	const Project project;
	const LogCapture log;
	project.file("broken.tscn", "[gd_scene format=3]\n[node name=\"R\" type=\"Node3D\"\n");
	project.file("model.dae", "<COLLADA/>");
	project.file("bad.png", "no picture");
	const int errors_before = scene::LoadReport::error_count();
	const auto root = build(project.file("level.tscn", R"([gd_scene format=3]
[ext_resource type="PackedScene" path="broken.tscn" id="1"]
[ext_resource type="PackedScene" path="model.dae" id="2"]
[ext_resource type="Texture2D" path="bad.png" id="3"]
[ext_resource type="AudioStream" path="missing.wav" id="4"]
[sub_resource type="StandardMaterial3D" id="m"]
albedo_texture = ExtResource("3")
[node name="Root" type="Node3D"]
[node name="A" parent="." instance=ExtResource("1")]
transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 7, 0)
[node name="B" parent="." instance=ExtResource("2")]
[node name="Sound" type="AudioStreamPlayer" parent="."]
stream = ExtResource("4")
[node name="Box" type="MeshInstance3D" parent="A"]
material_override = SubResource("m")
)"));
	CHECK(log.errors == 3);
	CHECK(scene::LoadReport::error_count() - errors_before == 3);
	CHECK(log.count("level.tscn:2: 'broken.tscn' is left out: ") == 1);
	CHECK(log.count("level.tscn:3: 'model.dae' is left out: ") == 1);
	CHECK(log.count("level.tscn:4: 'bad.png' is left out: ") == 1);
	CHECK(property(*root, "A", "position") == Variant(Vector3(0, 7, 0)));
	CHECK(root->get_node_or_null(NodePath("A/Box")) != nullptr);
	CHECK(root->get_node_or_null(NodePath("B")) != nullptr);
}

TEST_CASE("tscn: Object() is read as null; values beyond the inspector's sliders are kept") {
	const Project project;
	const LogCapture log;
	const auto root = build(project.file("values.tscn", R"([gd_scene format=3]
[sub_resource type="ProceduralSkyMaterial" id="sky"]
sun_curve = 3.5
metadata/x = Object(Resource,"resource_name":"a (b","list":[1, Vector2(1, 2)],"inner":Object(Node,"script":null))
sky_curve = 0.25
[sub_resource type="StandardMaterial3D" id="m"]
roughness = 2.0
[sub_resource type="SphereMesh" id="mesh"]
radial_segments = 1
material = SubResource("m")
[node name="Root" type="MeshInstance3D"]
mesh = SubResource("mesh")
)"));
	CHECK(log.count("values.tscn:4: Object(…) is read as null") == 1);
	CHECK(log.count("values.tscn:9: SphereMesh.radial_segments can't be 1; it becomes 4") == 1);
	CHECK(log.errors == 0);
	CHECK(log.messages.size() - size_t(log.infos) == 2);
	const Variant mesh = root->get("mesh");
	REQUIRE(mesh.get_object() != nullptr);
	CHECK(mesh.get_object()->get("radial_segments") == Variant(int64_t(4)));
	const Variant material = mesh.get_object()->get("material");
	REQUIRE(material.get_object() != nullptr);
	CHECK(material.get_object()->get("roughness") == Variant(2.0));
	CHECK(failure(project.file("open.tscn", "[gd_scene format=3]\n[node name=\"A\" type=\"Node\"]\nx = Object(Resource, \"a\": (1)\n")).find("expected ')'") != std::string::npos);
}

TEST_CASE("ORMMaterial3D: one texture for occlusion, roughness and metallic; white without it") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	scene::SceneContext context(server);
	scene::ORMMaterial3D material;
	CHECK(material.set("metallic", 0.25)); // of no effect here
	CHECK(material.set("ao_enabled", true));
	lucent::Material resolved = material.resolve(context);
	CHECK(resolved.metallic == 1.0f);
	CHECK(resolved.roughness == 1.0f);
	CHECK_FALSE(resolved.textures[size_t(TextureSlot::ROUGHNESS)].texture.is_valid());
	const auto image = std::make_shared<const Image>(Image{ ImageFormat::RGBA8, 1, 1, std::vector<std::byte>(4) });
	CHECK(material.set("orm_texture", std::make_shared<scene::ImageTexture>(image)));
	resolved = material.resolve(context);
	const std::pair<TextureSlot, TextureChannel> expected[] = { { TextureSlot::OCCLUSION, TextureChannel::RED }, { TextureSlot::ROUGHNESS, TextureChannel::GREEN }, { TextureSlot::METALLIC, TextureChannel::BLUE } };
	for (const std::pair<TextureSlot, TextureChannel> &entry : expected) {
		CHECK(resolved.textures[size_t(entry.first)].texture.is_valid());
		CHECK(resolved.textures[size_t(entry.first)].channel == entry.second);
	}
}

TEST_CASE("what is left out: README's list is the loaders' list") {
	std::ifstream file(test::options().root + "README.md");
	const std::string readme((std::istreambuf_iterator<char>(file)), {});
	const size_t start = readme.find("## What does not, yet");
	REQUIRE(start != std::string::npos);
	const std::string section = readme.substr(start, readme.find("\n## ", start + 4) - start);
	scene::register_scene_classes();
	for (const scene::LeftOutKind &kind : scene::left_out_kinds()) {
		INFO(kind.what);
		CHECK(section.find(kind.what) != std::string::npos);
	}
	for (const std::string &name : ClassDB::get_class_list()) {
		INFO(name);
		CHECK((!ClassDB::can_instantiate(name) || scene::find_left_out(name) == nullptr)); // what works isn't on the list
	}
}

TEST_CASE("tscn: moved files are found by their UIDs") {
	const Project project;
	project.file("project.godot", "config_version=5\n");
	project.file("new/box.tscn", "[gd_scene format=3 uid=\"uid://box1\"]\n[node name=\"Box\" type=\"MeshInstance3D\"]\n");
	project.file("new/red.tres", "[gd_resource type=\"StandardMaterial3D\" format=3 uid=\"uid://red1\"]\n[resource]\nroughness = 0.25\n");
	project.file("new/sky.tres", "[gd_resource type=\"Sky\" format=3]\n[resource]\n");
	project.file("new/sky.tres.uid", "uid://sky1\n");
	project.file("new/env.tres", "[gd_resource type=\"Environment\" format=3]\n[resource]\n");
	project.file("new/env.tres.import", "[remap]\n\nimporter=\"x\"\nuid=\"uid://env1\"\n");
	project.file("old/other.tres", "[gd_resource type=\"StandardMaterial3D\" format=3 uid=\"uid://other\"]\n[resource]\nroughness = 0.75\n");
	const LogCapture log;
	const auto root = build(project.file("level.tscn", R"([gd_scene format=3]
[ext_resource type="PackedScene" uid="uid://box1" path="res://old/box.tscn" id="1"]
[ext_resource type="Material" uid="uid://red1" path="uid://red1" id="2"]
[ext_resource type="Material" uid="uid://red1" path="res://old/other.tres" id="3"]
[ext_resource type="Sky" uid="uid://sky1" path="res://old/sky.tres" id="4"]
[ext_resource type="Environment" uid="uid://env1" path="res://old/env.tres" id="5"]
[ext_resource type="Material" uid="uid://gone" path="res://old/gone.tres" id="6"]
[sub_resource type="Environment" id="e"]
sky = ExtResource("4")
[node name="Root" type="Node3D"]
[node name="A" parent="." instance=ExtResource("1")]
material_override = ExtResource("2")
[node name="B" parent="." instance=ExtResource("1")]
material_override = ExtResource("3")
[node name="C" parent="." instance=ExtResource("1")]
material_override = ExtResource("6")
[node name="E" type="WorldEnvironment" parent="."]
environment = ExtResource("5")
[node name="F" type="WorldEnvironment" parent="."]
environment = SubResource("e")
)"));
	for (const char *name : { "A", "B" }) { // the UID counts before the path
		const Variant material = property(*root, name, "material_override");
		REQUIRE(material.get_object() != nullptr);
		CHECK(material.get_object()->get("roughness") == Variant(0.25));
	}
	CHECK(property(*root, "E", "environment").get_object() != nullptr);
	const Variant environment = property(*root, "F", "environment");
	REQUIRE(environment.get_object() != nullptr);
	CHECK(environment.get_object()->get("sky").get_object() != nullptr);
	CHECK(log.errors == 1);
	CHECK(log.messages.size() == 1);
	CHECK(log.count("uid://gone") == 1);
}
