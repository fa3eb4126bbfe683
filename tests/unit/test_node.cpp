// SPDX-License-Identifier: MIT
#include "modules/scene/camera_3d.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/packed_scene.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/scene_tree.h"

#include <doctest/doctest.h>

#include <glm/gtc/constants.hpp>

using namespace lucent;

namespace {

std::vector<std::string> heard;

// Writes down what it hears.
class Listener : public scene::Node3D {
public:
	explicit Listener(const std::string &p_name) {
		set_name(p_name);
		set_notify_transform(true);
	}
	~Listener() override { heard.push_back(get_name() + " ends"); }

protected:
	void _notification(int p_what) override {
		scene::Node3D::_notification(p_what);
		switch (p_what) {
			case NOTIFICATION_ENTER_TREE:
				heard.push_back(get_name() + " enters");
				break;
			case NOTIFICATION_EXIT_TREE:
				heard.push_back(get_name() + " exits");
				break;
			case NOTIFICATION_READY:
				heard.push_back(get_name() + " ready");
				break;
			case NOTIFICATION_PROCESS:
				heard.push_back(get_name() + " processes");
				break;
			case NOTIFICATION_TRANSFORM_CHANGED:
				heard.push_back(get_name() + " moved");
				break;
		}
	}
};

std::vector<std::string> take_heard() {
	return std::exchange(heard, {});
}

using Words = std::vector<std::string>;

struct Silence {
	LogHandler previous = set_log_handler([](LogLevel, std::string_view) {});
	~Silence() { set_log_handler(previous); }
};

} // namespace

TEST_CASE("notifications come in Godot's order") {
	scene::register_scene_classes();
	take_heard();
	scene::SceneTree tree;
	auto family = std::make_unique<Listener>("a");
	Listener *a = family.get();
	Listener *b = a->add(std::make_unique<Listener>("b"));
	b->add(std::make_unique<Listener>("c"));
	a->add(std::make_unique<Listener>("d"));
	CHECK(take_heard().empty());
	tree.get_root()->add_child(std::move(family));
	CHECK(take_heard() == Words{ "a enters", "b enters", "c enters", "d enters", "c ready", "b ready", "d ready", "a ready" });
	CHECK(tree.get_node_count() == 5);
	std::unique_ptr<scene::Node> removed = tree.get_root()->remove_child(a);
	CHECK(take_heard() == Words{ "d exits", "c exits", "b exits", "a exits" });
	CHECK(tree.get_node_count() == 1);
	tree.get_root()->add_child(std::move(removed));
	CHECK(take_heard() == Words{ "a enters", "b enters", "c enters", "d enters" }); // ready comes once
	b->set_process(true);
	a->set_process(true);
	a->set_process_priority(1);
	tree.process(0.5);
	CHECK(take_heard() == Words{ "b processes", "a processes" });
	CHECK(a->get_process_delta_time() == 0.5);
	a->set_process(false);
	b->set_process(false);
	b->queue_free();
	CHECK(take_heard().empty());
	const ObjectID id = b->get_instance_id();
	tree.process(0.1);
	CHECK(take_heard() == Words{ "c exits", "b exits", "b ends", "c ends" });
	CHECK(ObjectDB::get(id) == nullptr);
}

TEST_CASE("parents own their children") {
	scene::register_scene_classes();
	const uint32_t before = ObjectDB::get_object_count();
	{
		scene::SceneTree tree;
		scene::Node *a = tree.get_root()->create_child<scene::Node>("a");
		a->create_child<scene::Node3D>("b")->create_child<scene::Node3D>("c");
		CHECK(ObjectDB::get_object_count() == before + 5);
		const std::unique_ptr<scene::Node> removed = tree.get_root()->remove_child(a);
		CHECK_FALSE(removed->is_inside_tree());
		CHECK(removed->get_parent() == nullptr);
		const Silence silence;
		CHECK(tree.get_root()->remove_child(a) == nullptr);
	}
	CHECK(ObjectDB::get_object_count() == before);
	const Silence silence;
	auto *above = new scene::Node; // add_child below lets go of it
	above->set_name("above");
	scene::Node *below = above->create_child<scene::Node>("below");
	CHECK(below->add_child(std::unique_ptr<scene::Node>(above)) == nullptr);
	CHECK(above->get_child_count() == 1);
	delete above;
	CHECK(ObjectDB::get_object_count() == before);
}

