// SPDX-License-Identifier: MIT
// What the registry knows of SceneTree and ResourceLoader.
#include "modules/scene/camera_3d.h"
#include "modules/scene/packed_scene.h"
#include "modules/scene/resource_loader.h"
#include "modules/scene/scene_tree.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

static Result<Variant> call_group_vararg(SceneTree &r_tree, const Array &p_arguments) {
	r_tree.call_group(variant_or<std::string>(p_arguments[0], ""), variant_or<std::string>(p_arguments[1], ""), Array(p_arguments.begin() + 2, p_arguments.end()));
	return Variant();
}

static void bind_groups(ClassBuilder<SceneTree> &r_class) {
	r_class.vararg_method("call_group", &call_group_vararg, { { "group", Variant::Type::STRING, "" }, { "method", Variant::Type::STRING, "" } }).doc("Calls a method on every node of a group that has it; what follows are its arguments.");
	r_class.method("set_group", &SceneTree::set_group, { "group", "property", "value" }).doc("Sets a property of every node of a group.");
	r_class.method("notify_group", &SceneTree::notify_group, { "group", "notification" }).doc("Sends a notification to every node of a group.");
	r_class.method("get_nodes_in_group", &SceneTree::get_nodes_in_group, { "group" }).doc("All nodes of a group, in the tree's order.");
	r_class.method(
				   "get_first_node_in_group", +[](const SceneTree &p_tree, const std::string &p_group) {
					   const std::vector<Node *> nodes = p_tree.get_nodes_in_group(p_group);
					   return nodes.empty() ? nullptr : nodes.front(); }, { "group" })
			.doc("The first node of a group, or null.");
	r_class.method(
				   "has_group", +[](const SceneTree &p_tree, const std::string &p_group) { return !p_tree.get_nodes_in_group(p_group).empty(); }, { "name" })
			.doc("Whether a node is in a group.");
	r_class.method(
				   "get_node_count_in_group", +[](const SceneTree &p_tree, const std::string &p_group) { return int64_t(p_tree.get_nodes_in_group(p_group).size()); }, { "group" })
			.doc("How many nodes are in a group.");
}

void SceneTree::bind(ClassBuilder<SceneTree> &r_class) {
	r_class.doc("The running scene: a root node, its frames, and what the renderer shows of it.");
	r_class.property("current_scene", &SceneTree::set_current_scene_node, &SceneTree::get_current_scene).not_stored().doc("The root of the scene that runs, or null. Another one replaces it.");
	r_class.property("paused", &SceneTree::set_pause, &SceneTree::is_paused).doc("While it is on, nodes get frames as their process_mode says.");
	r_class.read_only("root", &SceneTree::get_root).doc("The node above all others.");
	r_class.method("change_scene_to_file", &SceneTree::change_scene_to_file, { "path" }).doc("Runs the scene of a file in place of the current one.");
	r_class.method(
				   "change_scene_to_packed", +[](SceneTree &r_tree, const Ref<PackedScene> &p_scene) { return r_tree.change_scene_to_packed(p_scene); }, { "packed_scene" })
			.doc("Runs a copy of a scene in place of the current one.");
	r_class.method("reload_current_scene", &SceneTree::reload_current_scene).doc("Runs a new copy of the current scene's file.");
	r_class.method(
				   "unload_current_scene", +[](SceneTree &r_tree) { r_tree.set_current_scene(nullptr); })
			.doc("Ends the current scene.");
	r_class.method("process", &SceneTree::process, { "delta" }).doc("A frame of that many seconds: _process, deletions, then what changed goes to the renderer.");
	r_class.method(
				   "queue_delete", +[](SceneTree &r_tree, Node *p_node) -> Status {
					   if (!p_node) {
						   return make_error("SceneTree.queue_delete(): null can't be deleted");
					   }
					   r_tree.queue_delete(p_node);
					   return Ok(); }, { "obj" })
			.doc("Deletes a node at the end of the frame.");
	bind_groups(r_class);
	r_class.method("get_node_count", &SceneTree::get_node_count).doc("How many nodes are in the tree, the root included.");
	r_class.method("get_frame", &SceneTree::get_frame).doc("How many frames have been processed.");
	r_class.method("get_camera_3d", &SceneTree::get_camera_3d).doc("The camera that shows, or null.");
	const auto node_argument = [] { return std::vector<ArgumentInfo>{ { "node", Variant::Type::OBJECT, "Node" } }; };
	r_class.signal("node_added", node_argument()).doc("A node entered the tree.");
	r_class.signal("node_removed", node_argument()).doc("A node left the tree.");
	r_class.signal("process_frame").doc("A frame begins.");
	r_class.signal("scene_changed").doc("Another scene runs now.");
}

void ResourceLoader::bind(ClassBuilder<ResourceLoader> &r_class) {
	r_class.doc("Reads files into resources: scenes (.tscn, .glb, .gltf) become a PackedScene, pictures a Texture2D.");
	r_class.static_method("load", &ResourceLoader::load, { "path" }).doc("The resource of a file. While someone holds it, loading the file again answers the same one.");
	r_class.static_method("get_recognized_extensions", &ResourceLoader::get_extensions).doc("What can be read, without the dots.");
}

} // namespace lucent::scene
