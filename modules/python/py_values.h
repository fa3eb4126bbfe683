// SPDX-License-Identifier: MIT
#pragma once
// Variants to and from Python. Vector3 and its like are immutable tuples (lucent/_values.py).

#include "modules/python/py_object.h"

#include <optional>

namespace lucent::python {

// The classes of _values.py.
struct ValueTypes {
	PyTypeObject *vector2, *vector2i, *vector3, *vector3i, *vector4;
	PyTypeObject *quaternion, *basis, *transform, *aabb, *color, *node_path;
};
extern ValueTypes value_types;

// New reference; null: an error is set.
PyObject *to_python(const Variant &p_value);
// p_type and p_class: what is expected, NIL for anything. Empty: an error is set if it is not merely another type; the
// caller words that.
std::optional<Variant> to_variant(PyObject *p_object, Variant::Type p_type, const std::string &p_class);
// Takes the classes of _values.py from a dict by name.
bool set_value_types(PyObject *p_types);
// The value's type name for messages: "Vector3", "str", "MeshInstance3D".
std::string type_name(PyObject *p_object);

} // namespace lucent::python
