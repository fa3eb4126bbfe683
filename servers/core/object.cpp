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
	const MethodInfo *method = ClassDB::get_method(get_class(), p_method);
	if (!method) {
		return make_error("{} has no method '{}'", get_class(), p_method);
	}
	if (p_arguments.size() != method->arguments.size()) {
		return make_error("{}.{}() takes {} arguments, got {}", get_class(), p_method, method->arguments.size(), p_arguments.size());
	}
	return method->call(*this, p_arguments);
}

ConnectionID Object::connect(const std::string &p_signal, SignalHandler p_handler, const Object *p_target) {
	ERR_FAIL_COND_V_MSG(!ClassDB::has_signal(get_class(), p_signal), 0, "{} has no signal '{}'", get_class(), p_signal);
	static ConnectionID last_id = 0;
	connections[p_signal].push_back({ ++last_id, std::move(p_handler), (p_target ? p_target : this)->get_instance_id() });
	return last_id;
}

void Object::disconnect(ConnectionID p_connection) {
	for (auto &[signal, list] : connections) {
		std::erase_if(list, [&](const Connection &p_entry) { return p_entry.id == p_connection; });
	}
}

void Object::emit_signal(const std::string &p_signal, const Array &p_arguments) {
	const auto found = connections.find(p_signal);
	if (found == connections.end()) {
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
			receiver.handler(p_arguments);
		}
	}
}

void Object::bind(ClassBuilder<Object> &r_class) {
	r_class.doc("Base of everything that the registry knows: properties, methods, signals, notifications and a weak id.");
	r_class.method("get_class", &Object::get_class).doc("The class's registered name.");
	r_class.method("is_class", &Object::is_class, { "class" }).doc("Whether this object's class is the given one or inherits it.");
	r_class.method("notification", &Object::notification, { "what" }).doc("Sends a notification to this object alone.");
}

void Resource::bind(ClassBuilder<Resource> &r_class) {
	r_class.doc("Data that nodes and other resources share: a mesh, a material, a texture, an environment.");
	r_class.property("resource_name", &Resource::set_name, &Resource::get_name).doc("A name to show to people; need not be unique.");
	r_class.property("resource_path", &Resource::set_path, &Resource::get_path).doc("The file that it was loaded from; empty for one built in memory.");
	r_class.method("emit_changed", &Resource::emit_changed).doc("Tells everyone who uses the resource that it changed.");
	r_class.signal("changed").doc("Something in the resource is no longer as it was.");
}

} // namespace lucent
