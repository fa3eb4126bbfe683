// SPDX-License-Identifier: MIT
#include "servers/core/object.h"

#include "servers/core/class_builder.h"
#include "servers/core/class_db.h"
#include "servers/core/rid.h"

#include <algorithm>

namespace lucent {

using ObjectOwner = RidOwner<Object *, Object>;

// Never destroyed: static Resources may outlive any other static.
static ObjectOwner &objects() {
	static ObjectOwner *owner = new ObjectOwner;
	return *owner;
}

ObjectID ObjectDB::add(Object *p_object) {
	const Rid<Object> rid = objects().make(p_object);
	return { (uint64_t(rid.generation) << 32 | rid.index) + 1 };
}

static Rid<Object> rid_of(ObjectID p_id) {
	const uint64_t value = p_id.value - 1;
	return { uint32_t(value), uint32_t(value >> 32) };
}

void ObjectDB::remove(ObjectID p_id) {
	objects().free(rid_of(p_id));
}

Object *ObjectDB::get(ObjectID p_id) {
	Object **object = p_id.is_valid() ? objects().get(rid_of(p_id)) : nullptr;
	return object ? *object : nullptr;
}

uint32_t ObjectDB::get_object_count() {
	return objects().size();
}

bool Object::is_class(const std::string &p_class) const {
	return ClassDB::is_parent_class(get_class(), p_class);
}

Status Object::set_property(const std::string &p_name, const Variant &p_value) {
	if (const PropertyInfo *property = ClassDB::get_property(get_class(), p_name)) {
		return property->checked_set(*this, p_value);
	}
	if (_set(p_name, p_value)) {
		return Ok();
	}
	Variant present;
	if (_get(p_name, present)) {
		return make_error("{}.{} cannot be {}", get_class(), p_name, p_value.to_string());
	}
	return make_error("{} has no property '{}'", get_class(), p_name);
}

Variant Object::get(const std::string &p_name, bool *r_valid) const {
	Variant value;
	bool valid = true;
	if (const PropertyInfo *property = ClassDB::get_property(get_class(), p_name)) {
		value = property->get(*this);
	} else {
		valid = _get(p_name, value);
	}
	if (r_valid) {
		*r_valid = valid;
	}
	return value;
}

bool Object::has_property(const std::string &p_name) const {
	bool valid = false;
	get(p_name, &valid);
	return valid;
}

Result<Variant> Object::call(const std::string &p_method, const Array &p_arguments) {
	if (script_instance && script_instance->has_method(p_method)) {
		return script_instance->call(p_method, p_arguments);
	}
	const MethodInfo *method = ClassDB::get_method(get_class(), p_method);
	if (!method || method->is_virtual) {
		return make_error("{} has no method '{}'", get_class(), p_method);
	}
	return method->checked_call(get_class(), this, p_arguments);
}

bool Object::has_method(const std::string &p_method) const {
	const MethodInfo *method = ClassDB::get_method(get_class(), p_method);
	return (method && !method->is_virtual) || (script_instance && script_instance->has_method(p_method));
}

ConnectionID Object::connect(const std::string &p_signal, SignalHandler p_handler, const Object *p_target) {
	ERR_FAIL_COND_V_MSG(!ClassDB::has_signal(get_class(), p_signal), 0, "{} has no signal '{}'", get_class(), p_signal);
	static ConnectionID last_id = 0;
	connections[p_signal].push_back({ ++last_id, std::move(p_handler), (p_target ? p_target : this)->get_instance_id() });
	return last_id;
}

Status Object::connect_callable(const std::string &p_signal, const Callable &p_callable, uint32_t p_flags) {
	if (!ClassDB::has_signal(get_class(), p_signal)) {
		return make_error("{} has no signal '{}'", get_class(), p_signal);
	}
	if (!p_callable.target) {
		return make_error("{}.{}: null can't receive a signal", get_class(), p_signal);
	}
	if (is_connected(p_signal, p_callable)) {
		return make_error("{}.{} is already connected to that receiver", get_class(), p_signal);
	}
	const ObjectID receiver = p_callable.target->get_object();
	const auto handler = [target = p_callable.target](const Array &p_arguments) { target->call(p_arguments); };
	connect(p_signal, handler, receiver.is_valid() ? ObjectDB::get(receiver) : nullptr);
	connections[p_signal].back().callable = p_callable;
	connections[p_signal].back().flags = p_flags;
	return Ok();
}

Status Object::disconnect_callable(const std::string &p_signal, const Callable &p_callable) {
	const auto found = connections.find(p_signal);
	const auto is_it = [&](const Connection &p_entry) {
		return p_entry.callable.target && p_entry.callable == p_callable;
	};
	const size_t erased = found == connections.end() ? 0 : std::erase_if(found->second, is_it);
	if (erased == 0) {
		return make_error("{}.{} is not connected to that receiver", get_class(), p_signal);
	}
	return Ok();
}

bool Object::is_connected(const std::string &p_signal, const Callable &p_callable) const {
	const auto found = connections.find(p_signal);
	const auto is_it = [&](const Connection &p_entry) {
		return p_entry.callable.target && p_entry.callable == p_callable && ObjectDB::get(p_entry.target);
	};
	return found != connections.end() && std::any_of(found->second.begin(), found->second.end(), is_it);
}

bool Object::has_connections(const std::string &p_signal) const {
	const auto found = connections.find(p_signal);
	const auto lives = [](const Connection &p_entry) { return ObjectDB::get(p_entry.target) != nullptr; };
	return found != connections.end() && std::any_of(found->second.begin(), found->second.end(), lives);
}

void Object::visit_callables(const std::function<void(const Callable &)> &p_visit) const {
	for (const auto &[signal, list] : connections) {
		for (const Connection &entry : list) {
			if (entry.callable.target) {
				p_visit(entry.callable);
			}
		}
	}
}

void Object::set_meta(const std::string &p_name, const Variant &p_value) {
	if (p_value.is_nil()) {
		metadata.erase(p_name); // as in Godot
	} else {
		metadata[p_name] = p_value;
	}
}

Variant Object::get_meta(const std::string &p_name, const Variant &p_default) const {
	const auto found = metadata.find(p_name);
	return found == metadata.end() ? p_default : found->second;
}

void Object::notify_script(int p_what) {
	if (script_instance->has_callback(ScriptCallback::NOTIFICATION)) {
		script_instance->callback(ScriptCallback::NOTIFICATION, p_what);
	}
}

Status Object::free() {
	std::unique_ptr<Object> owned = release_from_owner();
	if (!owned) {
		return make_error("{} can't be freed: others own it", get_class());
	}
	ScriptOwned::destroy(std::move(owned));
	return Ok();
}

void Object::disconnect(ConnectionID p_connection) {
	for (auto &[signal, list] : connections) {
		std::erase_if(list, [&](const Connection &p_entry) { return p_entry.id == p_connection; });
	}
}

void Object::emit_signal(const std::string &p_signal, const Array &p_arguments) {
	const auto found = connections.find(p_signal);
	if (found == connections.end() || signals_blocked) {
		return;
	}
	std::erase_if(found->second, [](const Connection &p_entry) { return !ObjectDB::get(p_entry.target); });
	// A copy: handlers may connect, disconnect, or delete this object.
	const std::vector<Connection> receivers = found->second;
	const ObjectID self = instance_id;
	for (const Connection &receiver : receivers) {
		if (!ObjectDB::get(self)) {
			return;
		}
		const auto &list = connections[p_signal];
		const bool still_connected = std::any_of(list.begin(), list.end(), [&](const Connection &p_entry) { return p_entry.id == receiver.id; });
		if (still_connected && ObjectDB::get(receiver.target)) {
			if (receiver.flags & CONNECT_ONE_SHOT) {
				disconnect(receiver.id);
			}
			receiver.handler(p_arguments);
		}
	}
}

void Resource::bind(ClassBuilder<Resource> &r_class) {
	r_class.doc("Data that nodes and other resources share: a mesh, a material, a texture, an environment.");
	r_class.property("resource_name", &Resource::set_name, &Resource::get_name).doc("A name to show to people; need not be unique.");
	r_class.property("resource_path", &Resource::set_path, &Resource::get_path).doc("The file that it was loaded from; empty for one built in memory.");
	r_class.method("emit_changed", &Resource::emit_changed).doc("Tells everyone who uses the resource that it changed.");
	r_class.signal("changed").doc("Something in the resource is no longer as it was.");
}

} // namespace lucent
