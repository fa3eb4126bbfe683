// SPDX-License-Identifier: MIT
#include "modules/python/py_values.h"

#include "modules/python/py_script.h"

namespace lucent::python {

ValueTypes value_types;

namespace {

// A tuple of a value class. p_items are stolen.
PyObject *make_tuple(PyTypeObject *p_type, std::initializer_list<PyObject *> p_items) {
	PyObject *tuple = p_type->tp_alloc(p_type, Py_ssize_t(p_items.size()));
	Py_ssize_t i = 0;
	for (PyObject *item : p_items) {
		if (tuple && item) {
			PyTuple_SET_ITEM(tuple, i++, item);
		} else {
			Py_XDECREF(item);
			Py_CLEAR(tuple);
		}
	}
	return tuple;
}

PyObject *number(float p_value) {
	return PyFloat_FromDouble(double(p_value));
}

PyObject *vector3(const Vector3 &p_value) {
	return make_tuple(value_types.vector3, { number(p_value.x), number(p_value.y), number(p_value.z) });
}

PyObject *basis(const Basis &p_value) {
	return make_tuple(value_types.basis, { vector3(p_value[0]), vector3(p_value[1]), vector3(p_value[2]) });
}

PyObject *color(const Color &p_value) {
	return make_tuple(
			value_types.color, { number(p_value.r), number(p_value.g), number(p_value.b), number(p_value.a) });
}

PyObject *string(const std::string &p_text) {
	return PyUnicode_DecodeUTF8(p_text.data(), Py_ssize_t(p_text.size()), "replace");
}

template <typename T, typename F>
PyObject *list(const std::vector<T> &p_values, F &&p_convert) {
	PyObject *result = PyList_New(Py_ssize_t(p_values.size()));
	for (size_t i = 0; result && i < p_values.size(); i++) {
		PyObject *item = p_convert(p_values[i]);
		if (!item) {
			Py_CLEAR(result);
			break;
		}
		PyList_SET_ITEM(result, Py_ssize_t(i), item);
	}
	return result;
}

PyObject *dictionary(const Dictionary &p_value) {
	PyObject *result = PyDict_New();
	for (const auto &[key, value] : p_value.entries) {
		PyObject *python_key = to_python(key);
		PyObject *python_value = to_python(value);
		if (!python_key || !python_value || PyDict_SetItem(result, python_key, python_value) < 0) {
			Py_CLEAR(result);
		}
		Py_XDECREF(python_key);
		Py_XDECREF(python_value);
		if (!result) {
			break;
		}
	}
	return result;
}

struct Converter {
	PyObject *operator()(std::monostate) { Py_RETURN_NONE; }
	PyObject *operator()(bool p_value) { return PyBool_FromLong(p_value); }
	PyObject *operator()(int64_t p_value) { return PyLong_FromLongLong(p_value); }
	PyObject *operator()(double p_value) { return PyFloat_FromDouble(p_value); }
	PyObject *operator()(const std::string &p_value) { return string(p_value); }
	PyObject *operator()(const Vector2 &p_value) {
		return make_tuple(value_types.vector2, { number(p_value.x), number(p_value.y) });
	}
	PyObject *operator()(const Vector2i &p_value) {
		return make_tuple(value_types.vector2i, { PyLong_FromLong(p_value.x), PyLong_FromLong(p_value.y) });
	}
	PyObject *operator()(const Vector3 &p_value) { return vector3(p_value); }
	PyObject *operator()(const Vector3i &p_value) {
		return make_tuple(value_types.vector3i,
				{ PyLong_FromLong(p_value.x), PyLong_FromLong(p_value.y), PyLong_FromLong(p_value.z) });
	}
	PyObject *operator()(const Vector4 &p_value) {
		return make_tuple(
				value_types.vector4, { number(p_value.x), number(p_value.y), number(p_value.z), number(p_value.w) });
	}
	PyObject *operator()(const Quaternion &p_value) {
		return make_tuple(
				value_types.quaternion, { number(p_value.x), number(p_value.y), number(p_value.z), number(p_value.w) });
	}
	PyObject *operator()(const Basis &p_value) { return basis(p_value); }
	PyObject *operator()(const Transform3D &p_value) {
		return make_tuple(value_types.transform, { basis(p_value.basis), vector3(p_value.origin) });
	}
	PyObject *operator()(const AABB &p_value) {
		const AABB box = p_value.is_empty() ? AABB{ Vector3(0.0f), Vector3(0.0f) } : p_value;
		return make_tuple(value_types.aabb, { vector3(box.min), vector3(box.size()) });
	}
	PyObject *operator()(const Color &p_value) { return color(p_value); }
	PyObject *operator()(const NodePath &p_value) {
		PyObject *path = string(p_value.text);
		PyObject *result = path ? PyObject_CallOneArg(reinterpret_cast<PyObject *>(value_types.node_path), path)
								: nullptr;
		Py_XDECREF(path);
		return result;
	}
	PyObject *operator()(const ObjectHandle &p_value) { return wrap(ObjectDB::get(p_value.id)); }
	PyObject *operator()(const Array &p_value) { return list(p_value, to_python); }
	PyObject *operator()(const Dictionary &p_value) { return dictionary(p_value); }
	PyObject *operator()(const std::vector<uint8_t> &p_value) {
		return PyBytes_FromStringAndSize(reinterpret_cast<const char *>(p_value.data()), Py_ssize_t(p_value.size()));
	}
	PyObject *operator()(const std::vector<std::string> &p_value) { return list(p_value, string); }
	PyObject *operator()(const Callable &p_value) {
		PyObject *function = p_value.target ? function_of(*p_value.target) : nullptr;
		return Py_NewRef(function ? function : Py_None);
	}
	template <typename T>
	PyObject *operator()(const std::vector<T> &p_value) {
		return list(p_value, *this);
	}
	PyObject *operator()(int32_t p_value) { return PyLong_FromLong(p_value); }
	PyObject *operator()(float p_value) { return number(p_value); }
};

} // namespace

PyObject *to_python(const Variant &p_value) {
	return p_value.visit(Converter());
}

bool set_value_types(PyObject *p_types) {
	const std::pair<const char *, PyTypeObject **> names[] = {
		{ "Vector2", &value_types.vector2 },
		{ "Vector2i", &value_types.vector2i },
		{ "Vector3", &value_types.vector3 },
		{ "Vector3i", &value_types.vector3i },
		{ "Vector4", &value_types.vector4 },
		{ "Quaternion", &value_types.quaternion },
		{ "Basis", &value_types.basis },
		{ "Transform3D", &value_types.transform },
		{ "AABB", &value_types.aabb },
		{ "Color", &value_types.color },
		{ "NodePath", &value_types.node_path },
	};
	for (const auto &[name, type] : names) {
		PyObject *value = PyDict_GetItemString(p_types, name);
		if (!value || !PyType_Check(value)) {
			PyErr_Format(PyExc_KeyError, "%s", name);
			return false;
		}
		*type = reinterpret_cast<PyTypeObject *>(Py_NewRef(value));
	}
	return true;
}

std::string type_name(PyObject *p_object) {
	const std::string name = Py_TYPE(p_object)->tp_name;
	return name.substr(name.rfind('.') + 1);
}

} // namespace lucent::python
