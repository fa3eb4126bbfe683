// SPDX-License-Identifier: MIT
// lucent._lucent: what lucent/__init__.py builds on.
#include "drivers/vulkan/vulkan_driver.h"
#include "modules/app/commands.h"
#include "modules/app/register_modules.h"
#include "modules/app/suggestion.h"
#include "modules/image/image_io.h"
#include "modules/python/py_arrays.h"
#include "modules/python/py_script.h"
#include "modules/python/py_tree.h"
#include "modules/python/py_values.h"
#include "modules/scene/node.h"
#include "modules/scene/resource_loader.h"
#include "modules/scene/scene_tree.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace lucent::python {

namespace py = pybind11;

PyObject *make_property(const PropertyInfo &p_info);
PyObject *make_method(const MethodInfo &p_info, const ClassInfo &p_class);

namespace {

// p_call within a turn; errors become Python's.
template <typename F>
py::object turn(F &&p_call) {
	Entry entry;
	PyObject *result = entry ? p_call() : nullptr;
	if (!result || !entry.finish()) {
		Py_XDECREF(result);
		if (!PyErr_Occurred() && !entry.finish()) {
			throw py::error_already_set();
		}
		throw py::error_already_set();
	}
	return py::reinterpret_steal<py::object>(result);
}

template <typename T>
T &object_of(const py::handle &p_handle, const char *p_what) {
	T *typed = nullptr;
	if (is_handle(p_handle.ptr())) {
		Object *object = live_object(reinterpret_cast<Handle *>(p_handle.ptr()));
		if (!object) {
			throw py::error_already_set();
		}
		typed = dynamic_cast<T *>(object);
	}
	if (!typed) {
		throw py::type_error(fmt::format("expected {}, got {}", p_what, type_name(p_handle.ptr())));
	}
	return *typed;
}

py::object steal(PyObject *p_object) {
	if (!p_object) {
		throw py::error_already_set();
	}
	return py::reinterpret_steal<py::object>(p_object);
}

py::list argument_list(const std::vector<ArgumentInfo> &p_arguments) {
	py::list list;
	for (const ArgumentInfo &argument : p_arguments) {
		list.append(py::make_tuple(argument.name, Variant::get_type_name(argument.type), argument.class_name));
	}
	return list;
}

py::dict class_members(const std::string &p_class) {
	const ClassInfo &info = *ClassDB::get_class_info(p_class);
	py::list properties, methods, signals, constants;
	for (const PropertyInfo &property : info.properties) {
		properties.append(
				py::make_tuple(property.name, steal(make_property(property)), Variant::get_type_name(property.type),
						property.class_name, property.hint == PropertyHint::ENUM, !property.set));
	}
	for (const MethodInfo &method : info.methods) {
		py::list defaults;
		for (const Variant &value : method.default_arguments) {
			defaults.append(value.to_string());
		}
		py::dict facts;
		facts["arguments"] = argument_list(method.arguments);
		facts["result"] = py::make_tuple(Variant::get_type_name(method.result.type), method.result.class_name);
		facts["defaults"] = defaults;
		facts["static"] = method.is_static;
		facts["virtual"] = method.is_virtual;
		facts["vararg"] = method.is_vararg;
		facts["accessor"] = method.is_accessor;
		facts["doc"] = method.documentation;
		methods.append(py::make_tuple(method.name, steal(make_method(method, info)), facts));
	}
	for (const SignalInfo &signal : info.signals) {
		signals.append(py::make_tuple(signal.name, argument_list(signal.arguments), signal.documentation));
	}
	for (const ConstantInfo &constant : info.constants) {
		constants.append(py::make_tuple(constant.name, constant.value, constant.enum_name, constant.documentation));
	}
	py::dict members;
	members["name"] = info.name;
	members["parent"] = info.parent;
	members["doc"] = info.documentation;
	members["properties"] = properties;
	members["methods"] = methods;
	members["signals"] = signals;
	members["constants"] = constants;
	members["instantiable"] = info.instantiable;
	return members;
}

void set_enum(const py::handle &p_property, const py::dict &p_members) {
	if (Py_TYPE(p_property.ptr()) == property_type) {
		reinterpret_cast<Property *>(p_property.ptr())->enum_members = p_members.inc_ref().ptr();
	}
}

py::object attach(const py::handle &p_node, const py::type &p_class) {
	return turn([&]() -> PyObject * {
		scene::Node &node = object_of<scene::Node>(p_node, "a Node");
		PyTypeObject *type = reinterpret_cast<PyTypeObject *>(p_class.ptr());
		const ClassInfo *info = PyType_IsSubtype(type, handle_type) ? class_of(type) : nullptr;
		if (!info || is_registered(type) || !node.is_class(info->name)) {
			PyErr_SetString(PyExc_TypeError,
					fmt::format("'{}' is a {}: expected a Python subclass of that or of a base", node.get_name(),
							node.get_class())
							.c_str());
			return nullptr;
		}
		PyObject *half = rewrap(node, type);
		PyObject *arguments = half ? PyTuple_New(0) : nullptr;
		if (!arguments || type->tp_init(half, arguments, nullptr) < 0) {
			Py_XDECREF(arguments);
			Py_XDECREF(half);
			return nullptr;
		}
		Py_DECREF(arguments);
		ScriptInstance *script = node.get_script_instance();
		for (const ScriptCallback callback : { ScriptCallback::ENTER_TREE, ScriptCallback::READY }) {
			const bool due = callback == ScriptCallback::READY ? node.is_node_ready() : node.is_inside_tree();
			if (due && script == node.get_script_instance() && script->has_callback(callback)) {
				script->callback(callback, 0.0);
			}
		}
		return half;
	});
}

void define_scene(py::module_ &r_module) {
	r_module.def("class_names", &ClassDB::get_class_list);
	r_module.def("class_members", &class_members);
	r_module.def("set_enum", &set_enum);
	r_module.def("register", [](const py::object &p_type, const std::string &p_class) {
		if (!register_type(p_type.ptr(), p_class.c_str())) {
			throw py::error_already_set();
		}
	});
	r_module.def("set_value_types", [](const py::dict &p_types) {
		if (!set_value_types(p_types.ptr())) {
			throw py::error_already_set();
		}
	});
	r_module.def("attach", &attach);
	r_module.def("suggestion", [](const std::string &p_word, const std::vector<std::string> &p_names) {
		return suggestion(p_word, p_names);
	});
	r_module.def("object_count", &ObjectDB::get_object_count);
	r_module.def("load", [](const std::string &p_path) {
		return turn([&]() -> PyObject * {
			const Result<Ref<Resource>> resource = scene::ResourceLoader::load(p_path);
			return resource ? wrap(resource.value())
							: (PyErr_SetString(load_error, resource.error().message.c_str()), nullptr);
		});
	});
	r_module.def("open_scene", [](const py::handle &p_tree, const std::string &p_path) {
		return turn([&] { return open_scene(object_of<scene::SceneTree>(p_tree, "a SceneTree"), p_path); });
	});
	r_module.def("close", [](const py::handle &p_tree) {
		return turn([&]() -> PyObject * {
			const Handle *handle = is_handle(p_tree.ptr()) ? reinterpret_cast<Handle *>(p_tree.ptr()) : nullptr;
			if (std::unique_ptr<Object> tree = handle ? ScriptOwned::take(handle->id) : nullptr) {
				close_tree(std::move(tree));
			}
			Py_RETURN_NONE;
		});
	});
	r_module.def("close_all", &close_all);
	r_module.def("note_fork", &note_fork);
}

void define_pictures(py::module_ &r_module) {
	r_module.def("render",
			[](const py::handle &p_tree, uint32_t p_width, uint32_t p_height, const py::object &p_camera,
					uint32_t p_frames, const std::vector<std::string> &p_aovs, double p_delta,
					const std::string &p_device, bool p_srgb) {
				return turn([&]() -> PyObject * {
					RenderRequest request = { p_width, p_height, p_frames, p_delta, p_srgb, {}, p_device, p_aovs };
					if (!p_camera.is_none()) {
						request.camera = object_of<scene::Node>(p_camera, "a Camera3D").get_instance_id();
					}
					return render(object_of<scene::SceneTree>(p_tree, "a SceneTree"), request);
				});
			});
	r_module.def("reference",
			[](const py::handle &p_tree, uint32_t p_width, uint32_t p_height, const py::object &p_camera,
					uint32_t p_spp, uint32_t p_seed, const std::vector<std::string> &p_aovs) {
				return turn([&]() -> PyObject * {
					ReferenceRequest request = { p_width, p_height, p_spp, p_seed, {}, p_aovs };
					if (!p_camera.is_none()) {
						request.camera = object_of<scene::Node>(p_camera, "a Camera3D").get_instance_id();
					}
					return reference(object_of<scene::SceneTree>(p_tree, "a SceneTree"), request);
				});
			});
	r_module.def("devices", [] {
		const Result<std::vector<DeviceInfo>> devices = list_vulkan_devices();
		if (!devices) {
			PyErr_SetString(device_error, devices.error().message.c_str());
			throw py::error_already_set();
		}
		py::list names;
		for (const DeviceInfo &info : devices.value()) {
			names.append(info.name);
		}
		return names;
	});
	define_arrays(r_module);
}

void add_errors(py::module_ &r_module) {
	const auto add = [&](const char *p_name, PyObject *p_bases, PyObject **r_type, const char *p_doc) {
		*r_type = PyErr_NewExceptionWithDoc((std::string("lucent.") + p_name).c_str(), p_doc, p_bases, nullptr);
		r_module.add_object(p_name, py::handle(*r_type).inc_ref());
	};
	add("Error", PyExc_RuntimeError, &error_type, "What the renderer or a scene can't do.");
	const auto with = [](PyObject *p_other) {
		return py::make_tuple(py::handle(error_type), py::handle(p_other)).release().ptr();
	};
	add("LoadError", error_type, &load_error,
			"A file can't be read. The text begins with the path, and the line where known.");
	add("DeviceError", error_type, &device_error, "There is no usable Vulkan device.");
	add("FreedObjectError", with(PyExc_ReferenceError), &freed_error, "The object is gone.");
	add("NodeNotFoundError", with(PyExc_LookupError), &node_not_found_error, "There is no node at that path.");
}

} // namespace

PYBIND11_MODULE(_lucent, r_module) {
	register_modules();
	add_errors(r_module);
	if (!make_object_types(r_module.ptr()) || !make_member_types(r_module.ptr())) {
		throw py::error_already_set();
	}
	take_messages();
	define_scene(r_module);
	define_pictures(r_module);
	r_module.attr("version") = LUCENT_VERSION;
}

} // namespace lucent::python
