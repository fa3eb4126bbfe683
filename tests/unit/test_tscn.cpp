// SPDX-License-Identifier: MIT
#include "tests/unit/tscn_test_files.h"

using namespace lucent;
using namespace lucent::test;

TEST_CASE("tscn: nodes, parents, sub-resources, groups") {
	const Project project;
	const LogCapture log;
	const auto root = build(project.file("scene.tscn", R"([gd_scene load_steps=2 format=3 uid="uid://abc"]

; a comment
[sub_resource type="BoxMesh" id="Box_1"]
size = Vector3(1, 2, 3)

[sub_resource type="Environment" id="Env"]
background_mode = 1
background_color = Color(0.5, 0.25, 0, 1)
sdfgi_enabled = true
sdfgi_y_scale = 0

[node name="Root" type="Node3D"]

[node name="World" type="WorldEnvironment" parent="."]
environment = SubResource("Env")

[node name="A" type="MeshInstance3D" parent="." groups=["boxes", "things"]]
transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 4, 5, 6)
mesh = SubResource("Box_1")

[node name="B" type="MeshInstance3D" parent="A" unique_id=42]
mesh = SubResource("Box_1")
gi_mode = 0
visible = false

[node name="Lamp" type="OmniLight3D" parent="A/B"]
light_color = Color(1, 0, 0, 1)
omni_range = 12.0

[connection signal="pressed" from="A" to="." method="_on_pressed"]
)"));
	CHECK(log.messages.empty());
	CHECK(root->get_name() == "Root");
	CHECK(property(*root, "A/B/Lamp", "omni_range") == Variant(12.0));
	CHECK(property(*root, "A", "transform").get_component("origin") == Variant(Vector3(4, 5, 6)));
	CHECK(property(*root, "A/B", "visible") == Variant(false));
	CHECK(property(*root, "A/B", "gi_mode") == Variant(0));
	CHECK(property(*root, "A", "mesh").get_object() == property(*root, "A/B", "mesh").get_object());
	CHECK(property(*root, "A", "mesh").get_object()->get("size") == Variant(Vector3(1, 2, 3)));
	const Object *environment = property(*root, "World", "environment").get_object();
	REQUIRE(environment != nullptr);
	CHECK(environment->get("sdfgi_enabled") == Variant(true));
	CHECK(environment->get("sdfgi_y_scale") == Variant(0));
	CHECK(root->get_node_or_null(NodePath("A"))->is_in_group("boxes"));
}

TEST_CASE("tscn: instances share resources and take overrides") {
	const Project project;
	project.file("project.godot", "");
	project.file("parts/lamp.tscn", R"([gd_scene format=3]
[ext_resource type="Material" path="res://parts/red.tres" id="m"]
[sub_resource type="SphereMesh" id="1"]
[node name="Lamp" type="Node3D"]
[node name="Bulb" type="MeshInstance3D" parent="."]
mesh = SubResource("1")
material_override = ExtResource("m")
[node name="Light" type="SpotLight3D" parent="Bulb"]
spot_range = 3.0
)");
	project.file("parts/red.tres", R"([gd_resource type="StandardMaterial3D" format=3]
[resource]
resource_name = "red"
albedo_color = Color(1, 0, 0, 1)
)");
	const LogCapture log;
	const auto root = build(project.file("scenes/main.tscn", R"([gd_scene format=3]
[ext_resource type="PackedScene" uid="uid://x" path="res://parts/lamp.tscn" id="1_a"]
[node name="Main" type="Node3D"]
[node name="L1" parent="." instance=ExtResource("1_a")]
transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0)
[node name="L2" parent="." instance=ExtResource("1_a")]
[node name="Light" parent="L2/Bulb" index="0"]
spot_range = 9.0
[node name="Extra" type="Node3D" parent="L2/Bulb"]
[editable path="L2"]
)"));
	const std::string first = log.messages.empty() ? "" : log.messages[0];
	CHECK(first == "");
	CHECK(property(*root, "L1/Bulb/Light", "spot_range") == Variant(3.0));
	CHECK(property(*root, "L2/Bulb/Light", "spot_range") == Variant(9.0));
	CHECK(property(*root, "L1", "transform").get_component("origin") == Variant(Vector3(1, 0, 0)));
	CHECK(root->get_node_or_null(NodePath("L2/Bulb/Extra")) != nullptr);
	CHECK(property(*root, "L1/Bulb", "mesh").get_object() == property(*root, "L2/Bulb", "mesh").get_object());
	CHECK(property(*root, "L1/Bulb", "material_override").get_object()->get("albedo_color") == Variant(Color{ 1, 0, 0, 1 }));
}

