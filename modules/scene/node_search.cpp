// SPDX-License-Identifier: MIT
// Finding nodes by pattern, moving them between parents, copying them.
#include "modules/scene/node_3d.h"
#include "modules/scene/scene_tree.h"
#include "servers/core/class_db.h"

#include <algorithm>

namespace lucent::scene {

// * stands for any characters, ? for one.
static bool matches(std::string_view p_text, std::string_view p_pattern) {
	// The last * is the only place to come back to: a longer match of an earlier one can't help.
	size_t text = 0, pattern = 0, star = std::string_view::npos, after_star = 0;
	while (text < p_text.size()) {
		if (pattern < p_pattern.size() && p_pattern[pattern] == '*') {
			star = pattern++;
			after_star = text;
		} else if (pattern < p_pattern.size() && (p_pattern[pattern] == '?' || p_pattern[pattern] == p_text[text])) {
			pattern++;
			text++;
		} else if (star != std::string_view::npos) {
			pattern = star + 1;
			text = ++after_star;
		} else {
			return false;
		}
	}
	return p_pattern.find_first_not_of('*', pattern) == std::string_view::npos;
}

Node *Node::find_child(const std::string &p_pattern, bool p_recursive, bool p_owned) const {
	for (const auto &child : children) {
		if ((!p_owned || child->get_owner()) && matches(child->name, p_pattern)) {
			return child.get();
		}
		Node *found = p_recursive ? child->find_child(p_pattern, true, p_owned) : nullptr;
		if (found) {
			return found;
		}
	}
	return nullptr;
}

std::vector<Node *> Node::find_children(
		const std::string &p_pattern, const std::string &p_type, bool p_recursive, bool p_owned) const {
	std::vector<Node *> found;
	for (const auto &child : children) {
		if ((!p_owned || child->get_owner()) && matches(child->name, p_pattern) &&
				(p_type.empty() || child->is_class(p_type))) {
			found.push_back(child.get());
		}
		if (p_recursive) {
			const std::vector<Node *> below = child->find_children(p_pattern, p_type, true, p_owned);
			found.insert(found.end(), below.begin(), below.end());
		}
	}
	return found;
}

Node *Node::find_parent(const std::string &p_pattern) const {
	Node *node = parent;
	while (node && !matches(node->name, p_pattern)) {
		node = node->parent;
	}
	return node;
}

NodePath Node::get_path_to(const Node *p_node) const {
	const auto line = [](const Node *p_end) {
		std::vector<const Node *> nodes;
		for (const Node *node = p_end; node; node = node->parent) {
			nodes.insert(nodes.begin(), node);
		}
		return nodes;
	};
	ERR_FAIL_COND_V_MSG(!p_node, NodePath(), "there is no path to null");
	const std::vector<const Node *> from = line(this), to = line(p_node);
	size_t common = 0;
	while (common < from.size() && common < to.size() && from[common] == to[common]) {
		common++;
	}
	ERR_FAIL_COND_V_MSG(common == 0, NodePath(), "'{}' and '{}' have no common parent", name, p_node->name);
	std::string text;
	for (size_t i = common; i < from.size(); i++) {
		text += text.empty() ? ".." : "/..";
	}
	for (size_t i = common; i < to.size(); i++) {
		text += (text.empty() ? "" : "/") + to[i]->name;
	}
	return NodePath(text.empty() ? "." : text);
}

int Node::get_index() const {
	if (!parent) {
		return -1;
	}
	const auto &siblings = parent->children;
	return int(std::find_if(siblings.begin(), siblings.end(), [&](const auto &p_other) {
		return p_other.get() == this;
	}) - siblings.begin());
}

Status Node::move_child(Node *p_child, int p_index) {
	if (!p_child || p_child->parent != this) {
		return make_error("Node.move_child(): '{}' has no such child", name);
	}
	if (children_locked > 0) {
		return make_error("Node.move_child(): '{}' is busy with its children", name);
	}
	const int count = get_child_count();
	const int to = p_index < 0 ? p_index + count : p_index;
	if (to < 0 || to >= count) {
		return make_error("Node.move_child(): '{}' has {} children, so there is no place {}", name, count, p_index);
	}
	const int from = p_child->get_index();
	const auto at = [&](int p_place) { return children.begin() + p_place; };
	if (from < to) {
		std::rotate(at(from), at(from + 1), at(to + 1));
	} else {
		std::rotate(at(to), at(from), at(from + 1));
	}
	emit_signal("child_order_changed");
	return Ok();
}

Status Node::reparent(Node *p_new_parent) {
	if (!parent || !p_new_parent || p_new_parent == this || is_ancestor_of(p_new_parent)) {
		return make_error("Node.reparent(): '{}' needs a parent, and a new one that isn't below it", name);
	}
	if (parent->children_locked > 0) {
		return make_error("Node.reparent(): '{}' is busy with its children", parent->name);
	}
	if (parent == p_new_parent) {
		return Ok();
	}
	Node *old_owner = get_owner();
	p_new_parent->add_child(parent->remove_child(this));
	owner = old_owner && old_owner->is_ancestor_of(this) ? old_owner->get_instance_id() : ObjectID();
	return Ok();
}

std::unique_ptr<Node> Node::duplicate(uint32_t p_flags) const {
	std::unique_ptr<Node> copy = ClassDB::instantiate_as<Node>(get_class());
	ERR_FAIL_COND_V_MSG(!copy, nullptr, "'{}' can't be copied: {} is abstract", name, get_class());
	std::vector<PropertyInfo> dynamic;
	_get_property_list(dynamic);
	for (const PropertyInfo *property : ClassDB::get_property_list(get_class())) {
		if (property->usage & PROPERTY_USAGE_STORAGE) {
			copy->set(property->name, property->get(*this));
		}
	}
	for (const PropertyInfo &property : dynamic) {
		copy->set(property.name, get(property.name));
	}
	copy->name = name;
	copy->scene_file_path = scene_file_path;
	copy->processing = processing;
	if (p_flags & DUPLICATE_GROUPS) {
		copy->groups = groups;
	}
	for (const auto &child : children) {
		if (std::unique_ptr<Node> below = child->duplicate(p_flags)) {
			Node *added = copy->add_child(std::move(below));
			added->owner = child->get_owner() == this ? copy->get_instance_id() : ObjectID();
		}
	}
	if ((p_flags & DUPLICATE_SCRIPTS) && get_script_instance()) {
		get_script_instance()->copy_to(*copy);
	}
	return copy;
}

bool Node::can_process() const {
	if (!tree) {
		return false;
	}
	const Node *node = this;
	while (node->process_mode == ProcessMode::INHERIT && node->parent) {
		node = node->parent;
	}
	switch (node->process_mode) {
		case ProcessMode::DISABLED:
			return false;
		case ProcessMode::ALWAYS:
			return true;
		case ProcessMode::WHEN_PAUSED:
			return tree->is_paused();
		default: // the root's INHERIT is PAUSABLE
			return !tree->is_paused();
	}
}

void Node::notify_script(int p_what) {
	static const std::pair<int, ScriptCallback> CALLBACKS[] = {
		{ NOTIFICATION_PROCESS, ScriptCallback::PROCESS },
		{ NOTIFICATION_ENTER_TREE, ScriptCallback::ENTER_TREE },
		{ NOTIFICATION_READY, ScriptCallback::READY },
		{ NOTIFICATION_EXIT_TREE, ScriptCallback::EXIT_TREE },
	};
	for (const auto &[what, callback] : CALLBACKS) {
		if (what == p_what && get_script_instance()->has_callback(callback)) {
			get_script_instance()->callback(
					callback, callback == ScriptCallback::PROCESS ? get_process_delta_time() : 0.0);
		}
	}
	if (get_script_instance()) { // a callback may have taken it away
		Object::notify_script(p_what);
	}
}

} // namespace lucent::scene
