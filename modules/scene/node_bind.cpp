// SPDX-License-Identifier: MIT
// What the registry knows of Node.
#include "modules/scene/node_3d.h"
#include "modules/scene/scene_tree.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

using Builder = ClassBuilder<Node>;

static void bind_family(Builder &r_class) {
	r_class.method("get_parent", &Node::get_parent).doc("The parent, or null.");
	r_class.method(
				   "add_child", +[](Node &r_node, std::unique_ptr<Node> p_child) -> Status {
					   if (p_child.get() == &r_node || p_child->is_ancestor_of(&r_node)) {
						   const std::string name = p_child->get_name();
						   ScriptOwned::adopt(std::move(p_child));
						   return make_error("Node.add_child(): '{}' cannot become a child of '{}', which is below it", name, r_node.get_name());
					   }
					   r_node.add_child(std::move(p_child));
					   return Ok(); }, { "node" })
			.doc("Gives the node a child, which must have no parent. A name that a sibling has gets a number.");
	r_class.method(
				   "add_sibling", +[](Node &r_node, std::unique_ptr<Node> p_sibling) -> Status {
					   Node *parent = r_node.get_parent();
					   if (!parent || p_sibling->is_ancestor_of(&r_node)) {
						   ScriptOwned::adopt(std::move(p_sibling));
						   return make_error("Node.add_sibling(): '{}' has no parent that could take it", r_node.get_name());
					   }
					   Node *added = parent->add_child(std::move(p_sibling));
					   return parent->move_child(added, r_node.get_index() + 1); }, { "sibling" })
			.doc("Gives the parent a child, placed after this node.");
	r_class.method(
				   "remove_child", +[](Node &r_node, Node *p_child) -> Status {
					   if (!p_child || p_child->get_parent() != &r_node) {
						   return make_error("Node.remove_child(): '{}' has no such child", r_node.get_name());
					   }
					   std::unique_ptr<Node> child = r_node.remove_child(p_child);
					   if (!child) {
						   return make_error("Node.remove_child(): '{}' is busy with its children; queue_free() can be used", r_node.get_name());
					   }
					   ScriptOwned::adopt(std::move(child));
					   return Ok(); }, { "node" })
			.doc("Takes a child away. It lives on as long as a script holds it.");
	r_class.method(
				   "reparent", +[](Node &r_node, Node *p_parent, bool p_keep_global_transform) -> Status {
					   Node3D *spatial = p_keep_global_transform ? dynamic_cast<Node3D *>(&r_node) : nullptr;
					   const Transform3D place = spatial ? spatial->get_global_transform() : Transform3D();
					   const Status status = r_node.reparent(p_parent);
					   if (status && spatial) {
						   spatial->set_global_transform(place);
					   }
					   return status; }, { "new_parent", "keep_global_transform" })
			.defaults({ true })
			.doc("Moves the node below another parent, and lets it stay where it is in the world if wanted.");
	r_class.method("move_child", &Node::move_child, { "child_node", "to_index" }).doc("Gives a child another place among its siblings; negative places count from the end.");
	r_class.method("duplicate", &Node::duplicate, { "flags" }).defaults({ Node::DUPLICATE_SIGNALS | Node::DUPLICATE_GROUPS | Node::DUPLICATE_SCRIPTS }).doc("A copy of the node and all below it. Resources are shared. flags: DuplicateFlags.");
	r_class.method("get_child_count", &Node::get_child_count).doc("How many children there are.");
	r_class.method(
				   "get_child", +[](const Node &p_node, int p_index) { return p_node.get_child(p_index < 0 ? p_index + p_node.get_child_count() : p_index); }, { "idx" })
			.doc("One child by its place, or null; negative places count from the end.");
	r_class.method(
				   "get_children", +[](const Node &p_node) {
					   std::vector<Node *> children;
					   for (const std::unique_ptr<Node> &child : p_node.get_children()) {
						   children.push_back(child.get());
					   }
					   return children; })
			.doc("All children.");
	r_class.method("get_index", &Node::get_index).doc("The place among the parent's children; -1 without a parent.");
	r_class.method("is_ancestor_of", &Node::is_ancestor_of, { "node" }).doc("Whether a node is below this one.");
	r_class.method("queue_free", &Node::queue_free).doc("Deletes the node and all below it at the end of the frame; at once outside of a tree.");
}