TEST_CASE("tscn: an inherited scene") {
	const Project project;
	project.file("base.tscn", "[gd_scene format=3]\n[node name=\"Base\" type=\"Node3D\"]\n[node name=\"Lamp\" type=\"OmniLight3D\" parent=\".\"]\n");
	const auto root = build(project.file("derived.tscn", "[gd_scene format=3]\n[ext_resource type=\"PackedScene\" path=\"base.tscn\" id=\"1\"]\n"
														 "[node name=\"Derived\" instance=ExtResource(\"1\")]\n[node name=\"Lamp\" parent=\".\" index=\"0\"]\nomni_range = 2.0\n"));
	CHECK(root->get_name() == "Derived");
	CHECK(property(*root, "Lamp", "omni_range") == Variant(2.0));
}

TEST_CASE("tscn: what is unknown is skipped with one warning a kind that has file and line") {
	const Project project;
	const LogCapture log;
	const auto root = build(project.file("odd.tscn", R"([gd_scene format=3]
[ext_resource type="Script" path="res://missing.gd" id="s"]
[ext_resource type="Texture2D" path="res://missing.png" id="t"]
[sub_resource type="FancyNoise" id="n"]
frequency = 0.005
[sub_resource type="StandardMaterial3D" id="m"]
albedo_texture = ExtResource("t")
bogus_material = 1
[node name="Root" type="Node3D"]
script = ExtResource("s")
[node name="Water" type="FancyWater3D" parent="."]
transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 7, 0)
waves = SubResource("n")
[node name="Box" type="MeshInstance3D" parent="Water"]
bogus = 1
material_override = SubResource("m")
[node name="Lost" type="Node3D" parent="Nowhere"]
[node name="Timer" type="Timer" parent="."]
metadata/_edit_lock_ = true
)"));
	CHECK(log.count("odd.tscn:4: ") == 1);
	CHECK(log.count("odd.tscn:3: ") == 1);
	CHECK(log.count("odd.tscn:8: ") == 1);
	CHECK(log.count("odd.tscn:10: ") == 1);
	CHECK(log.count("odd.tscn:11: class FancyWater3D") == 1);
	CHECK(log.count("odd.tscn:15: MeshInstance3D has no property 'bogus'") == 1);
	CHECK(log.count("odd.tscn:17: ") == 1);
	CHECK(log.count("odd.tscn:18: class Timer") == 1); // at INFO, which is printed only when verbose
	CHECK(log.messages.size() == 8);
	CHECK(log.errors == 2); // the texture and the node without a parent
	CHECK(property(*root, "Water", "transform").get_component("origin") == Variant(Vector3(0, 7, 0)));
	CHECK(root->get_node_or_null(NodePath("Water/Box")) != nullptr);
	CHECK(root->get_node_or_null(NodePath("Nowhere/Lost")) == nullptr);
}

