// SPDX-License-Identifier: MIT
#pragma once
// How a class tells the registry its members, in its bind():
//
//   void Light3D::bind(ClassBuilder<Light3D> &r_class) {
//       r_class.doc("What all lights share.");
//       r_class.property("light_energy", &Light3D::set_energy, &Light3D::get_energy).range(0, 16, 0.001).or_greater().doc("…");
//       r_class.field("light_color", &Light3D::state, &State::color).doc("…"); // plain data; T::state_changed() follows a change
//   }
//
// Types come from the C++ signatures, defaults from a fresh object. doc() and the hints speak of the member added last.

#include "servers/core/class_db.h"
#include "servers/core/method_types.h"

#include <initializer_list>

namespace lucent {

// One enumerator: { "BG_SKY", BackgroundMode::SKY, "The sky." }.
struct EnumEntry {
	const char *name;
	int64_t value;
	const char *documentation;

	template <typename T>
	EnumEntry(const char *p_name, T p_value, const char *p_documentation = "") :
			name(p_name), value(int64_t(p_value)), documentation(p_documentation) {}
};

template <typename T>
class ClassBuilder {
public:
	explicit ClassBuilder(ClassInfo &r_info) :
			info(r_info), documentation(&r_info.documentation) {}

	ClassBuilder &doc(const char *p_text) {
		*documentation = p_text;
		return *this;
	}

	// A setter may return bool: false rejects the value. Methods set_NAME and get_NAME (is_NAME for bool) are registered along.
	template <typename SetResult, typename Setter, typename Argument, typename Getter, typename Value>
	ClassBuilder &property(const char *p_name, SetResult (Setter::*p_set)(Argument), Value (Getter::*p_get)() const) {
		static_assert(std::is_same_v<std::decay_t<Argument>, std::decay_t<Value>>);
		return add_property<std::decay_t<Value>>(
				p_name,
				[p_set](Object &r_object, const std::decay_t<Value> &p_value) {
					T &self = static_cast<T &>(r_object);
					if constexpr (std::is_same_v<SetResult, bool>) {
						return (self.*p_set)(p_value);
					} else {
						return (self.*p_set)(p_value), true;
					}
				},
				[p_get](const Object &p_object) -> std::decay_t<Value> { return (static_cast<const T &>(p_object).*p_get)(); });
	}

	template <typename Value>
	ClassBuilder &read_only(const char *p_name, Value (T::*p_get)() const) {
		add_property<std::decay_t<Value>>(
				p_name, [](Object &, const std::decay_t<Value> &) { return false; },
				[p_get](const Object &p_object) -> std::decay_t<Value> { return (static_cast<const T &>(p_object).*p_get)(); });
		info.properties.back().set = nullptr;
		return not_stored();
	}

	// A field of a plain struct that the class keeps as p_state. Setting another value calls state_changed() afterwards.
	template <typename Owner, typename State, typename StateBase, typename Value>
	ClassBuilder &field(const char *p_name, State Owner::*p_state, Value StateBase::*p_field) {
		return add_property<Value>(
				p_name,
				[p_state, p_field](Object &r_object, const Value &p_value) {
					T &self = static_cast<T &>(r_object);
					if (!(self.*p_state.*p_field == p_value)) {
						self.*p_state.*p_field = p_value;
						self.state_changed();
					}
					return true;
				},
				[p_state, p_field](const Object &p_object) -> Value { return static_cast<const T &>(p_object).*p_state.*p_field; });
	}

	ClassBuilder &range(double p_min, double p_max, double p_step) {
		info.properties.back().hint = PropertyHint::RANGE;
		info.properties.back().range = { p_min, p_max, p_step };
		return *this;
	}
	ClassBuilder &or_less() {
		info.properties.back().range.or_less = true;
		return *this;
	}
	ClassBuilder &or_greater() {
		info.properties.back().range.or_greater = true;
		return *this;
	}
	// Files can't go beyond the range either.
	ClassBuilder &enforced() {
		info.properties.back().range.is_enforced = true;
		return *this;
	}
	// p_enum: of this class ("BGMode") or another ("BaseMaterial3D.BlendMode").
	ClassBuilder &enum_of(const std::string &p_enum) {
		info.properties.back().hint = PropertyHint::ENUM;
		info.properties.back().class_name = p_enum.find('.') == std::string::npos ? info.name + "." + p_enum : p_enum;
		return *this;
	}
	// Not in scene files, without a default: computed from other properties.
	ClassBuilder &not_stored() {
		info.properties.back().usage = PROPERTY_USAGE_NONE;
		return *this;
	}

