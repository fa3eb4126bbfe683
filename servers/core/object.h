// SPDX-License-Identifier: MIT
#pragma once
// Object: registered class, properties, methods, signals, notifications, a weak id. Resource: an Object that Refs share.
// One calling thread.

#include "servers/core/error.h"
#include "servers/core/object_id.h"
#include "servers/core/script_instance.h"
#include "servers/core/variant.h"
#include "servers/core/variant_cast.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace lucent {

class Object;
template <typename T>
class ClassBuilder;
struct PropertyInfo;

// Every live Object by id.
class ObjectDB {
public:
	static Object *get(ObjectID p_id); // null: gone, or never was
	static uint32_t get_object_count();

private:
	friend class Object;
	static ObjectID add(Object *p_object);
	static void remove(ObjectID p_id);
};

// First line of every class below Object. bind() tells the registry its members: see class_builder.h.
#define LUCENT_CLASS(m_class, m_parent) \
public: \
	using Super = m_parent; \
	static const char *get_class_static() { \
		return #m_class; \
	} \
	const char *get_class() const override { \
		return #m_class; \
	} \
	static void bind(::lucent::ClassBuilder<m_class> &r_class); \
\
private:

using SignalHandler = std::function<void(const Array &p_arguments)>;
using ConnectionID = uint64_t;

class Object {
public:
	using Super = void;

	enum {
		NOTIFICATION_POSTINITIALIZE = 0,
		NOTIFICATION_PREDELETE = 1
	};

	Object() :
			instance_id(ObjectDB::add(this)) {}
	virtual ~Object() { ObjectDB::remove(instance_id); }
	Object(const Object &) = delete;
	Object &operator=(const Object &) = delete;

	static const char *get_class_static() { return "Object"; }
	static void bind(ClassBuilder<Object> &r_class);
	virtual const char *get_class() const { return "Object"; }
	bool is_class(const std::string &p_class) const; // this class or a base
	ObjectID get_instance_id() const { return instance_id; }

	// Registered properties first, then the class's own dynamic ones. Wrong type, out of a hard range or unknown: an error, nothing set.
	Status set_property(const std::string &p_name, const Variant &p_value);
	bool set(const std::string &p_name, const Variant &p_value) { return set_property(p_name, p_value).ok(); }
	// NIL and *r_valid false: no such property.
	Variant get(const std::string &p_name, bool *r_valid = nullptr) const;
	bool has_property(const std::string &p_name) const;

	Result<Variant> call(const std::string &p_method, const Array &p_arguments = {});

	// Registered, or the script's.
	bool has_method(const std::string &p_method) const;

	// By path: "position:x", "environment:sky:sky_material".
	Status set_indexed(const NodePath &p_path, const Variant &p_value);
	Result<Variant> get_indexed(const NodePath &p_path) const;

	// Signals must be registered. p_target: the connection ends with that object; default: it ends with this one.
	ConnectionID connect(const std::string &p_signal, SignalHandler p_handler, const Object *p_target = nullptr);
	void disconnect(ConnectionID p_connection);
	void emit_signal(const std::string &p_signal, const Array &p_arguments = {});
	// The same for receivers that can be compared; one receiver has at most one connection to a signal.
	enum ConnectFlags : uint32_t {
		CONNECT_ONE_SHOT = 4,
	};
	Status connect_callable(const std::string &p_signal, const Callable &p_callable, uint32_t p_flags = 0);
	Status disconnect_callable(const std::string &p_signal, const Callable &p_callable);
	bool is_connected(const std::string &p_signal, const Callable &p_callable) const;
	bool has_connections(const std::string &p_signal) const;
	// Every receiver that came by connect_callable.
	void visit_callables(const std::function<void(const Callable &)> &p_visit) const;
	void set_block_signals(bool p_blocked) { signals_blocked = p_blocked; }
	bool is_blocking_signals() const { return signals_blocked; }

	// Facts that people hang onto an object; the program knows none.
	void set_meta(const std::string &p_name, const Variant &p_value);
	Variant get_meta(const std::string &p_name, const Variant &p_default = {}) const;
	bool has_meta(const std::string &p_name) const { return metadata.contains(p_name); }
	void remove_meta(const std::string &p_name) { metadata.erase(p_name); }

	// The classes hear first, then the script.
	void notification(int p_what) {
		_notification(p_what);
		if (script_instance) {
			notify_script(p_what);
		}
	}

	// Replaces the one that was there.
	void set_script_instance(std::unique_ptr<ScriptInstance> p_script) { script_instance = std::move(p_script); }
	ScriptInstance *get_script_instance() const { return script_instance.get(); }

	// Ends the object, out of its parent's hands. Resources are shared: an error.
	Status free();

	// Properties whose names depend on the object: "surface_material_override/0". False: not one of mine.
	virtual bool _set(const std::string &, const Variant &) { return false; }
	virtual bool _get(const std::string &, Variant &) const { return false; }
	virtual void _get_property_list(std::vector<PropertyInfo> &) const {}

protected:
	// An override calls its base's first, so bases hear first.
	virtual void _notification(int) {}
	// Which of the script's callbacks a notification means, beside ScriptCallback::NOTIFICATION.
	virtual void notify_script(int p_what);
	// Takes the object from who owns it; null: that can't be.
	virtual std::unique_ptr<Object> release_from_owner() { return ScriptOwned::take(instance_id); }

private:
	struct Connection {
		ConnectionID id = 0;
		SignalHandler handler;
		ObjectID target;
		Callable callable; // null: a handler of C++
		uint32_t flags = 0;
	};
	ObjectID instance_id;
	bool signals_blocked = false;
	std::unique_ptr<ScriptInstance> script_instance;
	std::map<std::string, std::vector<Connection>> connections;
	std::map<std::string, Variant> metadata;
};

// Shared data: meshes, materials, textures, environments. Make with std::make_shared or ClassDB::instantiate_resource.
class Resource : public Object, public std::enable_shared_from_this<Resource> {
	LUCENT_CLASS(Resource, Object)
public:
	const std::string &get_name() const { return name; }
	void set_name(const std::string &p_name) { name = p_name; }
	const std::string &get_path() const { return path; }
	void set_path(const std::string &p_path) { path = p_path; }

	// Says that something in it is no longer as it was: signal "changed".
	void emit_changed() { emit_signal("changed"); }

private:
	std::string name;
	std::string path;
};

} // namespace lucent
