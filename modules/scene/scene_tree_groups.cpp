// SPDX-License-Identifier: MIT
// Groups and the change of scenes.
#include "modules/scene/packed_scene.h"
#include "modules/scene/resource_loader.h"
#include "modules/scene/scene_tree.h"
#include "servers/core/class_db.h"

namespace lucent::scene {

// By id: what is done to one may end another.
template <typename F>
static void visit_group(const SceneTree &p_tree, const std::string &p_group, F &&p_visit) {
	std::vector<ObjectID> ids;
	for (const Node *node : p_tree.get_nodes_in_group(p_group)) {
		ids.push_back(node->get_instance_id());
	}
	for (const ObjectID id : ids) {
		if (Node *node = static_cast<Node *>(ObjectDB::get(id))) {
			p_visit(*node);
		}
	}
}

void SceneTree::call_group(const std::string &p_group, const std::string &p_method, const Array &p_arguments) {
	visit_group(*this, p_group, [&](Node &r_node) {
		if (r_node.has_method(p_method)) {
			const Result<Variant> result = r_node.call(p_method, p_arguments);
			ERR_FAIL_COND_MSG(!result, "{}", result.error().message);
		}
	});
}

Status SceneTree::set_group(const std::string &p_group, const std::string &p_property, const Variant &p_value) {
	Status first = Ok();
	visit_group(*this, p_group, [&](Node &r_node) {
		const Status status = r_node.set_property(p_property, p_value);
		if (first && !status) {
			first = status.error();
		}
	});
	return first;
}

void SceneTree::notify_group(const std::string &p_group, int p_what) {
	visit_group(*this, p_group, [&](Node &r_node) { r_node.notification(p_what); });
}

bool SceneTree::set_current_scene_node(Node *p_scene) {
	if (!p_scene) {
		set_current_scene(nullptr);
		return true;
	}
	std::unique_ptr<Object> scene = ScriptOwned::take(p_scene->get_instance_id());
	ERR_FAIL_COND_V_MSG(!scene, false, "'{}' already has an owner", p_scene->get_name());
	set_current_scene(std::unique_ptr<Node>(static_cast<Node *>(scene.release())));
	return true;
}

Status SceneTree::change_scene_to_packed(const Ref<Resource> &p_scene) {
	const auto packed = std::dynamic_pointer_cast<PackedScene>(p_scene);
	if (!packed) {
		return make_error("expected a scene, found {}", p_scene ? p_scene->get_class() : "null");
	}
	Result<std::unique_ptr<Node>> scene = packed->instantiate();
	if (!scene) {
		return scene.error();
	}
	set_current_scene(scene.take());
	return Ok();
}

Status SceneTree::change_scene_to_file(const std::string &p_path) {
	const Result<Ref<Resource>> resource = ResourceLoader::load(p_path);
	if (!resource) {
		return resource.error();
	}
	const Status status = change_scene_to_packed(resource.value());
	return status ? Status(Ok()) : Status(make_error("{}: {}", p_path, status.error().message));
}

Status SceneTree::reload_current_scene() {
	const Node *scene = get_current_scene();
	if (!scene || scene->get_scene_file_path().empty()) {
		return make_error("the current scene comes from no file");
	}
	return change_scene_to_file(scene->get_scene_file_path());
}

} // namespace lucent::scene