	template <typename R, typename C, typename... Arguments>
	ClassBuilder &method(const char *p_name, R (C::*p_method)(Arguments...), std::initializer_list<const char *> p_argument_names = {}) {
		return add_method<R, Arguments...>(
				p_name, [p_method](T &r_self, auto &&...p_values) -> R { return (r_self.*p_method)(std::forward<decltype(p_values)>(p_values)...); }, p_argument_names, false);
	}
	template <typename R, typename C, typename... Arguments>
	ClassBuilder &method(const char *p_name, R (C::*p_method)(Arguments...) const, std::initializer_list<const char *> p_argument_names = {}) {
		return add_method<R, Arguments...>(
				p_name, [p_method](const T &p_self, auto &&...p_values) -> R { return (p_self.*p_method)(std::forward<decltype(p_values)>(p_values)...); }, p_argument_names, true);
	}
	// A free function whose first parameter is the object: where the C++ method isn't what a script should call.
	template <typename R, typename... Arguments>
	ClassBuilder &method(const char *p_name, R (*p_function)(T &, Arguments...), std::initializer_list<const char *> p_argument_names = {}) {
		return add_method<R, Arguments...>(p_name, p_function, p_argument_names, false);
	}
	template <typename R, typename... Arguments>
	ClassBuilder &method(const char *p_name, R (*p_function)(const T &, Arguments...), std::initializer_list<const char *> p_argument_names = {}) {
		return add_method<R, Arguments...>(p_name, p_function, p_argument_names, true);
	}
	// The named arguments, then any number of others, in one Array.
	ClassBuilder &vararg_method(const char *p_name, Result<Variant> (*p_function)(T &, const Array &), std::vector<ArgumentInfo> p_arguments) {
		MethodInfo method;
		method.name = p_name;
		method.arguments = std::move(p_arguments);
		method.is_vararg = true;
		method.call = [p_function](Object *r_object, const Array &p_values) { return p_function(static_cast<T &>(*r_object), p_values); };
		return add_method_info(std::move(method));
	}
	template <typename R, typename... Arguments>
	ClassBuilder &static_method(const char *p_name, R (*p_function)(Arguments...), std::initializer_list<const char *> p_argument_names = {}) {
		add_method<R, Arguments...>(
				p_name, [p_function](T &, auto &&...p_values) -> R { return p_function(std::forward<decltype(p_values)>(p_values)...); }, p_argument_names, false);
		info.methods.back().is_static = true;
		return *this;
	}
	// What scripts may define and C++ then calls: see ScriptCallback.
	ClassBuilder &virtual_method(const char *p_name, std::vector<ArgumentInfo> p_arguments = {}) {
		MethodInfo method;
		method.name = p_name;
		method.arguments = std::move(p_arguments);
		method.is_virtual = true;
		return add_method_info(std::move(method));
	}
	// Of the last arguments of the method added last.
	ClassBuilder &defaults(std::vector<Variant> p_values) {
		INVARIANT(p_values.size() <= info.methods.back().arguments.size(), "{}.{}: {} defaults", info.name, info.methods.back().name, p_values.size());
		info.methods.back().default_arguments = std::move(p_values);
		return *this;
	}
	// Class of an argument (-1: of the result) where the C++ type doesn't tell: "Mesh.PrimitiveType".
	ClassBuilder &argument_class(int p_index, const std::string &p_class) {
		MethodInfo &method = info.methods.back();
		(p_index < 0 ? method.result : method.arguments.at(size_t(p_index))).class_name = p_class;
		return *this;
	}

