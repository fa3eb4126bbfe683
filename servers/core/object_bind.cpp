// SPDX-License-Identifier: MIT
// What the registry knows of Object, and how a registered method is called.
#include "servers/core/class_builder.h"
#include "servers/core/object.h"

namespace lucent {

std::string type_text(const ArgumentInfo &p_type) {
	return p_type.class_name.empty() ? Variant::get_type_name(p_type.type) : p_type.class_name;
}

Error argument_error(const std::string &p_method, size_t p_index, const ArgumentInfo &p_argument, const Variant &p_value) {
	const Object *object = p_value.get_object();
	const char *got = object ? object->get_class() : p_value.is_null() ? "null"
																	   : Variant::get_type_name(p_value.get_type());
	const bool owned = object && p_argument.type == Variant::Type::OBJECT && object->is_class(p_argument.class_name);
	const char *owner = owned ? " that already has an owner (remove_child() or reparent() it)" : "";
	return make_error("{}(): argument {} ({}): expected {}, got {}{}", p_method, p_index + 1, p_argument.name, type_text(p_argument), got, owner);
}

Result<Variant> MethodInfo::checked_call(const std::string &p_class, Object *r_object, const Array &p_arguments) const {
	const size_t least = arguments.size() - default_arguments.size();
	if (p_arguments.size() < least || (p_arguments.size() > arguments.size() && !is_vararg)) {
		const std::string most = is_vararg ? " or more" : (default_arguments.empty() ? "" : fmt::format(" to {}", arguments.size()));
		return make_error("{}.{}() takes {}{} arguments, got {}", p_class, name, least, most, p_arguments.size());
	}
	if (p_arguments.size() >= arguments.size()) {
		return call(r_object, p_arguments);
	}
	Array filled = p_arguments;
	while (filled.size() < arguments.size()) {
		filled.push_back(default_arguments[filled.size() - least]);
	}
	return call(r_object, filled);
}

namespace {

Dictionary dictionary_of(std::initializer_list<std::pair<const char *, Variant>> p_entries) {
	Dictionary dictionary;
	for (const auto &[key, value] : p_entries) {
		dictionary.entries.emplace_back(key, value);
	}
	return dictionary;
}

Dictionary property_dictionary(const PropertyInfo &p_property) {
	return dictionary_of({ { "name", p_property.name }, { "class_name", p_property.class_name }, { "type", p_property.type }, { "hint_string", p_property.get_hint_string() }, { "usage", p_property.usage } });
}

// Own classes' members first.
template <typename F>
void visit_classes(const Object &p_object, F &&p_visit) {
	const ClassInfo *info = ClassDB::get_class_info(p_object.get_class());
	for (; info; info = info->parent.empty() ? nullptr : ClassDB::get_class_info(info->parent)) {
		p_visit(*info);
	}
}

Array get_property_list(const Object &p_object) {
	Array list;
	for (const PropertyInfo *property : ClassDB::get_property_list(p_object.get_class())) {
		list.emplace_back(property_dictionary(*property));
	}
	std::vector<PropertyInfo> dynamic;
	p_object._get_property_list(dynamic);
	for (const PropertyInfo &property : dynamic) {
		list.emplace_back(property_dictionary(property));
	}
	return list;
}

Array get_method_list(const Object &p_object) {
	Array list;
	visit_classes(p_object, [&](const ClassInfo &p_info) {
		for (const MethodInfo &method : p_info.methods) {
			list.emplace_back(dictionary_of({ { "name", method.name }, { "args", int64_t(method.arguments.size()) } }));
		}
	});
	return list;
}

Array get_signal_list(const Object &p_object) {
	Array list;
	visit_classes(p_object, [&](const ClassInfo &p_info) {
		for (const SignalInfo &signal : p_info.signals) {
			list.emplace_back(dictionary_of({ { "name", signal.name }, { "args", int64_t(signal.arguments.size()) } }));
		}
	});
	return list;
}

// p_arguments after the first p_count.
Array rest(const Array &p_arguments, size_t p_count) {
	return Array(p_arguments.begin() + ptrdiff_t(std::min(p_count, p_arguments.size())), p_arguments.end());
}

Result<Variant> emit_signal_vararg(Object &r_object, const Array &p_arguments) {
	const std::string signal = variant_or<std::string>(p_arguments[0], "");
	if (!ClassDB::has_signal(r_object.get_class(), signal)) {
		return make_error("{} has no signal '{}'", r_object.get_class(), signal);
	}
	r_object.emit_signal(signal, rest(p_arguments, 1));
	return Variant();
}

Result<Variant> call_vararg(Object &r_object, const Array &p_arguments) {
	return r_object.call(variant_or<std::string>(p_arguments[0], ""), rest(p_arguments, 1));
}

Result<Variant> checked_get(const Object &p_object, const std::string &p_property) {
	bool valid = false;
	Variant value = p_object.get(p_property, &valid);
	return valid ? Result<Variant>(value) : Result<Variant>(make_error("{} has no property '{}'", p_object.get_class(), p_property));
}

using Builder = ClassBuilder<Object>;

void bind_members(Builder &r_class) {
	r_class.method("get_class", &Object::get_class).doc("The class's registered name.");
	r_class.method("is_class", &Object::is_class, { "class" }).doc("Whether this object's class is the given one or inherits it.");
	r_class.method(
				   "get_instance_id", +[](const Object &p_object) { return int64_t(p_object.get_instance_id().value); })
			.doc("The number that tells this object from all others of the process.");
	r_class.method("get", &checked_get, { "property" }).doc("A property by name, also one whose name depends on the object, as surface_material_override/0.");
	r_class.method("set", &Object::set_property, { "property", "value" }).doc("Sets a property by name. A wrong name, type or range is an error.");
	r_class.method("get_indexed", &Object::get_indexed, { "property_path" }).doc("A property or a part of one by path: position:x.");
	r_class.method("set_indexed", &Object::set_indexed, { "property_path", "value" }).doc("Sets a property or a part of one by path: position:x.");
	r_class.method("get_property_list", &get_property_list).doc("All properties, each a dictionary of name, class_name, type, hint_string and usage.");
	r_class.method("get_method_list", &get_method_list).doc("All methods, each a dictionary of name and number of arguments.");
	r_class.method("get_signal_list", &get_signal_list).doc("All signals, each a dictionary of name and number of arguments.");
	r_class.method("has_method", &Object::has_method, { "method" }).doc("Whether the class or the object's script has a method of that name.");
	r_class.vararg_method("call", &call_vararg, { { "method", Variant::Type::STRING, "" } }).doc("Calls a method by name; what follows are its arguments.");
	r_class.method("callv", &Object::call, { "method", "arg_array" }).doc("Calls a method by name with a list of arguments.");
	r_class.method("set_meta", &Object::set_meta, { "name", "value" }).doc("Keeps a value of yours with the object, by name; null removes it.");
	r_class.method("get_meta", &Object::get_meta, { "name", "default" }).defaults({ Variant() }).doc("A value that set_meta kept, or the default.");
	r_class.method("has_meta", &Object::has_meta, { "name" }).doc("Whether set_meta kept a value of that name.");
	r_class.method("remove_meta", &Object::remove_meta, { "name" }).doc("Forgets a value that set_meta kept.");
}

void bind_signals(Builder &r_class) {
	r_class.method("connect", &Object::connect_callable, { "signal", "callable", "flags" }).defaults({ 0 }).doc("Calls the callable with the signal's arguments each time it is emitted.");
	r_class.method("disconnect", &Object::disconnect_callable, { "signal", "callable" }).doc("Ends a connection.");
	r_class.method("is_connected", &Object::is_connected, { "signal", "callable" }).doc("Whether the callable is connected to the signal.");
	r_class.method("has_connections", &Object::has_connections, { "signal" }).doc("Whether anything is connected to the signal.");
	r_class.method(
				   "has_signal", +[](const Object &p_object, const std::string &p_signal) { return ClassDB::has_signal(p_object.get_class(), p_signal); }, { "signal" })
			.doc("Whether the class has a signal of that name.");
	r_class.vararg_method("emit_signal", &emit_signal_vararg, { { "signal", Variant::Type::STRING, "" } }).doc("Emits a signal; what follows are its arguments.");
	r_class.method("set_block_signals", &Object::set_block_signals, { "enable" }).doc("While blocked, the object emits nothing.");
	r_class.method("is_blocking_signals", &Object::is_blocking_signals).doc("Whether signals are blocked.");
	r_class.enumeration("ConnectFlags", { { "CONNECT_ONE_SHOT", Object::CONNECT_ONE_SHOT, "The connection ends when the signal was emitted once." } });
}

} // namespace

void Object::bind(ClassBuilder<Object> &r_class) {
	r_class.doc("Base of everything that the registry knows: properties, methods, signals, notifications and a weak id.");
	bind_members(r_class);
	bind_signals(r_class);
	r_class.method("free", &Object::free).doc("Ends the object and all that it owns. In the middle of a callback it ends when the outermost call returns. Resources can't be freed: they end with their last user.");
	r_class.method("notification", &Object::notification, { "what" }).doc("Sends a notification to this object alone.");
	r_class.virtual_method("_notification", { { "what", Variant::Type::INT, "" } }).doc("Called for every notification that the object gets.");
	r_class.constant("NOTIFICATION_POSTINITIALIZE", NOTIFICATION_POSTINITIALIZE).doc("The object has been made.");
	r_class.constant("NOTIFICATION_PREDELETE", NOTIFICATION_PREDELETE).doc("The object is about to end.");
}

} // namespace lucent
