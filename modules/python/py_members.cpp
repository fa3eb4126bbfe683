// SPDX-License-Identifier: MIT
// Properties and methods of the classes: descriptors around what ClassDB has.
#include "modules/python/py_values.h"

#include <structmember.h>

namespace lucent::python {

PyTypeObject *property_type = nullptr;
PyTypeObject *method_type = nullptr;

namespace {

PyObject *property_get(PyObject *p_self, PyObject *p_object, PyObject *) {
	if (!p_object || p_object == Py_None) {
		Py_INCREF(p_self);
		return p_self;
	}
	const Property *property = reinterpret_cast<Property *>(p_self);
	if (!PyObject_TypeCheck(p_object, property->owner)) {
		PyErr_Format(
				PyExc_TypeError, "%s has no property '%s'", Py_TYPE(p_object)->tp_name, property->info->name.c_str());
		return nullptr;
	}
	Entry entry;
	const Object *object = entry ? live_object(reinterpret_cast<Handle *>(p_object)) : nullptr;
	if (!object) {
		return nullptr;
	}
	PyObject *value = to_python(property->info->get(*object));
	if (value && property->enum_members) {
		if (PyObject *member = PyDict_GetItem(property->enum_members, value)) {
			Py_INCREF(member);
			Py_SETREF(value, member);
		}
	}
	return value;
}

int property_set(PyObject *p_self, PyObject *p_object, PyObject *p_value) {
	const Property *property = reinterpret_cast<Property *>(p_self);
	const PropertyInfo &info = *property->info;
	if (!p_value) {
		PyErr_Format(PyExc_AttributeError, "property '%s' can't be deleted", info.name.c_str());
		return -1;
	}
	if (!PyObject_TypeCheck(p_object, property->owner)) {
		PyErr_Format(PyExc_TypeError, "%s has no property '%s'", Py_TYPE(p_object)->tp_name, info.name.c_str());
		return -1;
	}
	Entry entry;
	Object *object = entry ? live_object(reinterpret_cast<Handle *>(p_object)) : nullptr;
	if (!object) {
		return -1;
	}
	const std::optional<Variant> value = to_variant(p_value, info.type, info.class_name);
	if (!value) {
		if (!PyErr_Occurred()) {
			const ArgumentInfo expected = { "", info.type, info.class_name };
			PyErr_Format(PyExc_TypeError, "%s.%s expects %s, got %s", object->get_class(), info.name.c_str(),
					type_text(expected).c_str(), type_name(p_value).c_str());
		}
		return -1;
	}
	const Status status = info.checked_set(*object, *value);
	if (!status) {
		raise(status.error());
		return -1;
	}
	return entry.finish() ? 0 : -1;
}

// The positional and named arguments of a call, in order. False: a Python error is set.
bool read_arguments(const Method &p_method, const std::string &p_name, PyObject *const *p_values, size_t p_count,
		PyObject *p_names, Array &r_arguments) {
	const MethodInfo &info = *p_method.info;
	const auto read = [&](size_t p_index, PyObject *p_value) {
		const ArgumentInfo argument = p_index < info.arguments.size() ? info.arguments[p_index]
																	  : ArgumentInfo{ "", Variant::Type::NIL, "" };
		std::optional<Variant> value = to_variant(p_value, argument.type, argument.class_name);
		if (!value && !PyErr_Occurred()) {
			PyErr_Format(PyExc_TypeError, "%s(): argument %zu (%s): expected %s, got %s", p_name.c_str(), p_index + 1,
					argument.name.c_str(), type_text(argument).c_str(), type_name(p_value).c_str());
		}
		return value;
	};
	for (size_t i = 0; i < p_count; i++) {
		std::optional<Variant> value = read(i, p_values[i]);
		if (!value) {
			return false;
		}
		r_arguments.push_back(std::move(*value));
	}
	const size_t named = p_names ? size_t(PyTuple_GET_SIZE(p_names)) : 0;
	const size_t least = info.arguments.size() - info.default_arguments.size();
	std::vector<bool> given(info.arguments.size(), false);
	std::fill_n(given.begin(), std::min(p_count, given.size()), true);
	for (size_t i = 0; i < named; i++) {
		const char *name = PyUnicode_AsUTF8(PyTuple_GET_ITEM(p_names, Py_ssize_t(i)));
		size_t index = 0;
		while (name && index < info.arguments.size() && info.arguments[index].name != name) {
			index++;
		}
		if (index == info.arguments.size() || given[index]) {
			PyErr_Format(PyExc_TypeError,
					index == info.arguments.size() ? "%s() has no argument '%s'" : "%s() got argument '%s' twice",
					p_name.c_str(), name ? name : "?");
			return false;
		}
		std::optional<Variant> value = read(index, p_values[p_count + i]);
		if (!value) {
			return false;
		}
		while (r_arguments.size() <= index) { // what a name skips has its default
			const size_t place = r_arguments.size();
			r_arguments.push_back(place < least ? Variant() : info.default_arguments[place - least]);
		}
		r_arguments[index] = std::move(*value);
		given[index] = true;
	}
	for (size_t i = 0; named > 0 && i < least; i++) {
		if (!given[i]) {
			PyErr_Format(PyExc_TypeError, "%s() lacks argument '%s'", p_name.c_str(), info.arguments[i].name.c_str());
			return false;
		}
	}
	return true;
}

PyObject *method_call(PyObject *p_self, PyObject *const *p_values, size_t p_flags, PyObject *p_names) {
	const Method &method = *reinterpret_cast<Method *>(p_self);
	const MethodInfo &info = *method.info;
	const std::string name = method.class_info->name + "." + info.name;
	size_t count = size_t(PyVectorcall_NARGS(p_flags));
	Object *object = nullptr;
	Entry entry;
	if (!entry) {
		return nullptr;
	}
	if (!info.is_static) {
		if (count == 0 || !PyObject_TypeCheck(p_values[0], method.owner)) {
			PyErr_Format(PyExc_TypeError, "%s() needs a %s as its first argument", name.c_str(),
					method.class_info->name.c_str());
			return nullptr;
		}
		object = live_object(reinterpret_cast<Handle *>(p_values[0]));
		if (!object) {
			return nullptr;
		}
		p_values++;
		count--;
	}
	if (info.is_virtual) {
		Py_RETURN_NONE; // super()._ready()
	}
	Array arguments;
	arguments.reserve(info.arguments.size());
	if (!read_arguments(method, name, p_values, count, p_names, arguments)) {
		return nullptr;
	}
	Result<Variant> result = info.checked_call(method.class_info->name, object, arguments);
	if (!result) {
		return entry.finish() ? raise(result.error()) : nullptr;
	}
	return entry.finish() ? to_python(result.value()) : nullptr;
}

PyObject *method_get(PyObject *p_self, PyObject *p_object, PyObject *) {
	if (!p_object || p_object == Py_None || reinterpret_cast<Method *>(p_self)->info->is_static) {
		Py_INCREF(p_self);
		return p_self;
	}
	return PyMethod_New(p_self, p_object);
}

PyObject *text(const std::string &p_text) {
	return PyUnicode_FromStringAndSize(p_text.data(), Py_ssize_t(p_text.size()));
}

PyObject *property_name(PyObject *p_self, void *) {
	return text(reinterpret_cast<Property *>(p_self)->info->name);
}
PyObject *property_doc(PyObject *p_self, void *) {
	return text(reinterpret_cast<Property *>(p_self)->info->documentation);
}
PyObject *method_name(PyObject *p_self, void *) {
	return text(reinterpret_cast<Method *>(p_self)->info->name);
}
PyObject *method_doc(PyObject *p_self, void *) {
	return text(reinterpret_cast<Method *>(p_self)->info->documentation);
}
// "($self, target, up=..., /)": help() and inspect.signature() read it.
PyObject *method_signature(PyObject *p_self, void *) {
	const MethodInfo &info = *reinterpret_cast<Method *>(p_self)->info;
	std::string signature = info.is_static ? "(" : "($self";
	const size_t least = info.arguments.size() - info.default_arguments.size();
	for (size_t i = 0; i < info.arguments.size(); i++) {
		signature += (signature.size() > 1 ? ", " : "") + info.arguments[i].name + (i < least ? "" : "=...");
	}
	return text(signature + (info.is_vararg ? ", *args)" : ")"));
}

PyGetSetDef PROPERTY_FIELDS[] = {
	{ "__name__", property_name, nullptr, nullptr, nullptr },
	{ "__doc__", property_doc, nullptr, nullptr, nullptr },
	{ nullptr, nullptr, nullptr, nullptr, nullptr },
};
PyGetSetDef METHOD_FIELDS[] = {
	{ "__name__", method_name, nullptr, nullptr, nullptr },
	{ "__doc__", method_doc, nullptr, nullptr, nullptr },
	{ "__text_signature__", method_signature, nullptr, nullptr, nullptr },
	{ nullptr, nullptr, nullptr, nullptr, nullptr },
};
PyMemberDef METHOD_MEMBERS[] = {
	{ "__vectorcalloffset__", T_PYSSIZET, offsetof(Method, vectorcall), READONLY, nullptr },
	{ nullptr, 0, 0, 0, nullptr },
};

} // namespace

PyObject *make_property(const PropertyInfo &p_info) {
	Property *property = reinterpret_cast<Property *>(property_type->tp_alloc(property_type, 0));
	if (property) {
		property->info = &p_info;
		property->owner = handle_type;
		property->enum_members = nullptr;
	}
	return reinterpret_cast<PyObject *>(property);
}

PyObject *make_method(const MethodInfo &p_info, const ClassInfo &p_class) {
	Method *method = reinterpret_cast<Method *>(method_type->tp_alloc(method_type, 0));
	if (method) {
		method->info = &p_info;
		method->class_info = &p_class;
		method->owner = handle_type;
		method->vectorcall = method_call;
	}
	return reinterpret_cast<PyObject *>(method);
}

bool make_member_types(PyObject *p_module) {
	static PyType_Slot property_slots[] = {
		{ Py_tp_descr_get, reinterpret_cast<void *>(property_get) },
		{ Py_tp_descr_set, reinterpret_cast<void *>(property_set) },
		{ Py_tp_getset, PROPERTY_FIELDS },
		{ 0, nullptr },
	};
	static PyType_Slot method_slots[] = {
		{ Py_tp_descr_get, reinterpret_cast<void *>(method_get) },
		{ Py_tp_call, reinterpret_cast<void *>(PyVectorcall_Call) },
		{ Py_tp_getset, METHOD_FIELDS },
		{ Py_tp_members, METHOD_MEMBERS },
		{ 0, nullptr },
	};
	static PyType_Spec property_spec = { "lucent._lucent.Property", sizeof(Property), 0, Py_TPFLAGS_DEFAULT,
		property_slots };
	static PyType_Spec method_spec = { "lucent._lucent.Method", sizeof(Method), 0,
		Py_TPFLAGS_DEFAULT | Py_TPFLAGS_METHOD_DESCRIPTOR | Py_TPFLAGS_HAVE_VECTORCALL, method_slots };
	property_type = reinterpret_cast<PyTypeObject *>(PyType_FromSpec(&property_spec));
	method_type = reinterpret_cast<PyTypeObject *>(PyType_FromSpec(&method_spec));
	return property_type && method_type &&
			PyModule_AddObjectRef(p_module, "Property", reinterpret_cast<PyObject *>(property_type)) == 0 &&
			PyModule_AddObjectRef(p_module, "Method", reinterpret_cast<PyObject *>(method_type)) == 0;
}

} // namespace lucent::python
