// SPDX-License-Identifier: MIT
// Properties by path.
#include "servers/core/object.h"

namespace lucent {

namespace {

// The names of "position:x" or ":position:x".
std::vector<std::string> property_names(const NodePath &p_path) {
	return NodePath(p_path.text.starts_with(':') ? p_path.text : ":" + p_path.text).get_subnames();
}

// The object that has the property, and how many of the names lead to it. What follows the property is a part of its
// value.
struct Target {
	const Object *object = nullptr;
	size_t property = 0; // index into the names
};

Result<Target> find_target(const Object *p_object, const std::vector<std::string> &p_names, const std::string &p_path) {
	Target target = { p_object, 0 };
	while (target.property + 1 < p_names.size()) {
		const std::string &name = p_names[target.property];
		bool valid = false;
		const Variant value = target.object->get(name, &valid);
		if (!valid || value.get_type() != Variant::Type::OBJECT) {
			break; // set_property words the error
		}
		const Object *next = value.get_object();
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
	return !part.is_nil() && set_part(part, p_names, p_index + 1, p_value) &&
			r_whole.set_component(p_names[p_index], part);
}

} // namespace

Status Object::set_indexed(const NodePath &p_path, const Variant &p_value) {
	const std::vector<std::string> names = property_names(p_path);
	if (names.empty()) {
		return make_error("'{}' names no property", p_path.text);
	}
	const Result<Target> target = find_target(this, names, p_path.text);
	if (!target) {
		return target.error();
	}
	Object &object = const_cast<Object &>(*target.value().object);
	const size_t index = target.value().property;
	Variant whole = p_value;
	if (index + 1 < names.size()) {
		bool valid = false;
		whole = object.get(names[index], &valid);
		if (valid && !set_part(whole, names, index + 1, p_value)) {
			return make_error("'{}': {}.{} has no part '{}' that could be {}", p_path.text, object.get_class(),
					names[index], names[index + 1], p_value.to_string());
		}
	}
	const Status status = object.set_property(names[index], whole);
	return status ? Status(Ok()) : Status(make_error("'{}': {}", p_path.text, status.error().message));
}

Result<Variant> Object::get_indexed(const NodePath &p_path) const {
	const std::vector<std::string> names = property_names(p_path);
	if (names.empty()) {
		return make_error("'{}' names no property", p_path.text);
	}
	const Result<Target> target = find_target(this, names, p_path.text);
	if (!target) {
		return target.error();
	}
	const Object &object = *target.value().object;
	const size_t index = target.value().property;
	bool valid = false;
	Variant value = object.get(names[index], &valid);
	if (!valid) {
		return make_error("'{}': {} has no property '{}'", p_path.text, object.get_class(), names[index]);
	}
	for (size_t i = index + 1; i < names.size(); i++) {
		value = value.get_component(names[i]);
		if (value.is_nil()) {
			return make_error("'{}': {}.{} has no part '{}'", p_path.text, object.get_class(), names[index], names[i]);
		}
	}
	return value;
}

} // namespace lucent
