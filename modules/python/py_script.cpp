// SPDX-License-Identifier: MIT
#include "modules/python/py_script.h"

#include "modules/python/py_values.h"
#include "modules/scene/node.h"

namespace lucent::python {

namespace {

constexpr const char *CALLBACK_NAMES[] = { "_enter_tree", "_exit_tree", "_ready", "_process", "_notification" };

// The function that a Python class defines; null: none, or only the registry's empty one.
PyObject *defined(PyTypeObject *p_type, const char *p_name) {
	PyObject *name = PyUnicode_InternFromString(p_name);
	PyObject *member = name ? _PyType_Lookup(p_type, name) : nullptr;
	Py_XDECREF(name);
	return member && Py_TYPE(member) != method_type && PyCallable_Check(member) ? member : nullptr;
}

// An object that a signal means, as the end of the connection: the node of a bound method.
ObjectID target_of(PyObject *p_function) {
	PyObject *self = PyMethod_Check(p_function) ? PyMethod_GET_SELF(p_function) : nullptr;
	return self && is_handle(self) ? reinterpret_cast<Handle *>(self)->id : ObjectID();
}

class PythonCallable final : public CallableTarget {
public:
	explicit PythonCallable(PyObject *p_function) :
			function(Py_NewRef(p_function)), target(target_of(p_function)) {}
	~PythonCallable() override { Py_DECREF(function); }

	void call(const Array &p_arguments) override {
		if (has_kept_exception()) {
			return;
		}
		PyObject *arguments = PyTuple_New(Py_ssize_t(p_arguments.size()));
		for (size_t i = 0; i < p_arguments.size(); i++) {
			PyObject *value = to_python(p_arguments[i]);
			PyTuple_SET_ITEM(arguments, Py_ssize_t(i), value ? value : Py_NewRef(Py_None));
		}
		PyObject *held = Py_NewRef(function); // the call may end the connection
		PyObject *result = PyObject_Call(held, arguments, nullptr);
		Py_DECREF(arguments);
		Py_DECREF(held);
		Py_XDECREF(result);
		if (!result) {
			keep_exception();
		}
	}
	bool equals(const CallableTarget &p_other) const override {
		PyObject *other = function_of(p_other);
		const int equal = other ? PyObject_RichCompareBool(function, other, Py_EQ) : 0;
		if (equal < 0) {
			PyErr_Clear();
		}
		return equal == 1;
	}
	ObjectID get_object() const override { return target; }

	PyObject *function;
	ObjectID target;
};

} // namespace

PythonScript::PythonScript(PyObject *p_self, bool p_strong) :
		half(p_self), strong(p_strong) {
	if (strong) {
		Py_INCREF(half);
	}
	for (size_t i = 0; i < std::size(CALLBACK_NAMES); i++) {
		callbacks[i] = defined(Py_TYPE(half), CALLBACK_NAMES[i]);
	}
	Object *object = ObjectDB::get(reinterpret_cast<Handle *>(half)->id);
	if (scene::Node *node = dynamic_cast<scene::Node *>(object); node && callbacks[size_t(ScriptCallback::PROCESS)]) {
		node->set_process(true);
	}
}

PythonScript::~PythonScript() {
	if (strong) {
		Py_DECREF(half);
	}
}

void PythonScript::owned_by_script(bool p_owned) {
	if (strong == p_owned) {
		strong = !p_owned;
		if (strong) {
			Py_INCREF(half);
		} else {
			release_later(half);
		}
	}
}

void PythonScript::callback(ScriptCallback p_callback, double p_argument) {
	if (has_kept_exception()) {
		return;
	}
	PyObject *self = Py_NewRef(half); // this script may end in the middle
	PyObject *function = Py_NewRef(callbacks[size_t(p_callback)]);
	PyObject *argument = p_callback == ScriptCallback::PROCESS ? PyFloat_FromDouble(p_argument)
			: p_callback == ScriptCallback::NOTIFICATION       ? PyLong_FromDouble(p_argument)
															   : nullptr;
	PyObject *values[] = { self, argument };
	PyObject *result = PyObject_Vectorcall(function, values, argument ? 2 : 1, nullptr);
	if (!result) {
		keep_exception();
	}
	Py_XDECREF(result);
	Py_XDECREF(argument);
	Py_DECREF(function);
	Py_DECREF(self);
}

bool PythonScript::has_method(const std::string &p_method) const {
	return defined(Py_TYPE(half), p_method.c_str()) != nullptr;
}

Result<Variant> PythonScript::call(const std::string &p_method, const Array &p_arguments) {
	PyObject *self = Py_NewRef(half);
	PyObject *method = PyObject_GetAttrString(self, p_method.c_str());
	PyObject *arguments = PyTuple_New(Py_ssize_t(p_arguments.size()));
	for (size_t i = 0; i < p_arguments.size(); i++) {
		PyObject *value = to_python(p_arguments[i]);
		PyTuple_SET_ITEM(arguments, Py_ssize_t(i), value ? value : Py_NewRef(Py_None));
	}
	PyObject *result = method ? PyObject_Call(method, arguments, nullptr) : nullptr;
	std::optional<Variant> variant = result ? to_variant(result, Variant::Type::NIL, "") : std::nullopt;
	Py_XDECREF(result);
	Py_DECREF(arguments);
	Py_XDECREF(method);
	Py_DECREF(self);
	if (PyErr_Occurred()) {
		keep_exception();
	}
	return variant ? Result<Variant>(*variant) : Result<Variant>(make_error("{}() of a script failed", p_method));
}

void PythonScript::copy_to(Object &r_copy) const {
	PyObject *copy = rewrap(r_copy, Py_TYPE(half));
	PyObject **from = copy ? _PyObject_GetDictPtr(half) : nullptr;
	PyObject *attributes = from && *from ? PyDict_Copy(*from) : nullptr;
	if (attributes && PyObject_SetAttrString(copy, "__dict__", attributes) < 0) {
		keep_exception();
	}
	Py_XDECREF(attributes);
	Py_XDECREF(copy);
}

Callable make_callable(PyObject *p_function) {
	return { std::make_shared<PythonCallable>(p_function) };
}

PyObject *function_of(const CallableTarget &p_target) {
	const PythonCallable *callable = dynamic_cast<const PythonCallable *>(&p_target);
	return callable ? callable->function : nullptr;
}

} // namespace lucent::python