TEST_CASE("tscn: a GDScript is named with its node and what is lost") {
	const Project project;
	const LogCapture log;
	project.file("lamp.gd", "extends Node\nfunc _process(delta):\n\tpass\nfunc _ready():\n\tpass\nfunc helper():\n\tpass\n");
	build(project.file("lamp.tscn", R"([gd_scene format=3]
[ext_resource type="Script" path="res://lamp.gd" id="s"]
[node name="Lamp" type="Node3D"]
script = ExtResource("s")
process_priority = 3
)"));
	CHECK(log.count("lamp.tscn:4: scripts are not run: 'Lamp' loses _ready, _process of lamp.gd; lucent.attach() in Python can replace it") == 1);
	CHECK(log.messages.size() == 1);
}

TEST_CASE("tscn: scripts are one counted line; C# and scripts in the scene count, null does not") {
	const Project project;
	const LogCapture log;
	project.file("project.godot", "config_version=5\n");
	project.file("new/lamp.gd", "extends Node\nfunc _ready():\n\tpass\n");
	project.file("new/lamp.gd.uid", "uid://lamp1\n");
	build(project.file("many.tscn", R"([gd_scene format=3]
[ext_resource type="Script" uid="uid://lamp1" path="res://old/lamp.gd" id="1"]
[ext_resource type="Script" path="res://Door.cs" id="2"]
[sub_resource type="GDScript" id="3"]
script/source = "extends Node
func _process(delta):
	pass
"
[node name="Lamp" type="Node3D"]
script = ExtResource("1")
[node name="Door" type="Node3D" parent="."]
script = ExtResource("2")
speed = 3.0
[node name="Inner" type="Node3D" parent="."]
script = SubResource("3")
[node name="None" type="Node3D" parent="."]
script = null
)"));
	CHECK(log.count("many.tscn:10: scripts are not run: 'Lamp' loses _ready of lamp.gd; lucent.attach() in Python can replace it (3 times)") == 1);
	CHECK(log.count("many.tscn:12: scripts are not run: 'Door' loses Door.cs") == 1);
	CHECK(log.count("many.tscn:15: scripts are not run: 'Inner' loses a script") == 1);
	CHECK(log.count("many.tscn:13: Node3D has no property 'speed'") == 1); // the script's
	CHECK(log.messages.size() == 4);
	CHECK(log.infos == 3); // all but the first, for --verbose
	CHECK(log.errors == 0);
}

TEST_CASE("tscn: broken files say file and line") {
	const Project project;
	const auto text_failure = [&](const std::string &p_text) { return failure(project.file("bad.tscn", p_text)); };
	CHECK(text_failure("").find("bad.tscn:1: expected [gd_scene") != std::string::npos);
	CHECK(text_failure("[gd_scene format=3]\n").find("no [node]") != std::string::npos);
	CHECK(text_failure("[gd_scene format=2]\n[node name=\"A\" type=\"Node\"]\n").find("format 2") != std::string::npos);
	CHECK(text_failure("[gd_scene format=3]\n[node name=\"A\" type=\"Node3D\"\n").find("bad.tscn:3: ") != std::string::npos);
	CHECK(text_failure("[gd_scene format=3]\n[node name=\"A\" type=\"Node3D\"]\ntransform = Transform3D(1, 0").find("bad.tscn:3: ") != std::string::npos);
	CHECK(text_failure("[gd_scene format=3]\n[node name=\"A\" type=\"Node3D\"]\nstray words\n").find("bad.tscn:3: expected 'property = value'") != std::string::npos);
	CHECK(text_failure("[gd_scene format=3]\n[node name=\"A\" type=\"Node3D\"]\nx = SubResource(\"9\")\n").find("no [sub_resource] with id \"9\"") != std::string::npos);
	CHECK(text_failure("[gd_scene format=3]\n[node name=\"A\" type=\"Node3D\"]\n[node name=\"B\" type=\"Node3D\"]\n").find("bad.tscn:3: ") != std::string::npos);
	CHECK(text_failure("[gd_scene format=3]\n[ext_resource type=\"PackedScene\" path=\"res://none.glb\" id=\"1\"]\n[node name=\"A\" instance=ExtResource(\"1\")]\n").find("none.glb") != std::string::npos);
	CHECK(text_failure("[gd_resource type=\"Environment\" format=3]\n").find("no [resource]") != std::string::npos);
	CHECK(text_failure(std::string("\x1f\x8b\0\0", 4)).find("bad.tscn:1: ") != std::string::npos);
}

TEST_CASE("tscn: scenes that contain themselves or multiply are refused") {
	const Project project;
	const auto holder = [](const std::string &p_path) {
		return "[gd_scene format=3]\n[ext_resource type=\"PackedScene\" path=\"" + p_path + "\" id=\"1\"]\n[node name=\"R\" type=\"Node3D\"]\n"
																							"[node name=\"A\" parent=\".\" instance=ExtResource(\"1\")]\n[node name=\"B\" parent=\".\" instance=ExtResource(\"1\")]\n";
	};
	CHECK(failure(project.file("self.tscn", holder("self.tscn"))).find("cycle") != std::string::npos);
	project.file("a.tscn", holder("b.tscn"));
	project.file("b.tscn", holder("c.tscn"));
	CHECK(failure(project.file("c.tscn", holder("a.tscn"))).find("cycle") != std::string::npos);
	// 2^30 nodes from 30 small files.
	for (int i = 0; i < 30; i++) {
		project.file(fmt::format("n{}.tscn", i), holder(fmt::format("n{}.tscn", i + 1)));
	}
	project.file("n30.tscn", "[gd_scene format=3]\n[node name=\"R\" type=\"Node3D\"]\n");
	CHECK(failure((project.path / "n0.tscn").string()).find("more than") != std::string::npos);
}

TEST_CASE("tscn: where paths lead") {
	const Project project;
	const std::string scene = project.file("game/levels/a.tscn", "");
	const std::string game = (project.path / "game").string();
	CHECK(resolve_resource_path("res://x/y.png", scene, game + "/levels") == game + "/levels/x/y.png");
	CHECK(resolve_resource_path("y.png", scene, "/else") == game + "/levels/y.png");
	CHECK(resolve_resource_path("/abs/y.png", scene, "/else") == "/abs/y.png");
	project.file("game/project.godot", "");
	CHECK(resolve_resource_path("res://x/../y.png", scene, game + "/levels") == game + "/y.png");
}