	ClassBuilder &signal(const char *p_name, std::vector<ArgumentInfo> p_arguments = {}) {
		info.signals.push_back({ p_name, std::move(p_arguments), "" });
		documentation = &info.signals.back().documentation;
		return *this;
	}
	ClassBuilder &enumeration(const char *p_enum, std::initializer_list<EnumEntry> p_entries) {
		for (const EnumEntry &entry : p_entries) {
			info.constants.push_back({ entry.name, entry.value, p_enum, entry.documentation });
		}
		return *this;
	}
	ClassBuilder &constant(const char *p_name, int64_t p_value) {
		info.constants.push_back({ p_name, p_value, "", "" });
		documentation = &info.constants.back().documentation;
		return *this;
	}

private:
	template <typename Value, typename Set, typename Get>
	ClassBuilder &add_property(const char *p_name, Set p_set, Get p_get) {
		PropertyInfo property;
		property.name = p_name;
		property.type = variant_type_of<Value>();
		property.class_name = type_info<Value>("").class_name;
		property.hint = is_ref_v<Value> ? PropertyHint::RESOURCE_TYPE : PropertyHint::NONE;
		property.setter = std::string("set_") + p_name;
		property.getter = std::string(std::is_same_v<Value, bool> ? "is_" : "get_") + p_name;
		property.set = [p_set](Object &r_object, const Variant &p_value) {
			const std::optional<Value> value = variant_cast<Value>(p_value);
			return value && p_set(r_object, *value);
		};
		property.get = [p_get](const Object &p_object) { return Variant(p_get(p_object)); };
		add_accessors(property);
		info.properties.push_back(std::move(property));
		documentation = &info.properties.back().documentation;
		return *this;
	}

	void add_accessors(const PropertyInfo &p_property) {
		MethodInfo setter;
		setter.name = p_property.setter;
		setter.arguments = { { p_property.name, p_property.type, p_property.class_name } };
		setter.is_accessor = true;
		setter.call = [name = p_property.name](Object *r_object, const Array &p_arguments) -> Result<Variant> {
			Status status = r_object->set_property(name, p_arguments[0]);
			return status ? Result<Variant>(Variant()) : Result<Variant>(status.error());
		};
		MethodInfo getter;
		getter.name = p_property.getter;
		getter.result = { "", p_property.type, p_property.class_name };
		getter.is_const = true;
		getter.is_accessor = true;
		getter.call = [get = p_property.get](Object *r_object, const Array &) -> Result<Variant> { return get(*r_object); };
		info.methods.push_back(std::move(setter));
		info.methods.push_back(std::move(getter));
	}

	template <typename R, typename... Arguments, typename Method>
	ClassBuilder &add_method(const char *p_name, Method p_method, std::initializer_list<const char *> p_argument_names, bool p_const) {
		INVARIANT(p_argument_names.size() == sizeof...(Arguments), "{}.{}: {} argument names", info.name, p_name, p_argument_names.size());
		MethodInfo method;
		method.name = p_name;
		method.result = type_info<std::decay_t<R>>("");
		method.is_const = p_const;
		[[maybe_unused]] const auto *name = p_argument_names.begin();
		(method.arguments.push_back(type_info<std::decay_t<Arguments>>(*name++)), ...);
		method.call = [p_method, full_name = info.name + "." + p_name, arguments = method.arguments](Object *r_object, const Array &p_arguments) {
			return call_checked<T, R, std::decay_t<Arguments>...>(p_method, full_name, arguments, r_object, p_arguments);
		};
		return add_method_info(std::move(method));
	}

	ClassBuilder &add_method_info(MethodInfo p_method) {
		info.methods.push_back(std::move(p_method));
		documentation = &info.methods.back().documentation;
		return *this;
	}

	ClassInfo &info;
	std::string *documentation;
};

template <typename T>
void ClassDB::register_type(bool p_instantiable) {
	const char *parent = "";
	if constexpr (!std::is_void_v<typename T::Super>) {
		parent = T::Super::get_class_static();
	}
	ClassInfo *info = add_class(T::get_class_static(), parent);
	if (!info) {
		return;
	}
	if constexpr (std::is_default_constructible_v<T>) {
		info->create = [] { return std::unique_ptr<Object>(std::make_unique<T>()); };
	}
	info->instantiable = p_instantiable && info->create;
	ClassBuilder<T> builder(*info);
	T::bind(builder);
	finish_class(*info);
}

} // namespace lucent
