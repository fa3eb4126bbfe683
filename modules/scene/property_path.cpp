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

// The object that has the property, and how many of p_names lead to it. What follows the property is a part of its value.
struct Target {
	Object *object = nullptr;
	size_t property = 0; // index into the names
};

Result<Target> find_target(Object *p_object, const std::vector<std::string> &p_names, const std::string &p_path) {
	Target target = { p_object, 0 };
	while (target.property + 1 < p_names.size()) {
		const std::string &name = p_names[target.property];
		bool valid = false;
		const Variant value = target.object->get(name, &valid);
		if (!valid) {
			break; // set_property words the error
		}
		if (value.get_type() != Variant::Type::OBJECT) {
			break;
		}
		Object *next = value.get_object();
		if (!next) {
			return make_error("'{}': {}.{} is null", p_path, target.object->get_class(), name);
		}
		target.object = next;
		target.property++;
	}
	return target;
}

// p_value into the part of r_whole that p_names from p_index on speak of.
bool set_part(Variant &r_whole, const std::vector<std::string> &p_names, size_t p_index, const Variant &p_value) {
	if (p_index == p_names.size()) {
		r_whole = p_value;
		return true;
	}
	Variant part = r_whole.get_component(p_names[p_index]);
	return !part.is_nil() && set_part(part, p_names, p_index + 1, p_value) && r_whole.set_component(p_names[p_index], part);
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
	Result<Target> target = find_target(node.value(), names, p_path.text);
	if (!target) {
		return target.error();
	}
	Object &object = *target.value().object;
	const std::string &property = names[target.value().property];
	Variant whole = p_value;
	if (target.value().property + 1 < names.size()) {
		bool valid = false;
		whole = object.get(property, &valid);
		if (valid && !set_part(whole, names, target.value().property + 1, p_value)) {
			return make_error("'{}': {}.{} has no part '{}' that could be {}", p_path.text, object.get_class(), property, names[target.value().property + 1], p_value.to_string());
		}
	}
	Status status = object.set_property(property, whole);
	return status ? Status(Ok()) : Status(make_error("'{}': {}", p_path.text, status.error().message));
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
	Result<Target> target = find_target(node.value(), names, p_path.text);
	if (!target) {
		return target.error();
	}
	const Object &object = *target.value().object;
	const size_t property = target.value().property;
	bool valid = false;
	Variant value = object.get(names[property], &valid);
	if (!valid) {
		return make_error("'{}': {} has no property '{}'", p_path.text, object.get_class(), names[property]);
	}
	for (size_t i = property + 1; i < names.size(); i++) {
		value = value.get_component(names[i]);
		if (value.is_nil()) {
			return make_error("'{}': {}.{} has no part '{}'", p_path.text, object.get_class(), names[property], names[i]);
		}
	}
	return value;
}

} // namespace lucent::scene
