// SPDX-License-Identifier: MIT
#pragma once
// Object: registered class, properties, methods, signals, notifications, a weak id. Resource: an Object that Refs share.
// One calling thread.

#include "servers/core/error.h"
#include "servers/core/object_id.h"
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

	// Signals must be registered. p_target: the connection ends with that object; default: it ends with this one.
	ConnectionID connect(const std::string &p_signal, SignalHandler p_handler, const Object *p_target = nullptr);
	void disconnect(ConnectionID p_connection);
	void emit_signal(const std::string &p_signal, const Array &p_arguments = {});

	void notification(int p_what) { _notification(p_what); }

	// Properties whose names depend on the object: "surface_material_override/0". False: not one of mine.
	virtual bool _set(const std::string &, const Variant &) { return false; }
	virtual bool _get(const std::string &, Variant &) const { return false; }
	virtual void _get_property_list(std::vector<PropertyInfo> &) const {}

protected:
	// An override calls its base's first, so bases hear first.
	virtual void _notification(int) {}

private:
	struct Connection {
		ConnectionID id = 0;
		SignalHandler handler;
		ObjectID target;
	};
	ObjectID instance_id;
	std::map<std::string, std::vector<Connection>> connections;
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
