// SPDX-License-Identifier: MIT
#pragma once
// The registry of classes: the single source for text scenes, --set, class documents, an inspector, scripting. Written once at the
// start of the program (register_core_classes, register_scene_classes), read-only afterwards. It describes types, so it is process-wide.

#include "servers/core/object.h"

#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace lucent {

enum PropertyUsage : uint32_t {
	PROPERTY_USAGE_NONE = 0,
	PROPERTY_USAGE_STORAGE = 2, // written to scene files; has a default
	PROPERTY_USAGE_EDITOR = 4,
	PROPERTY_USAGE_DEFAULT = 6,
};

enum class PropertyHint : uint8_t {
	NONE,
	RANGE,
	ENUM,
	RESOURCE_TYPE,
	FLAGS
};

struct PropertyRange {
	double min = 0.0;
	double max = 0.0;
	double step = 0.0;
	bool or_less = false; // min is where a slider ends; smaller values are good
	bool or_greater = false;
	bool is_enforced = false; // nothing outside works; else the range is a slider's, and files may go beyond
};

struct PropertyInfo {
	std::string name;
	Variant::Type type = Variant::Type::NIL;
	std::string class_name; // of OBJECT: "Texture2D"; of an enum: "Environment.BGMode"
	PropertyHint hint = PropertyHint::NONE;
	PropertyRange range;
	uint32_t usage = PROPERTY_USAGE_DEFAULT;
	std::string setter; // names for documents and Object::call
	std::string getter;
	std::string documentation;
	std::function<bool(Object &, const Variant &)> set; // empty: read-only. false: the value does not convert or was rejected
	std::function<Variant(const Object &)> get;

	// As Godot's hint_string: "0,16,0.001,or_greater"; "Linear:0,Filmic:2"; "Texture2D".
	std::string get_hint_string() const;
	// Checks type, finiteness, hard range and enumerators, then sets. The error names class, property, expectation and value.
	Status checked_set(Object &r_object, const Variant &p_value) const;
	// As checked_set for a value out of a scene file: one beyond a slider's range is set as it is, one beyond an enforced range
	// becomes the nearest in it, which r_clamped says.
	Status stored_set(Object &r_object, const Variant &p_value, bool &r_clamped) const;

private:
	Status set_in_range(Object &r_object, const Variant &p_value) const; // all but the range is checked
};

struct ArgumentInfo {
	std::string name;
	Variant::Type type = Variant::Type::NIL;
	std::string class_name;
};

struct MethodInfo {
	std::string name;
	std::vector<ArgumentInfo> arguments;
	ArgumentInfo result; // NIL: void
	std::vector<Variant> default_arguments; // of the last ones
	bool is_const = false;
	bool is_accessor = false; // a property's setter or getter
	bool is_static = false; // the object is null
	bool is_virtual = false; // a script's to define: see script_instance.h; call is empty
	bool is_vararg = false; // any number of arguments may follow
	std::string documentation;
	// As many arguments as there are, at least with is_vararg: see checked_call.
	std::function<Result<Variant>(Object *, const Array &)> call;

	// Fills in defaults and checks the number. The error names class, method, argument and expectation.
	Result<Variant> checked_call(const std::string &p_class, Object *r_object, const Array &p_arguments) const;
};

struct SignalInfo {
	std::string name;
	std::vector<ArgumentInfo> arguments;
	std::string documentation;
};

struct ConstantInfo {
	std::string name;
	int64_t value = 0;
	std::string enum_name; // empty: a constant of the class
	std::string documentation;
};

struct ClassInfo {
	std::string name;
	std::string parent; // empty: Object
	std::string documentation;
	std::vector<PropertyInfo> properties; // own, in order of registration
	std::vector<MethodInfo> methods;
	std::vector<SignalInfo> signals;
	std::vector<ConstantInfo> constants;
	bool instantiable = false; // by name; abstract classes are not
	std::function<std::unique_ptr<Object>()> create; // empty: cannot be made even for its defaults
	std::unordered_map<std::string, size_t> property_index;
	std::unordered_map<std::string, size_t> method_index;
};

class ClassDB {
public:
	// Registers T after its parent: calls T::bind. Registering twice does nothing.
	template <typename T>
	static void register_class() { register_type<T>(true); }
	// As register_class, but instantiate() refuses it.
	template <typename T>
	static void register_abstract_class() { register_type<T>(false); }

	static std::vector<std::string> get_class_list(); // sorted
	static const ClassInfo *get_class_info(const std::string &p_class); // null: unknown
	static bool class_exists(const std::string &p_class) { return get_class_info(p_class) != nullptr; }
	static bool can_instantiate(const std::string &p_class);
	static bool is_parent_class(const std::string &p_class, const std::string &p_parent); // a class is its own parent here

	// Null: unknown or abstract. Resources come from instantiate_resource, for Refs to work.
	static std::unique_ptr<Object> instantiate(const std::string &p_class);
	// Null: unknown, abstract, or not a T.
	template <typename T>
	static std::unique_ptr<T> instantiate_as(const std::string &p_class) {
		std::unique_ptr<Object> object = instantiate(p_class);
		T *typed = dynamic_cast<T *>(object.get());
		if (typed) {
			(void)object.release();
		}
		return std::unique_ptr<T>(typed);
	}
	template <typename T = Resource>
	static Ref<T> instantiate_resource(const std::string &p_class) { return Ref<T>(instantiate_as<T>(p_class)); }

	// Inherited ones included, bases first.
	static std::vector<const PropertyInfo *> get_property_list(const std::string &p_class);
	static const PropertyInfo *get_property(const std::string &p_class, const std::string &p_name); // null: none
	static const MethodInfo *get_method(const std::string &p_class, const std::string &p_name);
	static bool has_signal(const std::string &p_class, const std::string &p_name);
	// What a fresh object of the class answers; NIL: no such property, or not stored.
	static Variant get_property_default(const std::string &p_class, const std::string &p_name);
	// Enumerators of p_enum ("Environment.BGMode"), in order.
	static std::vector<ConstantInfo> get_enum_constants(const std::string &p_enum);
	// A constant or enumerator of the class or a base, by name; null: none.
	static const ConstantInfo *get_constant(const std::string &p_class, const std::string &p_name);

private:
	// A new entry for the class, or null if it is there.
	static ClassInfo *add_class(const std::string &p_class, const std::string &p_parent);
	static void finish_class(ClassInfo &r_info);
	template <typename T>
	static void register_type(bool p_instantiable);
};

// Object::call and scripts say a type so: "float", "Environment.BGMode", "Node[]", "Texture2D".
std::string type_text(const ArgumentInfo &p_type);

// Object and Resource. Modules call it before their own.
void register_core_classes();

} // namespace lucent