static void print_below(const Node &p_node, const std::string &p_indent, bool p_pretty, std::string &r_text) {
	for (int i = 0; i < p_node.get_child_count(); i++) {
		const bool last = i + 1 == p_node.get_child_count();
		const Node &child = *p_node.get_child(i);
		r_text += p_pretty ? p_indent + (last ? " ┖╴" : " ┠╴") + child.get_name() + "\n" : p_indent + child.get_name() + "\n";
		print_below(child, p_pretty ? p_indent + (last ? "   " : " ┃ ") : p_indent + child.get_name() + "/", p_pretty, r_text);
	}
}

static std::string tree_string(const Node &p_node, bool p_pretty) {
	std::string text = p_pretty ? p_node.get_name() + "\n" : ".\n";
	print_below(p_node, "", p_pretty, text);
	return text;
}

static void bind_search(Builder &r_class) {
	r_class.method("get_node", &Node::get_node, { "path" }).doc("The node at a path; an error and null if it is not there.");
	r_class.method("get_node_or_null", &Node::get_node_or_null, { "path" }).doc("The node at a path, or null.");
	r_class.method("has_node", &Node::has_node, { "path" }).doc("Whether there is a node at a path.");
	r_class.method("find_child", &Node::find_child, { "pattern", "recursive", "owned" }).defaults({ true, true }).doc("The first node below whose name matches (* and ? stand for any characters), or null. owned: only nodes of a scene file.");
	r_class.method("find_children", &Node::find_children, { "pattern", "type", "recursive", "owned" }).defaults({ "", true, true }).doc("All nodes below whose name matches and that are of a class. owned: only nodes of a scene file.");
	r_class.method("find_parent", &Node::find_parent, { "pattern" }).doc("The nearest node above whose name matches, or null.");
	r_class.method("get_path", &Node::get_path).doc("The path from the tree's root.");
	r_class.method("get_path_to", &Node::get_path_to, { "node" }).doc("The path from this node to another.");
	r_class.method("get_tree", &Node::get_tree).doc("The tree that the node is in, or null.");
	r_class.method(
				   "get_tree_string", +[](const Node &p_node) { return tree_string(p_node, false); })
			.doc("The node and all below it, a path a line.");
	r_class.method(
				   "get_tree_string_pretty", +[](const Node &p_node) { return tree_string(p_node, true); })
			.doc("The node and all below it, drawn as a tree.");
	r_class.method("add_to_group", &Node::add_to_group, { "group" }).doc("Puts the node into a group.");
	r_class.method("remove_from_group", &Node::remove_from_group, { "group" }).doc("Takes the node out of a group.");
	r_class.method("is_in_group", &Node::is_in_group, { "group" }).doc("Whether the node is in a group.");
	r_class.method("get_groups", &Node::get_groups).doc("The groups that the node is in.");
}

static void bind_callbacks(Builder &r_class) {
	r_class.virtual_method("_enter_tree").doc("Called when the node entered the tree; parents first.");
	r_class.virtual_method("_exit_tree").doc("Called when the node leaves the tree; children first.");
	r_class.virtual_method("_ready").doc("Called once, when the node and all below it are in the tree; children first.");
	r_class.virtual_method("_process", { { "delta", Variant::Type::FLOAT, "" } }).doc("Called each frame with the seconds since the last one.");
	r_class.method("is_inside_tree", &Node::is_inside_tree).doc("Whether the node is part of a running scene.");
	r_class.method("is_node_ready", &Node::is_node_ready).doc("Whether NOTIFICATION_READY came.");
	r_class.method("request_ready", &Node::request_ready).doc("Lets NOTIFICATION_READY come again when the node next enters a tree.");
	r_class.method("set_process", &Node::set_process, { "enable" }).doc("Whether NOTIFICATION_PROCESS comes each frame.");
	r_class.method("is_processing", &Node::is_processing).doc("Whether NOTIFICATION_PROCESS comes each frame.");
	r_class.method("can_process", &Node::can_process).doc("Whether the node gets frames now: see process_mode.");
	r_class.method("get_process_delta_time", &Node::get_process_delta_time).doc("The seconds since the last frame.");
	r_class.method("propagate_notification", &Node::propagate_notification, { "what" }).doc("Sends a notification to the node and all below it.");
	r_class.enumeration("DuplicateFlags", { { "DUPLICATE_SIGNALS", Node::DUPLICATE_SIGNALS, "Connections too." }, { "DUPLICATE_GROUPS", Node::DUPLICATE_GROUPS, "Groups too." }, { "DUPLICATE_SCRIPTS", Node::DUPLICATE_SCRIPTS, "Scripts too." } });
}

