// SPDX-License-Identifier: MIT
// The handle type: life, identity, attributes.
#include "modules/python/py_object.h"

#include "modules/app/suggestion.h"
#include "modules/python/py_script.h"
#include "modules/python/py_tree.h"
#include "modules/python/py_values.h"
#include "modules/scene/scene_tree.h"

#include <structmember.h>

#include <unordered_map>

namespace lucent::python {

PyTypeObject *handle_type = nullptr;

namespace {

std::unordered_map<uint64_t, Handle *> handles; // by id; borrowed
std::unordered_map<PyTypeObject *, const ClassInfo *> registered;
std::unordered_map<const ClassInfo *, PyTypeObject *> types;

std::string describe(Handle *p_handle) {
	Object *object = ObjectDB::get(p_handle->id);
	const char *name = Py_TYPE(p_handle)->tp_name;
	if (!object) {
		return fmt::format("<freed {} #{}>", name, p_handle->id.value);
	}
	if (const scene::Node *node = dynamic_cast<scene::Node *>(object)) {
		return fmt::format("<{} '{}' #{}>", name, node->get_path().text, p_handle->id.value);
	}
	const Resource *resource = dynamic_cast<Resource *>(object);
	const std::string label = resource ? (resource->get_name().empty() ? resource->get_path() : resource->get_name())
									   : "";
	return label.empty() ? fmt::format("<{} #{}>", name, p_handle->id.value)
						 : fmt::format("<{} '{}' #{}>", name, label, p_handle->id.value);
}

Handle *allocate(PyTypeObject *p_type, Object *p_object, Ref<Resource> p_resource) {
	Handle *handle = reinterpret_cast<Handle *>(p_type->tp_alloc(p_type, 0));
	if (handle) {
		handle->id = p_object->get_instance_id();
		handle->resource = p_resource ? new Ref<Resource>(std::move(p_resource)) : nullptr;
		handle->info = ClassDB::get_class_info(p_object->get_class());
		handles[handle->id.value] = handle;
	}
	return handle;
}

PyObject *handle_new(PyTypeObject *p_type, PyObject *, PyObject *) {
	Entry entry;
	if (!entry) {
		return nullptr;
	}
	const ClassInfo *info = class_of(p_type);
	if (!info || !info->instantiable) {
		PyErr_Format(PyExc_TypeError, "%s is abstract: make one of its subclasses",
				info ? info->name.c_str() : p_type->tp_name);
		return nullptr;
	}
	std::unique_ptr<Object> object = info->name == "SceneTree" ? make_tree() : ClassDB::instantiate(info->name);
	Object *raw = object.get();
	Ref<Resource> resource;
	if (dynamic_cast<Resource *>(raw)) {
		resource = Ref<Resource>(static_cast<Resource *>(object.release()));
	}
	Handle *handle = allocate(p_type, raw, resource);
	if (handle && !is_registered(p_type)) {
		raw->set_script_instance(std::make_unique<PythonScript>(reinterpret_cast<PyObject *>(handle), false));
	}
	ScriptOwned::adopt(std::move(object));
	return reinterpret_cast<PyObject *>(handle);
}

// Keywords are properties: OmniLight3D(light_energy=2).
int handle_init(PyObject *p_self, PyObject *p_arguments, PyObject *p_keywords) {
	if (PyTuple_GET_SIZE(p_arguments) > 0) {
		PyErr_Format(PyExc_TypeError, "%s() takes properties by name only, as %s(name=...)", Py_TYPE(p_self)->tp_name,
				Py_TYPE(p_self)->tp_name);
		return -1;
	}
	PyObject *key, *value;
	Py_ssize_t position = 0;
	while (p_keywords && PyDict_Next(p_keywords, &position, &key, &value)) {
		if (PyObject_SetAttr(p_self, key, value) < 0) {
			return -1;
		}
	}
	return 0;
}

// The object ends with its handle where only scripts own it.
void let_go(Handle *p_handle) {
	const Entry entry;
	if (!entry) { // after a fork: the parent's device is not ours to touch
		PyErr_Clear();
		return;
	}
	Object *object = ObjectDB::get(p_handle->id);
	PythonScript *script = object ? dynamic_cast<PythonScript *>(object->get_script_instance()) : nullptr;
	if (script && script->self() == reinterpret_cast<PyObject *>(p_handle)) {
		object->set_script_instance(nullptr);
	}
	if (object && ScriptOwned::contains(p_handle->id)) {
		std::unique_ptr<Object> owned = ScriptOwned::take(p_handle->id);
		if (dynamic_cast<scene::SceneTree *>(object)) {
			close_tree(std::move(owned));
		} else {
			ScriptOwned::destroy(std::move(owned));
		}
	}
}

void handle_dealloc(PyObject *p_self) {
	PyObject_GC_UnTrack(p_self);
	Handle *handle = reinterpret_cast<Handle *>(p_self);
	if (handle->weak_references) {
		PyObject_ClearWeakRefs(p_self);
	}
	const auto found = handles.find(handle->id.value);
	if (found != handles.end() && found->second == handle) {
		handles.erase(found);
		PyObject *type, *value, *traceback;
		PyErr_Fetch(&type, &value, &traceback);
		let_go(handle);
		PyErr_Restore(type, value, traceback);
	}
	delete handle->resource;
	delete handle->last_path;
	PyTypeObject *type = Py_TYPE(p_self);
	type->tp_free(p_self);
	Py_DECREF(type);
}

int handle_traverse(PyObject *p_self, visitproc visit, void *arg) {
	Py_VISIT(Py_TYPE(p_self));
	Handle *handle = reinterpret_cast<Handle *>(p_self);
	Object *object = ScriptOwned::contains(handle->id) ? ObjectDB::get(handle->id) : nullptr;
	return object ? visit_owned(*object, visit, arg) : 0;
}

int handle_clear(PyObject *p_self) {
	let_go(reinterpret_cast<Handle *>(p_self));
	return 0;
}

PyObject *handle_repr(PyObject *p_self) {
	return PyUnicode_FromString(describe(reinterpret_cast<Handle *>(p_self)).c_str());
}

Py_hash_t handle_hash(PyObject *p_self) {
	return Py_hash_t(reinterpret_cast<Handle *>(p_self)->id.value & 0x7FFFFFFFFFFFFFFF);
}

PyObject *handle_compare(PyObject *p_a, PyObject *p_b, int p_operator) {
	if ((p_operator != Py_EQ && p_operator != Py_NE) || !is_handle(p_b)) {
		Py_RETURN_NOTIMPLEMENTED;
	}
	const bool equal = reinterpret_cast<Handle *>(p_a)->id == reinterpret_cast<Handle *>(p_b)->id;
	return PyBool_FromLong(equal == (p_operator == Py_EQ));
}

// A new attribute of a Python class is good unless it looks like a property that was mistyped.
bool is_allowed(PyTypeObject *p_type, PyObject *p_name) {
	static PyObject *known = PyDict_New(); // (type, name) that were found good
	PyObject *key = PyTuple_Pack(2, reinterpret_cast<PyObject *>(p_type), p_name);
	const bool seen = key && PyDict_Contains(known, key) == 1;
	const char *name = PyUnicode_AsUTF8(p_name);
	bool good = seen || !name || name[0] == '_';
	if (!good) {
		std::vector<std::string> names;
		for (const PropertyInfo *property : ClassDB::get_property_list(class_of(p_type)->name)) {
			names.push_back(property->name);
		}
		const size_t length = std::string(name).size(); // short words are near to many
		const std::string near = length > 3 ? suggestion(name, names, length > 5 ? 2 : 1) : "";
		good = near.empty();
		if (good) {
			PyDict_SetItem(known, key, Py_True);
		} else {
			PyErr_Format(PyExc_AttributeError, "%s has no property '%s'%s (declare '%s' in the class if it is yours)",
					p_type->tp_name, name, near.c_str(), name);
		}
	}
	Py_XDECREF(key);
	return good;
}

int handle_setattro(PyObject *p_self, PyObject *p_name, PyObject *p_value) {
	PyTypeObject *type = Py_TYPE(p_self);
	PyObject *member = _PyType_Lookup(type, p_name);
	if (member && Py_TYPE(member) == property_type && p_value) {
		return property_type->tp_descr_set(member, p_self, p_value);
	}
	if (!member && is_registered(type)) {
		std::vector<std::string> names;
		for (const PropertyInfo *property : ClassDB::get_property_list(class_of(type)->name)) {
			names.push_back(property->name);
		}
		const char *name = PyUnicode_AsUTF8(p_name);
		PyErr_Format(PyExc_AttributeError, "%s has no property '%s'%s", type->tp_name, name ? name : "?",
				name ? suggestion(name, names).c_str() : "");
		return -1;
	}
	PyObject **dict = p_value && !member ? _PyObject_GetDictPtr(p_self) : nullptr;
	const bool present = dict && *dict && PyDict_Contains(*dict, p_name) == 1;
	if (dict && !present && !is_allowed(type, p_name)) {
		return -1;
	}
	return PyObject_GenericSetAttr(p_self, p_name, p_value);
}

PyObject *handle_is_valid(PyObject *p_self, PyObject *) {
	return PyBool_FromLong(ObjectDB::get(reinterpret_cast<Handle *>(p_self)->id) != nullptr);
}

PyObject *handle_reduce(PyObject *p_self, PyObject *) {
	PyErr_Format(PyExc_TypeError, "a %s can't be pickled: save the scene, or send its path", Py_TYPE(p_self)->tp_name);
	return nullptr;
}

PyMethodDef HANDLE_METHODS[] = {
	{ "_is_valid", handle_is_valid, METH_NOARGS, nullptr },
	{ "__reduce__", handle_reduce, METH_NOARGS, nullptr },
	{ nullptr, nullptr, 0, nullptr },
};

PyMemberDef HANDLE_MEMBERS[] = {
	{ "__weaklistoffset__", T_PYSSIZET, offsetof(Handle, weak_references), READONLY, nullptr },
	{ nullptr, 0, 0, 0, nullptr },
};

} // namespace

bool is_handle(PyObject *p_object) {
	return PyObject_TypeCheck(p_object, handle_type);
}

const ClassInfo *class_of(PyTypeObject *p_type) {
	for (; p_type; p_type = p_type->tp_base) {
		if (const auto found = registered.find(p_type); found != registered.end()) {
			return found->second;
		}
	}
	return nullptr;
}

bool is_registered(PyTypeObject *p_type) {
	return registered.contains(p_type);
}

PyTypeObject *type_of(const ClassInfo &p_info) {
	const auto found = types.find(&p_info);
	return found == types.end() ? handle_type : found->second;
}

bool register_type(PyObject *p_type, const char *p_class) {
	const ClassInfo *info = ClassDB::get_class_info(p_class);
	if (!info || !PyType_Check(p_type)) {
		PyErr_Format(PyExc_ValueError, "there is no class %s", p_class);
		return false;
	}
	PyTypeObject *type = reinterpret_cast<PyTypeObject *>(p_type);
	Py_INCREF(p_type);
	registered[type] = info;
	types[info] = type;
	PyObject *key, *value;
	Py_ssize_t position = 0;
	while (PyDict_Next(type->tp_dict, &position, &key, &value)) {
		if (Py_TYPE(value) == property_type) {
			reinterpret_cast<Property *>(value)->owner = type;
		} else if (Py_TYPE(value) == method_type) {
			reinterpret_cast<Method *>(value)->owner = type;
		}
	}
	return true;
}

PyObject *wrap(Object *p_object) {
	if (!p_object) {
		Py_RETURN_NONE;
	}
	const auto found = handles.find(p_object->get_instance_id().value);
	if (found != handles.end()) {
		PyObject *handle = reinterpret_cast<PyObject *>(found->second);
		Py_INCREF(handle);
		return handle;
	}
	Resource *resource = dynamic_cast<Resource *>(p_object);
	return reinterpret_cast<PyObject *>(allocate(type_of(*ClassDB::get_class_info(p_object->get_class())), p_object,
			resource ? resource->weak_from_this().lock() : nullptr));
}

PyObject *wrap(const Ref<Resource> &p_resource) {
	return wrap(static_cast<Object *>(p_resource.get()));
}

PyObject *rewrap(Object &r_object, PyTypeObject *p_type) {
	Handle *handle = allocate(p_type, &r_object, nullptr);
	if (handle) {
		r_object.set_script_instance(std::make_unique<PythonScript>(
				reinterpret_cast<PyObject *>(handle), !ScriptOwned::contains(r_object.get_instance_id())));
	}
	return reinterpret_cast<PyObject *>(handle);
}

Object *live_object(Handle *p_handle) {
	Object *object = ObjectDB::get(p_handle->id);
	if (!object) {
		const std::string path = p_handle->last_path ? fmt::format(" '{}'", *p_handle->last_path) : "";
		PyErr_Format(freed_error, "%s%s (id %llu) was freed", Py_TYPE(p_handle)->tp_name, path.c_str(),
				static_cast<unsigned long long>(p_handle->id.value));
	}
	return object;
}

int visit_owned(Object &p_object, visitproc visit, void *arg) {
	int result = 0;
	const auto visit_one = [&](PyObject *p_reference) {
		if (p_reference && result == 0) {
			result = visit(p_reference, arg);
		}
	};
	const PythonScript *script = dynamic_cast<PythonScript *>(p_object.get_script_instance());
	visit_one(script && script->is_strong() ? script->self() : nullptr);
	p_object.visit_callables([&](const Callable &p_callable) { visit_one(function_of(*p_callable.target)); });
	if (scene::SceneTree *tree = dynamic_cast<scene::SceneTree *>(&p_object)) {
		return result ? result : visit_owned(*tree->get_root(), visit, arg);
	}
	if (scene::Node *node = dynamic_cast<scene::Node *>(&p_object)) {
		for (int i = 0; i < node->get_child_count() && result == 0; i++) {
			result = visit_owned(*node->get_child(i), visit, arg);
		}
	}
	return result;
}

PyObject *raise(const Error &p_error) {
	const std::string &text = p_error.message;
	const auto says = [&](const char *p_part) { return text.find(p_part) != std::string::npos; };
	// The registry's sentences: class_db.h, property_info.cpp, object_bind.cpp.
	PyObject *type = error_type;
	if (says("(): argument ") || says("() takes ") || says(" expects ")) {
		type = PyExc_TypeError;
	} else if (says(" must be ") || says(", row ")) {
		type = PyExc_ValueError;
	} else if (says("has no property '") || says("has no signal '") || says("has no method '") ||
			says("is read-only")) {
		type = PyExc_AttributeError;
	}
	PyErr_SetString(type, text.c_str());
	return nullptr;
}

bool make_object_types(PyObject *p_module) {
	static PyType_Slot slots[] = {
		{ Py_tp_new, reinterpret_cast<void *>(handle_new) },
		{ Py_tp_init, reinterpret_cast<void *>(handle_init) },
		{ Py_tp_dealloc, reinterpret_cast<void *>(handle_dealloc) },
		{ Py_tp_traverse, reinterpret_cast<void *>(handle_traverse) },
		{ Py_tp_clear, reinterpret_cast<void *>(handle_clear) },
		{ Py_tp_repr, reinterpret_cast<void *>(handle_repr) },
		{ Py_tp_hash, reinterpret_cast<void *>(handle_hash) },
		{ Py_tp_richcompare, reinterpret_cast<void *>(handle_compare) },
		{ Py_tp_setattro, reinterpret_cast<void *>(handle_setattro) },
		{ Py_tp_methods, HANDLE_METHODS },
		{ Py_tp_members, HANDLE_MEMBERS },
		{ 0, nullptr },
	};
	static PyType_Spec spec = { "lucent._lucent.Handle", sizeof(Handle), 0,
		Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC, slots };
	handle_type = reinterpret_cast<PyTypeObject *>(PyType_FromSpec(&spec));
	return handle_type && PyModule_AddObjectRef(p_module, "Handle", reinterpret_cast<PyObject *>(handle_type)) == 0;
}

} // namespace lucent::python
