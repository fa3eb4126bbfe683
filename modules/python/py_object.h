// SPDX-License-Identifier: MIT
#pragma once
// Python's view of Objects. One handle type (an id; for a Resource its Ref), one descriptor type for properties, one
// for methods; the classes themselves are made in Python from what ClassDB says (lucent/__init__.py).
//
// The interpreter's lock (GIL) guards everything here, but a frame is drawn without it. Every entry takes an Entry, so
// that calls from several threads take turns, a call and its callbacks being one turn.

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "servers/core/class_db.h"

namespace lucent::python {

struct Handle {
	PyObject_HEAD ObjectID id;
	Ref<Resource> *resource; // of a Resource
	const ClassInfo *info; // the object's registered class
	std::string *last_path; // of a node, for the error when it is gone
	PyObject *weak_references;
};

struct Property {
	PyObject_HEAD const PropertyInfo *info;
	PyTypeObject *owner; // borrowed: classes of the registry live as long as the module
	PyObject *enum_members; // dict from value to member; null: not an enum
};

struct Method {
	PyObject_HEAD const MethodInfo *info;
	const ClassInfo *class_info;
	PyTypeObject *owner;
	vectorcallfunc vectorcall;
};

extern PyTypeObject *handle_type;
extern PyTypeObject *property_type;
extern PyTypeObject *method_type;
// lucent's exceptions.
extern PyObject *error_type, *load_error, *device_error, *freed_error, *node_not_found_error;

// A turn. False: no turn, and a Python error is set (after a fork).
class Entry {
public:
	Entry();
	~Entry();
	Entry(const Entry &) = delete;
	Entry &operator=(const Entry &) = delete;
	explicit operator bool() const { return entered; }
	// At the end of a call that went well: raises what a callback raised, or what ERR_FAIL_* said. False: an error is
	// set.
	bool finish();

private:
	bool entered = false;
	bool outermost = false;
};
void note_fork(); // in the child
void take_messages(); // from the log, for logging.getLogger("lucent")

// Drops a reference when the outermost Entry ends: the object may be in the middle of something.
void release_later(PyObject *p_object);

// An exception of a callback: kept until the outermost Entry ends. Until then no callback runs.
void keep_exception();
bool has_kept_exception();

// The object's handle: always the same one while it lives. None for null. New reference.
PyObject *wrap(Object *p_object);
PyObject *wrap(const Ref<Resource> &p_resource);
// A handle of another Python class for an object that lives; the earlier handle goes on meaning the object. New
// reference.
PyObject *rewrap(Object &r_object, PyTypeObject *p_type);
// Null: freed, and FreedObjectError is set.
Object *live_object(Handle *p_handle);
bool is_handle(PyObject *p_object);
// The class that a type or its nearest registered base stands for; null: none.
const ClassInfo *class_of(PyTypeObject *p_type);
bool is_registered(PyTypeObject *p_type);
// Says that p_type is the registered class's type.
bool register_type(PyObject *p_type, const char *p_class);
PyTypeObject *type_of(const ClassInfo &p_info);

// Raises what an Error of the registry is in Python: TypeError, ValueError, AttributeError or lucent.Error. Always
// null.
PyObject *raise(const Error &p_error);

// The strong reference of a node's Python half and its receivers, for the cycle collector.
int visit_owned(Object &p_object, visitproc visit, void *arg);

bool make_object_types(PyObject *p_module);
bool make_member_types(PyObject *p_module);

} // namespace lucent::python
