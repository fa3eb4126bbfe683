// SPDX-License-Identifier: MIT
#include "servers/core/class_db.h"

#include "servers/core/class_builder.h"

#include <algorithm>
#include <map>

namespace lucent {

namespace {

struct Registry {
	std::map<std::string, ClassInfo> classes; // addresses stay
	std::map<std::string, std::unique_ptr<Object>> default_objects; // made when first asked for
};

Registry &registry() {
	// Never destroyed: objects with static lifetime may still ask.
	static Registry *instance = new Registry;
	return *instance;
}

// Visits a class and its bases, most derived first, until p_visit answers true.
template <typename F>
void visit_hierarchy(const std::string &p_class, F &&p_visit) {
	const ClassInfo *info = ClassDB::get_class_info(p_class);
	while (info && !p_visit(*info)) {
		info = info->parent.empty() ? nullptr : ClassDB::get_class_info(info->parent);
	}
}

const Object *default_object(const ClassInfo &p_info) {
	Registry &all = registry();
	auto found = all.default_objects.find(p_info.name);
	if (found == all.default_objects.end()) {
		found = all.default_objects.emplace(p_info.name, p_info.create ? p_info.create() : nullptr).first;
	}
	return found->second.get();
}

} // namespace

ClassInfo *ClassDB::add_class(const std::string &p_class, const std::string &p_parent) {
	INVARIANT(p_parent.empty() || class_exists(p_parent), "{} is registered before its parent {}", p_class, p_parent);
	const auto [entry, added] = registry().classes.emplace(p_class, ClassInfo());
	if (!added) {
		return nullptr;
	}
	entry->second.name = p_class;
	entry->second.parent = p_parent;
	return &entry->second;
}

void ClassDB::finish_class(ClassInfo &r_info) {
	for (size_t i = 0; i < r_info.properties.size(); i++) {
		const bool added = r_info.property_index.emplace(r_info.properties[i].name, i).second;
		INVARIANT(added, "{}.{} is registered twice", r_info.name, r_info.properties[i].name);
	}
	for (size_t i = 0; i < r_info.methods.size(); i++) {
		r_info.method_index.emplace(r_info.methods[i].name, i);
	}
}

std::vector<std::string> ClassDB::get_class_list() {
	std::vector<std::string> names;
	for (const auto &[name, info] : registry().classes) {
		names.push_back(name);
	}
	return names;
}

const ClassInfo *ClassDB::get_class_info(const std::string &p_class) {
	const auto found = registry().classes.find(p_class);
	return found == registry().classes.end() ? nullptr : &found->second;
}

bool ClassDB::can_instantiate(const std::string &p_class) {
	const ClassInfo *info = get_class_info(p_class);
	return info && info->instantiable;
}

bool ClassDB::is_parent_class(const std::string &p_class, const std::string &p_parent) {
	bool is_parent = false;
	visit_hierarchy(p_class, [&](const ClassInfo &p_info) { return is_parent = p_info.name == p_parent; });
	return is_parent;
}

std::unique_ptr<Object> ClassDB::instantiate(const std::string &p_class) {
	const ClassInfo *info = get_class_info(p_class);
	return info && info->instantiable ? info->create() : nullptr;
}

std::vector<const PropertyInfo *> ClassDB::get_property_list(const std::string &p_class) {
	std::vector<const ClassInfo *> line;
	visit_hierarchy(p_class, [&](const ClassInfo &p_info) { return line.push_back(&p_info), false; });
	std::vector<const PropertyInfo *> list;
	for (auto info = line.rbegin(); info != line.rend(); ++info) {
		for (const PropertyInfo &property : (*info)->properties) {
			list.push_back(&property);
		}
	}
	return list;
}

const PropertyInfo *ClassDB::get_property(const std::string &p_class, const std::string &p_name) {
	const PropertyInfo *property = nullptr;
	visit_hierarchy(p_class, [&](const ClassInfo &p_info) {
		const auto found = p_info.property_index.find(p_name);
		property = found == p_info.property_index.end() ? nullptr : &p_info.properties[found->second];
		return property != nullptr;
	});
	return property;
}

const MethodInfo *ClassDB::get_method(const std::string &p_class, const std::string &p_name) {
	const MethodInfo *method = nullptr;
	visit_hierarchy(p_class, [&](const ClassInfo &p_info) {
		const auto found = p_info.method_index.find(p_name);
		method = found == p_info.method_index.end() ? nullptr : &p_info.methods[found->second];
		return method != nullptr;
	});
	return method;
}

bool ClassDB::has_signal(const std::string &p_class, const std::string &p_name) {
	bool has = false;
	visit_hierarchy(p_class, [&](const ClassInfo &p_info) {
		return has = std::any_of(p_info.signals.begin(), p_info.signals.end(), [&](const SignalInfo &p_signal) { return p_signal.name == p_name; });
	});
	return has;
}

Variant ClassDB::get_property_default(const std::string &p_class, const std::string &p_name) {
	const PropertyInfo *property = get_property(p_class, p_name);
	const ClassInfo *info = get_class_info(p_class);
	if (!property || !(property->usage & PROPERTY_USAGE_STORAGE)) {
		return Variant();
	}
	const Object *object = default_object(*info);
	return object ? property->get(*object) : Variant();
}

std::vector<ConstantInfo> ClassDB::get_enum_constants(const std::string &p_enum) {
	std::vector<ConstantInfo> constants;
	const size_t dot = p_enum.find('.');
	const ClassInfo *info = get_class_info(p_enum.substr(0, dot));
	for (const ConstantInfo &constant : info &&dot != std::string::npos ? info->constants : std::vector<ConstantInfo>()) {
		if (constant.enum_name == p_enum.substr(dot + 1)) {
			constants.push_back(constant);
		}
	}
	return constants;
}

const ConstantInfo *ClassDB::get_constant(const std::string &p_class, const std::string &p_name) {
	const ConstantInfo *constant = nullptr;
	visit_hierarchy(p_class, [&](const ClassInfo &p_info) {
		for (const ConstantInfo &candidate : p_info.constants) {
			if (candidate.name == p_name) {
				constant = &candidate;
			}
		}
		return constant != nullptr;
	});
	return constant;
}

void register_core_classes() {
	ClassDB::register_class<Object>();
	ClassDB::register_class<Resource>();
}

} // namespace lucent