TEST_CASE("names and paths") {
	scene::register_scene_classes();
	scene::SceneTree tree;
	auto made = std::make_unique<scene::Node>();
	made->set_name("Main");
	scene::Node *main = made.get();
	tree.set_current_scene(std::move(made));
	CHECK(tree.get_current_scene() == main);
	scene::Node *box = main->create_child<scene::Node3D>("Box");
	scene::Node *second = main->create_child<scene::Node3D>("Box");
	scene::Node *third = main->create_child<scene::Node3D>("Box");
	CHECK(second->get_name() == "Box2");
	CHECK(third->get_name() == "Box3");
	scene::Node *lamp = box->create_child<scene::OmniLight3D>("");
	CHECK(lamp->get_name() == "OmniLight3D");
	CHECK(lamp->get_path().text == "/root/Main/Box/OmniLight3D");
	CHECK(main->get_node_or_null(NodePath("Box/OmniLight3D:light_color")) == lamp);
	CHECK(lamp->get_node_or_null(NodePath("../../Box2")) == second);
	CHECK(lamp->get_node_or_null(NodePath("/root/Main/Box3")) == third);
	CHECK(lamp->get_node_or_null(NodePath("Box4")) == nullptr);
	CHECK(lamp->get_node_or_null(NodePath("../../../../..")) == nullptr);
	second->set_name("Box");
	CHECK(second->get_name() != "Box");
	second->set_name("Cr:a/te");
	CHECK(second->get_name() == "Crate");
	CHECK(main->get_node_or_null(NodePath("Crate")) == second);
	CHECK(main->get_node_or_null(NodePath("Box2")) == nullptr);
	lamp->set_owner(main);
	lamp->set_unique_name_in_owner(true);
	third->set_owner(main);
	CHECK(third->get_node_or_null(NodePath("%OmniLight3D")) == lamp);
	CHECK(main->get_node_or_null(NodePath("%OmniLight3D")) == lamp);
	CHECK(main->find_child("OmniLight3D") == lamp);
	third->add_to_group("crates");
	lamp->add_to_group("crates");
	CHECK(tree.get_nodes_in_group("crates") == std::vector<scene::Node *>{ lamp, third });
	tree.call_group("crates", "set_light_energy", { 3.0 }); // third has no such method
	CHECK(lamp->get("light_energy") == Variant(3.0));
	tree.set_current_scene(nullptr);
	CHECK(tree.get_current_scene() == nullptr);
	CHECK(tree.get_node_count() == 1);
}