void Node::bind(ClassBuilder<Node> &r_class) {
	r_class.doc("A part of a scene: a name, a parent, children, groups.");
	r_class.property("name", &Node::set_name, &Node::get_name).not_stored().doc("The name; siblings have different ones.");
	r_class.property("owner", &Node::set_owner, &Node::get_owner).not_stored().doc("The root of the scene file that the node belongs to.");
	r_class.property("unique_name_in_owner", &Node::set_unique_name_in_owner, &Node::is_unique_name_in_owner).doc("Whether %Name finds the node from everywhere in its scene.");
	r_class.property("scene_file_path", &Node::set_scene_file_path, &Node::get_scene_file_path).not_stored().doc("The file that the node was instantiated from, if it is a scene's root.");
	r_class.property("process_priority", &Node::set_process_priority, &Node::get_process_priority).doc("Nodes of lower priority get their frame first.");
	r_class.enumeration("ProcessMode", { { "PROCESS_MODE_INHERIT", ProcessMode::INHERIT, "As the parent; without one as PAUSABLE." }, { "PROCESS_MODE_PAUSABLE", ProcessMode::PAUSABLE, "Frames while the tree isn't paused." }, { "PROCESS_MODE_WHEN_PAUSED", ProcessMode::WHEN_PAUSED, "Frames while the tree is paused." }, { "PROCESS_MODE_ALWAYS", ProcessMode::ALWAYS, "Frames always." }, { "PROCESS_MODE_DISABLED", ProcessMode::DISABLED, "No frames." } });
	r_class.property("process_mode", &Node::set_process_mode, &Node::get_process_mode).enum_of("ProcessMode").doc("When the node and those below it that inherit get frames.");
	bind_family(r_class);
	bind_search(r_class);
	bind_callbacks(r_class);
	const auto node_argument = [] { return std::vector<ArgumentInfo>{ { "node", Variant::Type::OBJECT, "Node" } }; };
	r_class.signal("ready").doc("The node and all below it are in the tree for the first time.");
	r_class.signal("renamed").doc("The name changed.");
	r_class.signal("tree_entered").doc("The node entered the tree.");
	r_class.signal("tree_exiting").doc("The node is about to leave the tree.");
	r_class.signal("tree_exited").doc("The node left the tree.");
	r_class.signal("child_order_changed").doc("A child was added, moved or removed.");
	r_class.signal("child_entered_tree", node_argument()).doc("A child was added.");
	r_class.signal("child_exiting_tree", node_argument()).doc("A child is about to be removed.");
	r_class.constant("NOTIFICATION_ENTER_TREE", NOTIFICATION_ENTER_TREE).doc("The node entered the tree; parents first.");
	r_class.constant("NOTIFICATION_EXIT_TREE", NOTIFICATION_EXIT_TREE).doc("The node leaves the tree; children first.");
	r_class.constant("NOTIFICATION_READY", NOTIFICATION_READY).doc("All children are ready; once in a node's life.");
	r_class.constant("NOTIFICATION_PROCESS", NOTIFICATION_PROCESS).doc("A frame, while set_process is on.");
	r_class.constant("NOTIFICATION_PARENTED", NOTIFICATION_PARENTED).doc("The node got a parent.");
	r_class.constant("NOTIFICATION_UNPARENTED", NOTIFICATION_UNPARENTED).doc("The node lost its parent.");
	r_class.constant("NOTIFICATION_SCENE_INSTANTIATED", NOTIFICATION_SCENE_INSTANTIATED).doc("The scene whose root this is has been built.");
}

} // namespace lucent::scene
