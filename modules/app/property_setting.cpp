// SPDX-License-Identifier: MIT
#include "modules/app/property_setting.h"

#include "modules/app/suggestion.h"
#include "modules/scene/node.h"
#include "modules/scene/property_path.h"
#include "servers/core/class_db.h"
#ifdef MODULE_TSCN_ENABLED
#include "modules/tscn/variant_parser.h"
#endif

namespace lucent {

static void collect_named(scene::Node &p_node, const std::string &p_name, std::vector<scene::Node *> &r_found, std::vector<std::string> &r_names) {
	r_names.push_back(p_node.get_name());
	if (p_node.get_name() == p_name) {
		r_found.push_back(&p_node);
	}
	for (int i = 0; i < p_node.get_child_count(); i++) {
		collect_named(*p_node.get_child(i), p_name, r_found, r_names);
	}
}

Result<scene::Node *> find_node(scene::Node &p_root, const std::string &p_path) {
	const std::vector<std::string> path = NodePath(p_path).get_names();
	if (path.empty()) {
		return &p_root;
	}
	if (scene::Node *direct = p_root.get_node_or_null(NodePath(p_path))) {
		return direct;
	}
	std::vector<scene::Node *> found;
	std::vector<std::string> names;
	collect_named(p_root, path.front(), found, names);
	for (size_t i = 1; i < path.size() && found.size() == 1; i++) {
		scene::Node *child = found[0]->get_node_or_null(NodePath(path[i]));
		if (child == nullptr) {
			names.clear();
			for (int j = 0; j < found[0]->get_child_count(); j++) {
				names.push_back(found[0]->get_child(j)->get_name());
			}
			return make_error("'{}' has no child '{}'{}", found[0]->get_name(), path[i], suggestion(path[i], names));
		}
		found[0] = child;
	}
	if (found.size() > 1) {
		return make_error("{} nodes are called '{}'; give the path from the root", found.size(), path.front());
	}
	if (found.empty()) {
		return make_error("there is no node '{}'{}", path.front(), suggestion(path.front(), names));
	}
	return found[0];
}

static std::vector<std::string> property_names(const Object &p_object) {
	std::vector<std::string> names;
	for (const PropertyInfo *property : ClassDB::get_property_list(p_object.get_class())) {
		names.push_back(property->name);
	}
	std::vector<PropertyInfo> dynamic;
	p_object._get_property_list(dynamic);
	for (const PropertyInfo &property : dynamic) {
		names.push_back(property.name);
	}
	return names;
}

// For a message: where p_names leave the known properties, the nearest one.
static std::string property_suggestion(Object &p_object, const std::vector<std::string> &p_names) {
	Object *object = &p_object;
	for (const std::string &name : p_names) {
		if (!object->has_property(name)) {
			return suggestion(name, property_names(*object));
		}
		object = object->get(name).get_object();
		if (object == nullptr) {
			break;
		}
	}
	return "";
}

static Result<Variant> parse_value(std::string_view p_text) {
#ifdef MODULE_TSCN_ENABLED
	return parse_variant_text(p_text, "value");
#else
	return make_error("'{}' can't be read: this program is built without modules/tscn", p_text);
#endif
}

Status apply_setting(scene::Node &p_root, const std::string &p_setting) {
	const size_t colon = p_setting.find(':');
	const size_t equals = colon == std::string::npos ? colon : p_setting.find('=', colon);
	if (equals == std::string::npos) {
		return make_error("--set '{}': expected 'Node/Path:property=value'", p_setting);
	}
	const std::string target = p_setting.substr(0, equals);
	const std::vector<std::string> names = NodePath(target).get_subnames();
	const Result<Variant> value = parse_value(std::string_view(p_setting).substr(equals + 1));
	if (!value) {
		return make_error("--set '{}': {}", p_setting, value.error().message);
	}
	const Result<scene::Node *> node = find_node(p_root, target.substr(0, colon));
	if (!node || names.empty()) {
		return make_error("--set '{}': {}", p_setting, node ? "expected a property after ':'" : node.error().message);
	}
	const Status status = scene::set_property_by_path(*node.value(), NodePath(target.substr(colon)), value.value());
	return status ? status : Status(make_error("--set '{}': {}{}", p_setting, status.error().message, property_suggestion(*node.value(), names)));
}

} // namespace lucent
