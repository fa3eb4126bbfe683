// SPDX-License-Identifier: MIT
// What the registry knows of Node.
#include "modules/scene/scene_tree.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

void Node::bind(ClassBuilder<Node> &r_class) {
	r_class.doc("A part of a scene: a name, a parent, children, groups.");
	r_class.property("name", &Node::set_name, &Node::get_name).not_stored().doc("The name; siblings have different ones.");
	r_class.property("owner", &Node::set_owner, &Node::get_owner).not_stored().doc("The root of the scene file that the node belongs to.");
	r_class.property("unique_name_in_owner", &Node::set_unique_name_in_owner, &Node::is_unique_name_in_owner).doc("Whether %Name finds the node from everywhere in its scene.");
	r_class.property("scene_file_path", &Node::set_scene_file_path, &Node::get_scene_file_path).not_stored().doc("The file that the node was instantiated from, if it is a scene's root.");
	r_class.property("process_priority", &Node::set_process_priority, &Node::get_process_priority).doc("Nodes of lower priority get their frame first.");
	r_class.method("get_parent", &Node::get_parent).doc("The parent, or null.");
	r_class.method("get_child_count", &Node::get_child_count).doc("How many children there are.");
	r_class.method("get_child", &Node::get_child, { "idx" }).doc("One child by its place, or null.");
	r_class.method("get_node", &Node::get_node, { "path" }).doc("The node at a path; an error and null if it is not there.");
	r_class.method("get_node_or_null", &Node::get_node_or_null, { "path" }).doc("The node at a path, or null.");
	r_class.method("has_node", &Node::has_node, { "path" }).doc("Whether there is a node at a path.");
	r_class.method("find_child", &Node::find_child, { "name" }).doc("The first node below of that name, or null.");
	r_class.method("get_path", &Node::get_path).doc("The path from the tree's root.");
	r_class.method("queue_free", &Node::queue_free).doc("Deletes the node and all below it at the end of the frame.");
	r_class.method("add_to_group", &Node::add_to_group, { "group" }).doc("Puts the node into a group.");
	r_class.method("remove_from_group", &Node::remove_from_group, { "group" }).doc("Takes the node out of a group.");
	r_class.method("is_in_group", &Node::is_in_group, { "group" }).doc("Whether the node is in a group.");
	r_class.method("is_inside_tree", &Node::is_inside_tree).doc("Whether the node is part of a running scene.");
	r_class.method("is_node_ready", &Node::is_node_ready).doc("Whether NOTIFICATION_READY came.");
	r_class.method("set_process", &Node::set_process, { "enable" }).doc("Whether NOTIFICATION_PROCESS comes each frame.");
	r_class.method("is_processing", &Node::is_processing).doc("Whether NOTIFICATION_PROCESS comes each frame.");
	r_class.method("propagate_notification", &Node::propagate_notification, { "what" }).doc("Sends a notification to the node and all below it.");
	const auto node_argument = [] { return std::vector<ArgumentInfo>{ { "node", Variant::Type::OBJECT, "Node" } }; };
	r_class.signal("ready").doc("The node and all below it are in the tree for the first time.");
	r_class.signal("renamed").doc("The name changed.");
	r_class.signal("tree_entered").doc("The node entered the tree.");
	r_class.signal("tree_exiting").doc("The node is about to leave the tree.");
	r_class.signal("tree_exited").doc("The node left the tree.");
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
