// SPDX-License-Identifier: MIT
#include "modules/scene/property_path.h"

#include "servers/core/class_db.h"

namespace lucent::scene {

namespace {

Result<Node *> find_node(Node &p_root, const NodePath &p_path) {
	Node *node = p_root.get_node_or_null(p_path);
	const std::vector<std::string> names = p_path.get_names();
	if (!node && !names.empty() && names[0] == p_root.get_name()) {
		std::string below;
		for (size_t i = 1; i < names.size(); i++) {
			below += names[i] + "/";
		}
		node = p_root.get_node_or_null(NodePath(below));
	}
	if (!node) {
		return make_error("'{}': the scene has no node '{}'", p_path.text, p_path.text.substr(0, p_path.text.find(':')));
	}
	return node;
}

// ":position:x" of "Box:position:x".
NodePath property_part(const NodePath &p_path) {
	return NodePath(p_path.text.substr(p_path.text.find(':')));
}

// Object's errors begin with the property's path; the node's is put before it.
template <typename T>
Result<T> worded(Result<T> p_result, const NodePath &p_path) {
	const std::string part = "'" + property_part(p_path).text + "'";
	if (!p_result && p_result.error().message.starts_with(part)) {
		return Error{ "'" + p_path.text + "'" + p_result.error().message.substr(part.size()) };
	}
	return p_result;
}

} // namespace

Status set_property_by_path(Node &p_root, const NodePath &p_path, const Variant &p_value) {
	const std::vector<std::string> names = p_path.get_subnames();
	if (names.empty()) {
		return make_error("'{}' names no property: expected NODE:property", p_path.text);
	}
	Result<Node *> node = find_node(p_root, p_path);
	if (!node) {
		return node.error();
	}
	return worded(node.value()->set_indexed(property_part(p_path), p_value), p_path);
}

Result<Variant> get_property_by_path(Node &p_root, const NodePath &p_path) {
	const std::vector<std::string> names = p_path.get_subnames();
	if (names.empty()) {
		return make_error("'{}' names no property: expected NODE:property", p_path.text);
	}
	Result<Node *> node = find_node(p_root, p_path);
	if (!node) {
		return node.error();
	}
	return worded(node.value()->get_indexed(property_part(p_path)), p_path);
}

} // namespace lucent::scene
