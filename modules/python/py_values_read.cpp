// SPDX-License-Identifier: MIT
// From Python to Variants.
#include "modules/python/py_script.h"
#include "modules/python/py_values.h"

namespace lucent::python {

namespace {

// The floats of a sequence of p_count, or of p_count / 3 sequences of three. False: another length or kind.
bool read_floats(PyObject *p_object, float *r_values, Py_ssize_t p_count) {
	if (PyUnicode_Check(p_object) || PyDict_Check(p_object) || !PySequence_Check(p_object)) {
		return false;
	}
	PyObject *items = PySequence_Fast(p_object, "");
	if (!items) {
		PyErr_Clear();
		return false;
	}
	const Py_ssize_t size = PySequence_Fast_GET_SIZE(items);
	bool good = size == p_count || (size > 0 && p_count % size == 0 && p_count > size);
	const Py_ssize_t each = good ? p_count / size : 0;
	for (Py_ssize_t i = 0; i < size && good; i++) {
		PyObject *item = PySequence_Fast_GET_ITEM(items, i);
		if (each > 1) {
			good = read_floats(item, r_values + i * each, each);
		} else {
			const double value = PyFloat_Check(item) ? PyFloat_AS_DOUBLE(item)
					: PyUnicode_Check(item)          ? -1.0
													 : PyFloat_AsDouble(item);
			good = !PyUnicode_Check(item) && !(value == -1.0 && PyErr_Occurred()) &&
					!(std::abs(value) > double(std::numeric_limits<float>::max()) && !std::isinf(value));
			r_values[i] = float(value);
		}
	}
	Py_DECREF(items);
	PyErr_Clear();
	return good;
}

template <typename T, typename F>
std::optional<Variant> from_floats(PyObject *p_object, F &&p_make) {
	float values[12];
	constexpr Py_ssize_t COUNT = Py_ssize_t(sizeof(T) / sizeof(float));
	return read_floats(p_object, values, COUNT) ? std::optional<Variant>(Variant(p_make(values))) : std::nullopt;
}

Basis make_basis(const float *p_v) {
	return Basis(Vector3(p_v[0], p_v[1], p_v[2]), Vector3(p_v[3], p_v[4], p_v[5]), Vector3(p_v[6], p_v[7], p_v[8]));
}

// Transform3D is (basis, origin): 9 + 3.
std::optional<Variant> read_transform(PyObject *p_object) {
	float values[12];
	PyObject *items = PyTuple_Check(p_object) && PyTuple_GET_SIZE(p_object) == 2 ? p_object : nullptr;
	if (!items || !read_floats(PyTuple_GET_ITEM(items, 0), values, 9) ||
			!read_floats(PyTuple_GET_ITEM(items, 1), values + 9, 3)) {
		return std::nullopt;
	}
	return Variant(Transform3D{ make_basis(values), Vector3(values[9], values[10], values[11]) });
}

template <typename T>
std::optional<Variant> read_packed(PyObject *p_object) {
	const std::optional<Variant> array = to_variant(p_object, Variant::Type::ARRAY, "");
	T values;
	for (const Variant &element : array ? *array->get_if<Array>() : Array()) {
		auto value = variant_cast<typename T::value_type>(element);
		if (!value) {
			return std::nullopt;
		}
		values.push_back(std::move(*value));
	}
	return array ? std::optional<Variant>(Variant(std::move(values))) : std::nullopt;
}

// Sequences of an expected shape.
std::optional<Variant> read_value(PyObject *p_object, Variant::Type p_type) {
	switch (p_type) {
		case Variant::Type::VECTOR2:
		case Variant::Type::VECTOR2I:
			return from_floats<Vector2>(p_object, [&](const float *p_v) {
				return p_type == Variant::Type::VECTOR2 ? Variant(Vector2(p_v[0], p_v[1]))
														: Variant(Vector2i(int(p_v[0]), int(p_v[1])));
			});
		case Variant::Type::VECTOR3:
		case Variant::Type::VECTOR3I:
			return from_floats<Vector3>(p_object, [&](const float *p_v) {
				return p_type == Variant::Type::VECTOR3 ? Variant(Vector3(p_v[0], p_v[1], p_v[2]))
														: Variant(Vector3i(int(p_v[0]), int(p_v[1]), int(p_v[2])));
			});
		case Variant::Type::VECTOR4:
			return from_floats<Vector4>(
					p_object, [](const float *p_v) { return Vector4(p_v[0], p_v[1], p_v[2], p_v[3]); });
		case Variant::Type::QUATERNION:
			return from_floats<Vector4>(
					p_object, [](const float *p_v) { return Quaternion(p_v[3], p_v[0], p_v[1], p_v[2]); });
		case Variant::Type::BASIS:
			return from_floats<Basis>(p_object, make_basis);
		case Variant::Type::TRANSFORM3D:
			return read_transform(p_object);
		case Variant::Type::AABB:
			return from_floats<AABB>(p_object, [](const float *p_v) {
				return AABB{ Vector3(p_v[0], p_v[1], p_v[2]),
					Vector3(p_v[0] + p_v[3], p_v[1] + p_v[4], p_v[2] + p_v[5]) };
			});
		case Variant::Type::COLOR: {
			std::optional<Variant> rgba = from_floats<Color>(p_object, [](const float *p_v) {
				return Color{ p_v[0], p_v[1], p_v[2], p_v[3] };
			});
			return rgba ? rgba : from_floats<Vector3>(p_object, [](const float *p_v) {
				return Color{ p_v[0], p_v[1], p_v[2], 1.0f };
			});
		}
		case Variant::Type::PACKED_INT32_ARRAY:
			return read_packed<std::vector<int32_t>>(p_object);
		case Variant::Type::PACKED_FLOAT32_ARRAY:
			return read_packed<std::vector<float>>(p_object);
		case Variant::Type::PACKED_STRING_ARRAY:
			return read_packed<std::vector<std::string>>(p_object);
		default:
			return std::nullopt;
	}
}

// What the object itself says that it is.
Variant::Type natural_type(PyObject *p_object) {
	PyTypeObject *type = Py_TYPE(p_object);
	const std::pair<PyTypeObject *, Variant::Type> known[] = {
		{ value_types.vector3, Variant::Type::VECTOR3 },
		{ value_types.color, Variant::Type::COLOR },
		{ value_types.vector2, Variant::Type::VECTOR2 },
		{ value_types.vector2i, Variant::Type::VECTOR2I },
		{ value_types.vector3i, Variant::Type::VECTOR3I },
		{ value_types.vector4, Variant::Type::VECTOR4 },
		{ value_types.quaternion, Variant::Type::QUATERNION },
		{ value_types.basis, Variant::Type::BASIS },
		{ value_types.transform, Variant::Type::TRANSFORM3D },
		{ value_types.aabb, Variant::Type::AABB },
	};
	for (const auto &[value_type, variant_type] : known) {
		if (type == value_type) {
			return variant_type;
		}
	}
	return Variant::Type::NIL;
}

std::optional<Variant> read_sequence(PyObject *p_object) {
	PyObject *items = PySequence_Fast(p_object, "");
	if (!items) {
		PyErr_Clear();
		return std::nullopt;
	}
	Array array;
	bool good = true;
	for (Py_ssize_t i = 0; i < PySequence_Fast_GET_SIZE(items) && good; i++) {
		std::optional<Variant> value = to_variant(PySequence_Fast_GET_ITEM(items, i), Variant::Type::NIL, "");
		good = value.has_value();
		if (good) {
			array.push_back(std::move(*value));
		}
	}
	Py_DECREF(items);
	return good ? std::optional<Variant>(Variant(std::move(array))) : std::nullopt;
}

std::optional<Variant> read_dictionary(PyObject *p_object) {
	Dictionary dictionary;
	PyObject *key, *value;
	Py_ssize_t position = 0;
	while (PyDict_Next(p_object, &position, &key, &value)) {
		std::optional<Variant> variant_key = to_variant(key, Variant::Type::NIL, "");
		std::optional<Variant> variant_value = to_variant(value, Variant::Type::NIL, "");
		if (!variant_key || !variant_value) {
			return std::nullopt;
		}
		dictionary.entries.emplace_back(std::move(*variant_key), std::move(*variant_value));
	}
	return Variant(std::move(dictionary));
}

std::optional<Variant> read_number(PyObject *p_object, Variant::Type p_type) {
	if (PyFloat_Check(p_object)) {
		return Variant(PyFloat_AS_DOUBLE(p_object));
	}
	if (PyBool_Check(p_object)) {
		return Variant(p_object == Py_True);
	}
	if (PyIndex_Check(p_object) && !PySequence_Check(p_object)) { // numpy's integers too
		const long long value = PyNumber_AsSsize_t(p_object, PyExc_OverflowError);
		return value == -1 && PyErr_Occurred() ? std::nullopt : std::optional<Variant>(Variant(int64_t(value)));
	}
	const bool wanted = p_type == Variant::Type::FLOAT || p_type == Variant::Type::INT || p_type == Variant::Type::BOOL;
	if (!PySequence_Check(p_object) && (wanted || PyObject_HasAttrString(p_object, "dtype")) &&
			Py_TYPE(p_object)->tp_as_number && Py_TYPE(p_object)->tp_as_number->nb_float) {
		const double value = PyFloat_AsDouble(p_object);
		return PyErr_Occurred() ? std::nullopt : std::optional<Variant>(Variant(value));
	}
	return std::nullopt;
}

} // namespace

std::optional<Variant> to_variant(PyObject *p_object, Variant::Type p_type, const std::string &) {
	if (p_object == Py_None) {
		return Variant();
	}
	if (std::optional<Variant> number = read_number(p_object, p_type); number || PyErr_Occurred()) {
		return number;
	}
	if (is_handle(p_object)) {
		Object *object = live_object(reinterpret_cast<Handle *>(p_object));
		return object ? std::optional<Variant>(Variant(object)) : std::nullopt;
	}
	if (PyUnicode_Check(p_object)) {
		Py_ssize_t size = 0;
		const char *text = PyUnicode_AsUTF8AndSize(p_object, &size);
		return text ? std::optional<Variant>(Variant(std::string(text, size_t(size)))) : std::nullopt;
	}
	if (Variant::Type natural = natural_type(p_object);
			natural != Variant::Type::NIL && (p_type == Variant::Type::NIL || p_type == natural)) {
		return read_value(p_object, natural);
	}
	if (std::optional<Variant> value = read_value(p_object, p_type); value || PyErr_Occurred()) {
		return value;
	}
	if (PyDict_Check(p_object)) {
		return read_dictionary(p_object);
	}
	if (PyBytes_Check(p_object)) {
		const uint8_t *bytes = reinterpret_cast<const uint8_t *>(PyBytes_AS_STRING(p_object));
		return Variant(std::vector<uint8_t>(bytes, bytes + PyBytes_GET_SIZE(p_object)));
	}
	const bool any = p_type == Variant::Type::NIL || p_type == Variant::Type::ARRAY || p_type == Variant::Type::OBJECT;
	if (any && natural_type(p_object) == Variant::Type::NIL && PySequence_Check(p_object)) {
		return read_sequence(p_object);
	}
	if (PyCallable_Check(p_object) && (p_type == Variant::Type::CALLABLE || p_type == Variant::Type::NIL)) {
		return Variant(make_callable(p_object));
	}
	return std::nullopt;
}

} // namespace lucent::python
