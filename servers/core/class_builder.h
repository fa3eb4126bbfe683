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

#include <initializer_list>

namespace lucent {

// One enumerator: { "BG_SKY", BackgroundMode::SKY }.
struct EnumEntry {
	const char *name;
	int64_t value;

	template <typename T>
	EnumEntry(const char *p_name, T p_value) :
			name(p_name), value(int64_t(p_value)) {}
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
		return add_method<R, Arguments...>(p_name, p_method, p_argument_names, false);
	}
	template <typename R, typename C, typename... Arguments>
	ClassBuilder &method(const char *p_name, R (C::*p_method)(Arguments...) const, std::initializer_list<const char *> p_argument_names = {}) {
		return add_method<R, Arguments...>(p_name, p_method, p_argument_names, true);
	}

	ClassBuilder &signal(const char *p_name, std::vector<ArgumentInfo> p_arguments = {}) {
		info.signals.push_back({ p_name, std::move(p_arguments), "" });
		documentation = &info.signals.back().documentation;
		return *this;
	}
	ClassBuilder &enumeration(const char *p_enum, std::initializer_list<EnumEntry> p_entries) {
		for (const EnumEntry &entry : p_entries) {
			info.constants.push_back({ entry.name, entry.value, p_enum, "" });
		}
		return *this;
	}
	ClassBuilder &constant(const char *p_name, int64_t p_value) {
		info.constants.push_back({ p_name, p_value, "", "" });
		documentation = &info.constants.back().documentation;
		return *this;
	}

private:
	// The class's name for OBJECT types, else empty.
	template <typename Value>
	static std::string class_name_of() {
		if constexpr (is_ref_v<Value>) {
			return RefTarget<Value>::Type::get_class_static();
		} else if constexpr (is_object_pointer_v<Value> && !std::is_same_v<Value, const char *>) {
			return std::remove_cv_t<std::remove_pointer_t<Value>>::get_class_static();
		} else {
			return "";
		}
	}

	template <typename Value>
	static Variant::Type type_of() {
		return std::is_same_v<Value, const char *> ? Variant::Type::STRING : variant_type_of<Value>();
	}

	template <typename Value, typename Set, typename Get>
	ClassBuilder &add_property(const char *p_name, Set p_set, Get p_get) {
		PropertyInfo property;
		property.name = p_name;
		property.type = variant_type_of<Value>();
		property.class_name = class_name_of<Value>();
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
		setter.call = [name = p_property.name](Object &r_object, const Array &p_arguments) -> Result<Variant> {
			Status status = r_object.set_property(name, p_arguments[0]);
			return status ? Result<Variant>(Variant()) : Result<Variant>(status.error());
		};
		MethodInfo getter;
		getter.name = p_property.getter;
		getter.result = { "", p_property.type, p_property.class_name };
		getter.is_const = true;
		getter.is_accessor = true;
		getter.call = [get = p_property.get](Object &r_object, const Array &) -> Result<Variant> { return get(r_object); };
		info.methods.push_back(std::move(setter));
		info.methods.push_back(std::move(getter));
	}

	template <typename R, typename... Arguments, typename Method>
	ClassBuilder &add_method(const char *p_name, Method p_method, std::initializer_list<const char *> p_argument_names, bool p_const) {
		INVARIANT(p_argument_names.size() == sizeof...(Arguments), "{}.{}: {} argument names", info.name, p_name, p_argument_names.size());
		MethodInfo method;
		method.name = p_name;
		method.result = { "", type_of<std::decay_t<R>>(), class_name_of<std::decay_t<R>>() };
		method.is_const = p_const;
		const std::vector<std::string> names(p_argument_names.begin(), p_argument_names.end());
		size_t index = 0;
		((method.arguments.push_back({ names[index], type_of<std::decay_t<Arguments>>(), class_name_of<std::decay_t<Arguments>>() }), index++), ...);
		method.call = [p_method, full_name = info.name + "." + p_name](Object &r_object, const Array &p_arguments) -> Result<Variant> {
			return [&]<size_t... I>(std::index_sequence<I...>)->Result<Variant> {
				const std::tuple<std::optional<std::decay_t<Arguments>>...> values = { variant_cast<std::decay_t<Arguments>>(p_arguments[I])... };
				if (!(std::get<I>(values).has_value() && ...)) {
					return make_error("{}(): an argument is of the wrong type", full_name);
				}
				T &self = static_cast<T &>(r_object);
				if constexpr (std::is_void_v<R>) {
					return (self.*p_method)(*std::get<I>(values)...), Variant();
				} else {
					return Variant((self.*p_method)(*std::get<I>(values)...));
				}
			}
			(std::index_sequence_for<Arguments...>());
		};
		info.methods.push_back(std::move(method));
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
