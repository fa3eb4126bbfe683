// SPDX-License-Identifier: MIT
#include "modules/scene/scene_tree.h"

#include "modules/scene/camera_3d.h"
#include "modules/scene/viewport.h"
#include "modules/scene/visual_instance_3d.h"
#include "modules/scene/world_environment.h"

#include <algorithm>

namespace lucent::scene {

SceneTree::SceneTree(RenderingServer *p_server) {
	if (p_server) {
		context = std::make_unique<SceneContext>(*p_server);
		scenario = p_server->scenario_create();
	}
	root = std::make_unique<Node>();
	root->set_name("root");
	root->enter_tree(this);
	root->send_ready();
}

SceneTree::~SceneTree() {
	// While the root still answers: those who leave may ask for paths and groups.
	while (root->get_child_count() > 0) {
		root->remove_child(root->get_child(root->get_child_count() - 1));
	}
	root.reset();
	if (context) {
		context->server().free(scenario);
	}
}

void SceneTree::set_current_scene(std::unique_ptr<Node> p_scene) {
	if (Node *old = get_current_scene()) {
		ScriptOwned::destroy(root->remove_child(old));
	}
	current_scene = {};
	if (p_scene) {
		current_scene = p_scene->get_instance_id();
		root->add_child(std::move(p_scene));
	}
	emit_signal("scene_changed");
}

Node *SceneTree::get_current_scene() const {
	return static_cast<Node *>(ObjectDB::get(current_scene));
}

// p_visit on p_node and all below it, parents first.
template <typename F>
static void visit_nodes(Node *p_node, F &&p_visit) {
	p_visit(p_node);
	for (const auto &child : p_node->get_children()) {
		visit_nodes(child.get(), p_visit);
	}
}

void SceneTree::process(double p_delta_seconds) {
	process_time = p_delta_seconds;
	frame++;
	emit_signal("process_frame");
	std::vector<Node *> nodes;
	visit_nodes(root.get(), [&](Node *p_node) {
		if (p_node->is_processing()) {
			nodes.push_back(p_node);
		}
	});
	std::stable_sort(nodes.begin(), nodes.end(), [](const Node *p_a, const Node *p_b) { return p_a->get_process_priority() < p_b->get_process_priority(); });
	std::vector<ObjectID> ids;
	for (const Node *node : nodes) {
		ids.push_back(node->get_instance_id());
	}
	for (const ObjectID id : ids) { // any of them may end during another's turn
		Node *node = static_cast<Node *>(ObjectDB::get(id));
		if (node && node->get_tree() == this && node->can_process()) {
			node->notification(Node::NOTIFICATION_PROCESS);
		}
	}
	const std::vector<ObjectID> doomed = std::move(deletions);
	deletions.clear();
	for (const ObjectID id : doomed) {
		Node *node = static_cast<Node *>(ObjectDB::get(id));
		if (node && node->get_parent()) {
			ScriptOwned::destroy(node->get_parent()->remove_child(node));
		}
	}
	flush();
}

void SceneTree::flush() {
	// A notified node may move others; those are sent in the same frame.
	for (size_t i = 0; i < moved.size(); i++) {
		Node3D *node = static_cast<Node3D *>(ObjectDB::get(moved[i]));
		if (node && node->get_tree() == this) {
			node->send_transform_changed();
		}
	}
	moved.clear();
	update_visibility_ranges();
	if (context) {
		context->flush();
	}
}

void SceneTree::update_visibility_ranges() {
	if (current_camera && !ranged.empty()) {
		const Vector3 eye = current_camera->get_camera_transform().origin;
		for (GeometryInstance3D *node : ranged) {
			node->update_visibility_range(eye);
		}
	}
}

std::vector<Node *> SceneTree::get_nodes_in_group(const std::string &p_group) const {
	std::vector<Node *> nodes;
	visit_nodes(root.get(), [&](Node *p_node) {
		if (p_node->is_in_group(p_group)) {
			nodes.push_back(p_node);
		}
	});
	return nodes;
}

void SceneTree::node_entered(Node *p_node) {
	node_count++;
	emit_signal("node_added", { Variant(p_node) });
}

void SceneTree::node_left(Node *p_node) {
	node_count--;
	emit_signal("node_removed", { Variant(p_node) });
}

Camera3D *SceneTree::get_camera_3d() const {
	return current_camera;
}

void SceneTree::set_camera(Camera3D *p_camera) {
	current_camera = p_camera;
}

void SceneTree::camera_entered(Camera3D *p_camera) {
	cameras.push_back(p_camera);
	if (!current_camera || p_camera->wants_current()) {
		set_camera(p_camera);
	}
}

void SceneTree::camera_left(Camera3D *p_camera) {
	std::erase(cameras, p_camera);
	if (current_camera == p_camera) {
		set_camera(cameras.empty() ? nullptr : cameras.front());
	}
}

WorldEnvironment *SceneTree::get_world_environment() const {
	const auto found = std::find_if(world_environments.begin(), world_environments.end(), [](const WorldEnvironment *p_node) { return p_node->get_environment() != nullptr && is_in_tree_world(*p_node); });
	return found == world_environments.end() ? nullptr : *found;
}

void SceneTree::environment_entered(WorldEnvironment *p_node) {
	world_environments.push_back(p_node);
	update_environment();
}

void SceneTree::environment_left(WorldEnvironment *p_node) {
	std::erase(world_environments, p_node);
	update_environment();
}

void SceneTree::update_environment() {
	if (context) {
		const WorldEnvironment *node = get_world_environment();
		context->server().scenario_set_environment(scenario, node ? node->get_environment()->get_rid(*context) : EnvironmentRid());
	}
}

} // namespace lucent::scene
