// SPDX-License-Identifier: MIT
#include "servers/core/variant.h"

#include "servers/core/object.h"

namespace lucent {

const Variant *Dictionary::find(const Variant &p_key) const {
	for (const auto &[key, value] : entries) {
		if (key == p_key) {
			return &value;
		}
	}
	return nullptr;
}

void Dictionary::set(const Variant &p_key, const Variant &p_value) {
	for (auto &[key, value] : entries) {
		if (key == p_key) {
			value = p_value;
			return;
		}
	}
	entries.emplace_back(p_key, p_value);
}

bool Dictionary::operator==(const Dictionary &p_other) const {
	return entries == p_other.entries;
}

Variant::Variant(Array p_value) :
		storage(std::move(p_value)) {}
Variant::Variant(Dictionary p_value) :
		storage(std::move(p_value)) {}

Variant::Variant(Object *p_object) {
	ObjectHandle handle;
	if (p_object) {
		handle.id = p_object->get_instance_id();
		if (Resource *resource = dynamic_cast<Resource *>(p_object)) {
			handle.resource = resource->weak_from_this().lock();
		}
	}
	storage = std::move(handle);
}

Variant Variant::from_resource(Ref<Resource> p_resource) {
	Variant variant;
	const ObjectID id = p_resource ? p_resource->get_instance_id() : ObjectID();
	variant.storage = ObjectHandle{ std::move(p_resource), id };
	return variant;
}

bool Variant::is_null() const {
	return is_nil() || (get_type() == Type::OBJECT && !get_object());
}

Object *Variant::get_object() const {
	const ObjectHandle *handle = get_if<ObjectHandle>();
	return handle ? ObjectDB::get(handle->id) : nullptr;
}

bool Variant::operator==(const Variant &p_other) const {
	if (get_type() == Type::INT && p_other.get_type() == Type::FLOAT) {
		return double(*get_if<int64_t>()) == *p_other.get_if<double>();
	}
	if (get_type() == Type::FLOAT && p_other.get_type() == Type::INT) {
		return p_other == *this;
	}
	return storage == p_other.storage;
}

const char *Variant::get_type_name(Type p_type) {
	static constexpr const char *NAMES[] = { "Nil", "bool", "int", "float", "String", "Vector2", "Vector2i", "Vector3", "Vector3i", "Vector4", "Quaternion",
		"Basis", "Transform3D", "AABB", "Color", "NodePath", "Object", "Array", "Dictionary", "PackedByteArray", "PackedInt32Array", "PackedFloat32Array",
		"PackedVector2Array", "PackedVector3Array", "PackedColorArray", "PackedStringArray", "Callable" };
	static_assert(std::size(NAMES) == size_t(Type::COUNT) && std::variant_size_v<Storage> == size_t(Type::COUNT));
	return p_type < Type::COUNT ? NAMES[size_t(p_type)] : "";
}

// One index for x y z w and r g b a; -1: neither.
static int component_index(const std::string &p_name) {
	if (p_name.size() != 1) {
		return -1;
	}
	const size_t position = std::string_view("xyzw").find(p_name[0]);
	return position == std::string_view::npos ? -1 : int(position);
}

static float *color_component(Color &r_color, const std::string &p_name) {
	if (p_name.size() != 1) {
		return nullptr;
	}
	switch (p_name[0]) {
		case 'r':
			return &r_color.r;
		case 'g':
			return &r_color.g;
		case 'b':
			return &r_color.b;
		case 'a':
			return &r_color.a;
	}
	return nullptr;
}

// Calls p_use with a reference to the named part of the value; false: it has none of that name.
template <typename F>
static bool visit_component(Variant &r_variant, const std::string &p_name, F &&p_use) {
	const int index = component_index(p_name);
	const auto use_vector = [&](auto *p_vector) {
		if (!p_vector || index < 0 || index >= p_vector->length()) {
			return false;
		}
		p_use((*p_vector)[index]);
		return true;
	};
	if (use_vector(r_variant.get_if<Vector2>()) || use_vector(r_variant.get_if<Vector2i>()) || use_vector(r_variant.get_if<Vector3>()) ||
			use_vector(r_variant.get_if<Vector3i>()) || use_vector(r_variant.get_if<Vector4>()) || use_vector(r_variant.get_if<Basis>())) {
		return true;
	}
	if (Color *color = r_variant.get_if<Color>()) {
		float *component = color_component(*color, p_name);
		return component ? (p_use(*component), true) : false;
	}
	if (Transform3D *transform = r_variant.get_if<Transform3D>()) {
		return p_name == "origin" ? (p_use(transform->origin), true) : p_name == "basis" ? (p_use(transform->basis), true)
																						 : false;
	}
	return false;
}

Variant Variant::get_component(const std::string &p_name) const {
	Variant copy = *this;
	Variant result;
	visit_component(copy, p_name, [&](auto &r_part) { result = Variant(r_part); });
	return result;
}

bool Variant::set_component(const std::string &p_name, const Variant &p_value) {
	bool converted = false;
	visit_component(*this, p_name, [&](auto &r_part) {
		if (auto value = variant_cast<std::remove_reference_t<decltype(r_part)>>(p_value)) {
			r_part = *value;
			converted = true;
		}
	});
	return converted;
}

} // namespace lucent
