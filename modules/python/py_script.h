// SPDX-License-Identifier: MIT
#pragma once
// Python classes as scripts of nodes, Python callables as receivers of signals.

#include "modules/python/py_object.h"

namespace lucent::python {

class PythonScript final : public ScriptInstance {
public:
	// p_self: the handle, an instance of a Python class; p_strong: C++ owns the object, so the object owns its Python
	// half.
	PythonScript(PyObject *p_self, bool p_strong);
	~PythonScript() override;
	bool has_callback(ScriptCallback p_callback) const override { return callbacks[size_t(p_callback)] != nullptr; }
	void callback(ScriptCallback p_callback, double p_argument) override;
	bool has_method(const std::string &p_method) const override;
	Result<Variant> call(const std::string &p_method, const Array &p_arguments) override;
	void owned_by_script(bool p_owned) override;
	void copy_to(Object &r_copy) const override;
	PyObject *self() const { return half; }
	bool is_strong() const { return strong; }

private:
	PyObject *half;
	bool strong;
	PyObject *callbacks[5] = {}; // functions of the class, borrowed from it: the half keeps its class
};

// p_function: called with the signal's arguments. A bound method of a node ends with that node.
Callable make_callable(PyObject *p_function);
// The function of make_callable; null: another kind. Borrowed.
PyObject *function_of(const CallableTarget &p_target);

} // namespace lucent::python
