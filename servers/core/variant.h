// SPDX-License-Identifier: MIT
#pragma once
// One value of any type that a property, method or signal can carry. Values are copied, Resources are shared,
// other objects are weak.

#include "servers/core/math_types.h"
#include "servers/core/node_path.h"
#include "servers/core/object_id.h"

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace lucent {

class Object;
class Resource;
class Variant;

template <typename T>
using Ref = std::shared_ptr<T>;

using Array = std::vector<Variant>;

// Keeps the order of insertion. Look-up is linear: dictionaries of scenes are small.
struct Dictionary {
	std::vector<std::pair<Variant, Variant>> entries;

	const Variant *find(const Variant &p_key) const; // null: no such key
	void set(const Variant &p_key, const Variant &p_value);
	bool operator==(const Dictionary &p_other) const;
};

// What a Variant of type OBJECT holds: a Resource it shares, or any other object's id.
struct ObjectHandle {
	Ref<Resource> resource;
	ObjectID id; // set in both cases; invalid is Godot's null

	bool operator==(const ObjectHandle &) const = default;
};

// Something to call, as a signal's receiver. Equal ones are one receiver: connecting it twice is an error.
class CallableTarget {
public:
	virtual ~CallableTarget() = default;
	virtual void call(const std::vector<Variant> &p_arguments) = 0;
	virtual bool equals(const CallableTarget &p_other) const { return this == &p_other; }
	virtual ObjectID get_object() const { return {}; } // the connection ends with it; none: with the sender
};

struct Callable {
	std::shared_ptr<CallableTarget> target;

	bool operator==(const Callable &p_other) const { return target == p_other.target || (target && p_other.target && target->equals(*p_other.target)); }
};

class Variant {
public:
	// The order is that of Storage.
	enum class Type : uint8_t {
		NIL,
		BOOL,
		INT,
		FLOAT,
		STRING,
		VECTOR2,
		VECTOR2I,
		VECTOR3,
		VECTOR3I,
		VECTOR4,
		QUATERNION,
		BASIS,
		TRANSFORM3D,
		AABB,
		COLOR,
		NODE_PATH,
		OBJECT,
		ARRAY,
		DICTIONARY,
		PACKED_BYTE_ARRAY,
		PACKED_INT32_ARRAY,
		PACKED_FLOAT32_ARRAY,
		PACKED_VECTOR2_ARRAY,
		PACKED_VECTOR3_ARRAY,
		PACKED_COLOR_ARRAY,
		PACKED_STRING_ARRAY,
		CALLABLE,
		COUNT,
	};
	using Storage = std::variant<std::monostate, bool, int64_t, double, std::string, Vector2, Vector2i, Vector3, Vector3i, Vector4, Quaternion, Basis,
			Transform3D, lucent::AABB, Color, NodePath, ObjectHandle, Array, Dictionary, std::vector<uint8_t>, std::vector<int32_t>, std::vector<float>,
			std::vector<Vector2>, std::vector<Vector3>, std::vector<Color>, std::vector<std::string>, Callable>;

	Variant() = default;
	template <std::same_as<bool> T>
	Variant(T p_value) :
			storage(p_value) {}
	template <typename T>
	requires(std::integral<T> && !std::same_as<T, bool>)
			Variant(T p_value) :
			storage(int64_t(p_value)) {}
	template <std::floating_point T>
	Variant(T p_value) :
			storage(double(p_value)) {}
	template <typename T>
	requires std::is_enum_v<T>
	Variant(T p_value) :
			storage(int64_t(p_value)) {}
	Variant(const char *p_value) :
			storage(std::string(p_value)) {}
	Variant(std::string p_value) :
			storage(std::move(p_value)) {}
	Variant(const Vector2 &p_value) :
			storage(p_value) {}
	Variant(const Vector2i &p_value) :
			storage(p_value) {}
	Variant(const Vector3 &p_value) :
			storage(p_value) {}
	Variant(const Vector3i &p_value) :
			storage(p_value) {}
	Variant(const Vector4 &p_value) :
			storage(p_value) {}
	Variant(const Quaternion &p_value) :
			storage(p_value) {}
	Variant(const Basis &p_value) :
			storage(p_value) {}
	Variant(const Transform3D &p_value) :
			storage(p_value) {}
	Variant(const lucent::AABB &p_value) :
			storage(p_value) {}
	Variant(const Color &p_value) :
			storage(p_value) {}
	Variant(NodePath p_value) :
			storage(std::move(p_value)) {}
	Variant(Array p_value);
	Variant(Dictionary p_value);
	Variant(std::vector<uint8_t> p_value) :
			storage(std::move(p_value)) {}
	Variant(std::vector<int32_t> p_value) :
			storage(std::move(p_value)) {}
	Variant(std::vector<float> p_value) :
			storage(std::move(p_value)) {}
	Variant(std::vector<Vector2> p_value) :
			storage(std::move(p_value)) {}
	Variant(std::vector<Vector3> p_value) :
			storage(std::move(p_value)) {}
	Variant(std::vector<Color> p_value) :
			storage(std::move(p_value)) {}
	Variant(std::vector<std::string> p_value) :
			storage(std::move(p_value)) {}
	Variant(Callable p_value) :
			storage(std::move(p_value)) {}
	// Null becomes an OBJECT that is null. A Resource that a Ref owns is shared, everything else is weak.
	Variant(Object *p_object);
	template <typename T>
	requires std::is_convertible_v<T *, Resource *>
	Variant(const Ref<T> &p_resource) :
			Variant(from_resource(p_resource)) {}

	Type get_type() const { return Type(storage.index()); }
	bool is_nil() const { return get_type() == Type::NIL; }
	// Null or a dead object; NIL counts.
	bool is_null() const;

	// The value if it is held as exactly that type, else null.
	template <typename T>
	const T *get_if() const { return std::get_if<T>(&storage); }
	template <typename T>
	T *get_if() { return std::get_if<T>(&storage); }
	// p_visit(value) by its own type.
	template <typename F>
	decltype(auto) visit(F &&p_visit) const { return std::visit(std::forward<F>(p_visit), storage); }
	// The object, or null: not an object, or gone.
	Object *get_object() const;

	// Components, as in "light_color:r" or "transform:origin": x y z w, r g b a, origin, basis, position, size. NIL: none such.
	Variant get_component(const std::string &p_name) const;
	bool set_component(const std::string &p_name, const Variant &p_value);

	// Numbers compare by value across INT and FLOAT; other types must match.
	bool operator==(const Variant &p_other) const;

	// Godot's text syntax: 1.5, "text", Vector3(1, 2, 3), NodePath("A:b"). Objects: <Class#id>.
	std::string to_string() const;
	static const char *get_type_name(Type p_type); // "Nil", "bool", "int", "Vector3"

private:
	static Variant from_resource(Ref<Resource> p_resource);

	Storage storage;
};

} // namespace lucent
