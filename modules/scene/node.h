// SPDX-License-Identifier: MIT
#pragma once

#include "servers/core/object.h"

#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace lucent::scene {

class SceneTree;

// A part of a scene. Parents own their children; everyone else holds plain pointers for the moment or ObjectIDs for longer.
class Node : public Object {
	LUCENT_CLASS(Node, Object)
public:
	// Godot's numbers. Order when a subtree enters: ENTER_TREE parents first, then READY children first (once in a life);
	// when it leaves: EXIT_TREE children first, last child first.
	enum {
		NOTIFICATION_ENTER_TREE = 10,
		NOTIFICATION_EXIT_TREE = 11,
		NOTIFICATION_READY = 13,
		NOTIFICATION_PROCESS = 17,
		NOTIFICATION_PARENTED = 18,
		NOTIFICATION_UNPARENTED = 19,
		NOTIFICATION_SCENE_INSTANTIATED = 20,
	};

	Node() = default;
	~Node() override;

	const std::string &get_name() const { return name; }
	// Characters that paths use ( . : @ / " % ) are left out; a name that a sibling has gets a number.
	void set_name(const std::string &p_name);

	// Takes the child and answers it. A cycle is an error and answers null.
	Node *add_child(std::unique_ptr<Node> p_child);
	template <typename T>
	T *add(std::unique_ptr<T> p_child) { return static_cast<T *>(add_child(std::move(p_child))); }
	// Makes a T as the last child. Without a name it is called as its class.
	template <typename T>
	T *create_child(const std::string &p_name) {
		std::unique_ptr<T> child = std::make_unique<T>();
		if (!p_name.empty()) {
			child->set_name(p_name);
		}
		return add(std::move(child));
	}
	// Null: not a child.
	std::unique_ptr<Node> remove_child(Node *p_child);
	// Deleted with its children at the end of the frame; at once outside of a tree, where it must have a parent.
	void queue_free();

	Node *get_parent() const { return parent; }
	int get_child_count() const { return int(children.size()); }
	Node *get_child(int p_index) const; // null: out of range
	const std::vector<std::unique_ptr<Node>> &get_children() const { return children; }
	bool is_ancestor_of(const Node *p_node) const;

	// The root of the scene file that the node belongs to; null: it is such a root itself, or was made by code.
	Node *get_owner() const;
	void set_owner(Node *p_owner);
	const std::string &get_scene_file_path() const { return scene_file_path; }
	void set_scene_file_path(const std::string &p_path) { scene_file_path = p_path; }
	bool is_unique_name_in_owner() const { return unique_name_in_owner; }
	void set_unique_name_in_owner(bool p_unique) { unique_name_in_owner = p_unique; }

	bool is_inside_tree() const { return tree != nullptr; }
	SceneTree *get_tree() const { return tree; }
	bool is_node_ready() const { return ready_sent; }
	// "/root/Main/Sun"; outside of a tree, from the topmost parent.
	NodePath get_path() const;

	// Names, "..", "%Unique"; absolute paths need a tree. Null: not there. Subnames are not looked at.
	Node *get_node_or_null(const NodePath &p_path);
	// The same, with an error if it is not there.
	Node *get_node(const NodePath &p_path);
	bool has_node(const NodePath &p_path) { return get_node_or_null(p_path) != nullptr; }
	// The first one below, depth first, of exactly that name.
	Node *find_child(const std::string &p_name);

	void add_to_group(const std::string &p_group) { groups.insert(p_group); }
	void remove_from_group(const std::string &p_group) { groups.erase(p_group); }
	bool is_in_group(const std::string &p_group) const { return groups.contains(p_group); }
	const std::set<std::string> &get_groups() const { return groups; }

	// Whether NOTIFICATION_PROCESS comes each frame; lower priorities first, then tree order.
	void set_process(bool p_enabled) { processing = p_enabled; }
	bool is_processing() const { return processing; }
	void set_process_priority(int p_priority) { process_priority = p_priority; }
	int get_process_priority() const { return process_priority; }
	double get_process_delta_time() const; // seconds

	// This node and everything below it, parents first.
	void propagate_notification(int p_what);

private:
	friend class SceneTree;
	std::string unique_child_name(const Node *p_child, const std::string &p_wanted);
	Node *find_unique(Node *p_owner, const std::string &p_name);
	Node *step(const std::string &p_name);
	void enter_tree(SceneTree *p_tree);
	void exit_tree();
	void send_ready();

	std::string name;
	Node *parent = nullptr;
	SceneTree *tree = nullptr;
	std::vector<std::unique_ptr<Node>> children;
	std::unordered_map<std::string, Node *> children_by_name;
	std::unordered_map<std::string, int> last_numbers; // by stem: where the search for a free name goes on
	ObjectID owner;
	std::string scene_file_path;
	std::set<std::string> groups;
	int process_priority = 0;
	bool processing = false;
	bool unique_name_in_owner = false;
	bool ready_sent = false;
};

} // namespace lucent::scene
