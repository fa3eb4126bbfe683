// SPDX-License-Identifier: MIT
#include "modules/scene/node.h"

#include "modules/scene/scene_tree.h"

#include <algorithm>

namespace lucent::scene {

Node::~Node() {
	if (tree) {
		exit_tree();
	}
	// Last child first, and one at a time: a child's end may look at its siblings.
	while (!children.empty()) {
		children.pop_back();
	}
}

std::string Node::unique_child_name(const Node *p_child, const std::string &p_wanted) {
	const auto taken = [&](const std::string &p_name) {
		const auto found = children_by_name.find(p_name);
		return found != children_by_name.end() && found->second != p_child;
	};
	if (!taken(p_wanted)) {
		return p_wanted;
	}
	// "Box" gives Box2, Box3; "Box7" goes on with Box8.
	const size_t digits = p_wanted.find_last_not_of("0123456789") + 1;
	const std::string stem = p_wanted.substr(0, digits);
	const std::string number = p_wanted.substr(digits, 9);
	int &last = last_numbers[stem];
	last = std::max(last, number.empty() ? 1 : std::stoi(number));
	do {
		last++;
	} while (taken(stem + std::to_string(last)));
	return stem + std::to_string(last);
}

void Node::set_name(const std::string &p_name) {
	std::string cleaned = p_name;
	std::erase_if(cleaned, [](char p_char) { return std::string_view(".:@/\"%").find(p_char) != std::string_view::npos; });
	ERR_FAIL_COND_MSG(cleaned.empty(), "'{}' is not a name for a node", p_name);
	if (parent) {
		parent->children_by_name.erase(name);
		cleaned = parent->unique_child_name(this, cleaned);
		parent->children_by_name[cleaned] = this;
	}
	name = cleaned;
	emit_signal("renamed");
}

Node *Node::add_child(std::unique_ptr<Node> p_child) {
	ERR_FAIL_COND_V_MSG(!p_child, nullptr, "null is not a child");
	if (p_child.get() == this || p_child->is_ancestor_of(this)) {
		Node *child = p_child.release(); // owns this node: deleting it would delete the caller
		ERR_FAIL_COND_V_MSG(true, nullptr, "'{}' cannot become a child of '{}', which is below it", child->name, name);
	}
	Node *child = p_child.get();
	child->name = unique_child_name(child, child->name.empty() ? child->get_class() : child->name);
	child->parent = this;
	children_by_name[child->name] = child;
	children.push_back(std::move(p_child));
	{
		const ChildrenLock lock(*this);
		child->notification(NOTIFICATION_PARENTED);
		if (tree) {
			child->enter_tree(tree);
			child->send_ready();
		}
		emit_signal("child_entered_tree", { Variant(child) });
	}
	emit_signal("child_order_changed");
	return child;
}

std::unique_ptr<Node> Node::remove_child(Node *p_child) {
	ERR_FAIL_COND_V_MSG(!p_child || p_child->parent != this, nullptr, "'{}' has no such child", name);
	ERR_FAIL_COND_V_MSG(children_locked > 0, nullptr, "'{}' is busy with its children: '{}' can't be removed in the middle of it; queue_free() can be used", name, p_child->name);
	{
		const ChildrenLock lock(*this);
		emit_signal("child_exiting_tree", { Variant(p_child) });
		if (tree) {
			p_child->exit_tree();
		}
	}
	const auto found = std::find_if(children.begin(), children.end(), [&](const auto &p_other) { return p_other.get() == p_child; });
	std::unique_ptr<Node> child = std::move(*found);
	children.erase(found);
	children_by_name.erase(child->name);
	child->parent = nullptr;
	child->notification(NOTIFICATION_UNPARENTED);
	emit_signal("child_order_changed");
	return child;
}

void Node::queue_free() {
	if (tree) {
		tree->queue_delete(this);
	} else {
		std::unique_ptr<Object> owned = release_from_owner();
		ERR_FAIL_COND_MSG(!owned, "'{}' has no parent that could free it", name);
		ScriptOwned::destroy(std::move(owned));
	}
}

std::unique_ptr<Object> Node::release_from_owner() {
	return parent ? std::unique_ptr<Object>(parent->remove_child(this)) : ScriptOwned::take(get_instance_id());
}

Node *Node::get_child(int p_index) const {
	return p_index >= 0 && p_index < get_child_count() ? children[size_t(p_index)].get() : nullptr;
}

bool Node::is_ancestor_of(const Node *p_node) const {
	for (const Node *node = p_node ? p_node->parent : nullptr; node; node = node->parent) {
		if (node == this) {
			return true;
		}
	}
	return false;
}

Node *Node::get_owner() const {
	return static_cast<Node *>(ObjectDB::get(owner));
}

void Node::set_owner(Node *p_owner) {
	ERR_FAIL_COND_MSG(p_owner && !p_owner->is_ancestor_of(this), "the owner of '{}' must be above it", name);
	owner = p_owner ? p_owner->get_instance_id() : ObjectID();
}

NodePath Node::get_path() const {
	std::string text = name;
	for (const Node *node = parent; node; node = node->parent) {
		text = node->name + "/" + text;
	}
	return NodePath(tree ? "/" + text : text);
}

Node *Node::find_unique(Node *p_owner, const std::string &p_name) {
	for (const auto &child : children) {
		if (child->unique_name_in_owner && child->name == p_name && child->get_owner() == p_owner) {
			return child.get();
		}
		if (Node *found = child->find_unique(p_owner, p_name)) {
			return found;
		}
	}
	return nullptr;
}

Node *Node::step(const std::string &p_name) {
	if (p_name == "..") {
		return parent;
	}
	if (p_name[0] == '%') {
		Node *scene = get_owner();
		// A scene's root has its unique names below itself.
		Node *found = find_unique(this, p_name.substr(1));
		return found || !scene ? found : scene->find_unique(scene, p_name.substr(1));
	}
	const auto found = children_by_name.find(p_name);
	return found == children_by_name.end() ? nullptr : found->second;
}

Node *Node::get_node_or_null(const NodePath &p_path) {
	Node *node = this;
	const std::vector<std::string> names = p_path.get_names();
	size_t first = 0;
	if (p_path.is_absolute()) {
		node = tree ? tree->get_root() : nullptr;
		if (!node || names.empty() || names[0] != node->name) {
			return nullptr;
		}
		first = 1;
	}
	for (size_t i = first; i < names.size() && node; i++) {
		node = node->step(names[i]);
	}
	return node;
}

Node *Node::get_node(const NodePath &p_path) {
	Node *node = get_node_or_null(p_path);
	ERR_FAIL_COND_V_MSG(!node, nullptr, "'{}' has no node '{}'", get_path().text, p_path.text);
	return node;
}

double Node::get_process_delta_time() const {
	return tree ? tree->get_process_time() : 0.0;
}

void Node::propagate_notification(int p_what) {
	const ChildrenLock lock(*this);
	notification(p_what);
	for (size_t i = 0; i < children.size(); i++) { // a handler may add children
		children[i]->propagate_notification(p_what);
	}
}

void Node::enter_tree(SceneTree *p_tree) {
	const ChildrenLock lock(*this);
	tree = p_tree;
	notification(NOTIFICATION_ENTER_TREE);
	emit_signal("tree_entered");
	p_tree->node_entered(this);
	// By index: a handler may add children, which then enter by themselves.
	for (size_t i = 0; i < children.size(); i++) {
		if (!children[i]->tree) {
			children[i]->enter_tree(p_tree);
		}
	}
}

void Node::send_ready() {
	const ChildrenLock lock(*this);
	for (size_t i = 0; i < children.size(); i++) {
		children[i]->send_ready();
	}
	if (!ready_sent) {
		ready_sent = true;
		notification(NOTIFICATION_READY);
		emit_signal("ready");
	}
}

void Node::exit_tree() {
	const ChildrenLock lock(*this);
	for (size_t i = children.size(); i-- > 0;) {
		children[i]->exit_tree();
	}
	emit_signal("tree_exiting");
	notification(NOTIFICATION_EXIT_TREE);
	for (size_t i = children.size(); i-- > 0;) {
		if (children[i]->tree) { // added by a handler
			children[i]->exit_tree();
		}
	}
	tree->node_left(this);
	tree = nullptr;
	emit_signal("tree_exited");
}

} // namespace lucent::scene
