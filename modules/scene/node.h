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
	// Who gets frames: as the parent, while the tree isn't paused, only while it is, always, never.
	enum class ProcessMode : uint8_t {
		INHERIT,
		PAUSABLE,
		WHEN_PAUSED,
		ALWAYS,
		DISABLED,
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
	// Null: not a child, or the children are just being told of something (an error).
	std::unique_ptr<Node> remove_child(Node *p_child);
	// The child's new place; negative ones count from the end.
	Status move_child(Node *p_child, int p_index);
	int get_index() const; // among the parent's children; -1 without one
	// To the end of another parent's children; keeps the owner where that is above the new parent. See reparent_keeping_place.
	Status reparent(Node *p_new_parent);
	// A copy of the node and all below it, outside of any tree, as far as p_flags say: DUPLICATE_GROUPS, DUPLICATE_SCRIPTS.
	// Resources are shared.
	std::unique_ptr<Node> duplicate(uint32_t p_flags = DUPLICATE_SIGNALS | DUPLICATE_GROUPS | DUPLICATE_SCRIPTS) const;
	enum DuplicateFlags : uint32_t {
		DUPLICATE_SIGNALS = 1, // connections by connect_callable
		DUPLICATE_GROUPS = 2,
		DUPLICATE_SCRIPTS = 4,
	};
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
	// Below, depth first. p_pattern: a name, in which * stands for any characters and ? for one. p_owned: only those with an owner.
	Node *find_child(const std::string &p_pattern, bool p_recursive = true, bool p_owned = false) const;
	// p_type: a class; empty: any.
	std::vector<Node *> find_children(const std::string &p_pattern, const std::string &p_type = "", bool p_recursive = true, bool p_owned = false) const;
	Node *find_parent(const std::string &p_pattern) const; // null: none
	NodePath get_path_to(const Node *p_node) const; // empty, with an error: no common parent

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
	void set_process_mode(ProcessMode p_mode) { process_mode = p_mode; }
	ProcessMode get_process_mode() const { return process_mode; }
	bool can_process() const; // in a tree, and the mode allows it now
	void request_ready() { ready_sent = false; } // NOTIFICATION_READY comes again when the node next enters a tree

	// This node and everything below it, parents first.
	void propagate_notification(int p_what);

protected:
	void notify_script(int p_what) override;
	std::unique_ptr<Object> release_from_owner() override;

	// While one lives, children stay where they are: someone goes through them.
	class ChildrenLock {
	public:
		explicit ChildrenLock(Node &r_node) :
				node(r_node) { node.children_locked++; }
		~ChildrenLock() { node.children_locked--; }
		ChildrenLock(const ChildrenLock &) = delete;
		ChildrenLock &operator=(const ChildrenLock &) = delete;

	private:
		Node &node;
	};

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
	int children_locked = 0;
	ProcessMode process_mode = ProcessMode::INHERIT;
	bool processing = false;
	bool unique_name_in_owner = false;
	bool ready_sent = false;
};

} // namespace lucent::scene