TEST_CASE("transforms: chain, Euler angles, scale") {
	scene::register_scene_classes();
	scene::Node3D parent;
	parent.set_position(Vector3(1, 2, 3));
	parent.set_rotation_degrees(Vector3(0, 90, 0));
	scene::Node3D *child = parent.create_child<scene::Node3D>("child");
	child->set_position(Vector3(0, 0, -2));
	CHECK(glm::length(child->get_global_position() - Vector3(-1, 2, 3)) < 1e-5f);
	parent.set_scale(Vector3(2, 2, 2));
	CHECK(glm::length(child->get_global_position() - Vector3(-3, 2, 3)) < 1e-5f);
	CHECK(parent.get_rotation_degrees().y == doctest::Approx(90));
	child->set_as_top_level(true);
	CHECK(child->get_global_position() == Vector3(0, 0, -2));
	child->set_as_top_level(false);
	child->set_global_position(Vector3(5, 5, 5));
	CHECK(glm::length(child->get_global_position() - Vector3(5, 5, 5)) < 1e-5f);
	for (int order = 0; order < 6; order++) {
		const Vector3 euler(0.3f, -1.1f, 2.0f);
		const Basis basis = scene::basis_from_euler(euler, scene::EulerOrder(order));
		const Vector3 back = scene::euler_from_basis(basis, scene::EulerOrder(order));
		const Basis again = scene::basis_from_euler(back, scene::EulerOrder(order));
		for (int column = 0; column < 3; column++) {
			CHECK(glm::length(again[column] - basis[column]) < 1e-5f);
		}
		Vector3 pole(0.4f, 0.4f, 0.4f);
		pole[(order == 0 || order == 5) ? 1 : (order == 1 || order == 3) ? 2
																		 : 0] = glm::half_pi<float>();
		const Basis at_pole = scene::basis_from_euler(pole, scene::EulerOrder(order));
		const Basis pole_again = scene::basis_from_euler(scene::euler_from_basis(at_pole, scene::EulerOrder(order)), scene::EulerOrder(order));
		for (int column = 0; column < 3; column++) {
			CHECK(glm::length(pole_again[column] - at_pole[column]) < 1e-3f);
		}
	}
	// Godot's YXZ: y turns first of all.
	const Basis yaw_pitch = scene::basis_from_euler(Vector3(glm::half_pi<float>(), glm::half_pi<float>(), 0), scene::EulerOrder::YXZ);
	CHECK(glm::length(yaw_pitch * Vector3(0, 0, -1) - Vector3(0, 1, 0)) < 1e-5f);
	scene::Node3D mirrored;
	mirrored.set_basis(Basis(Vector3(-2, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)));
	const Transform3D before = mirrored.get_transform();
	mirrored.set_rotation(mirrored.get_rotation());
	CHECK(glm::length(mirrored.get_transform().basis[0] - before.basis[0]) < 1e-5f);
	scene::Node3D eye;
	eye.set_position(Vector3(0, 0, 5));
	eye.look_at(Vector3(5, 0, 5));
	CHECK(glm::length(eye.get_global_basis()[2] - Vector3(-1, 0, 0)) < 1e-5f);
	CHECK(glm::determinant(eye.get_global_basis()) == doctest::Approx(1.0));
}

TEST_CASE("transform notifications come once a frame") {
	scene::register_scene_classes();
	scene::SceneTree tree;
	Listener *a = tree.get_root()->add(std::make_unique<Listener>("a"));
	Listener *b = a->add(std::make_unique<Listener>("b"));
	tree.flush();
	take_heard();
	a->set_position(Vector3(1, 0, 0));
	a->set_position(Vector3(2, 0, 0));
	b->set_scale(Vector3(2));
	CHECK(take_heard().empty());
	tree.flush();
	CHECK(take_heard() == Words{ "a moved", "b moved" });
	tree.flush();
	CHECK(take_heard().empty());
	b->set_scale(Vector3(3));
	tree.flush();
	CHECK(take_heard() == Words{ "b moved" });
}

TEST_CASE("packed scenes") {
	scene::register_scene_classes();
	scene::PackedScene empty;
	CHECK_FALSE(empty.instantiate().ok());
	scene::PackedScene packed([]() -> Result<std::unique_ptr<scene::Node>> {
		std::unique_ptr<scene::Node> root = std::make_unique<scene::Node3D>();
		root->create_child<scene::Camera3D>("Camera");
		return root;
	});
	packed.set_path("res://room.tscn");
	const std::unique_ptr<scene::Node> one = packed.instantiate().take();
	const std::unique_ptr<scene::Node> two = packed.instantiate().take();
	CHECK(one != two);
	CHECK(one->get_child_count() == 1);
	CHECK(two->get_scene_file_path() == "res://room.tscn");
}
