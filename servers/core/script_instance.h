// SPDX-License-Identifier: MIT
#pragma once
// What a scripting language hangs onto an Object: its own methods, and the callbacks that a class calls by name.

#include "servers/core/error.h"
#include "servers/core/variant.h"

#include <memory>
#include <string>

namespace lucent {

// The methods that C++ calls on scripts, in ClassDB as virtual methods of those names.
enum class ScriptCallback : uint8_t {
	ENTER_TREE, // _enter_tree()
	EXIT_TREE, // _exit_tree()
	READY, // _ready()
	PROCESS, // _process(delta)
	NOTIFICATION, // _notification(what)
};

class ScriptInstance {
public:
	virtual ~ScriptInstance() = default;

	virtual bool has_callback(ScriptCallback p_callback) const = 0;
	// p_argument: delta in seconds, or the notification; unused by the others. Errors are the language's to keep: none passes through C++.
	virtual void callback(ScriptCallback p_callback, double p_argument) = 0;
	virtual bool has_method(const std::string &p_method) const = 0;
	virtual Result<Variant> call(const std::string &p_method, const std::vector<Variant> &p_arguments) = 0;
	// True: no parent owns the object any more, scripts do (ScriptOwned), so that it ends with the script's last reference.
	virtual void owned_by_script(bool p_owned) = 0;
	// The same script for a copy of the object.
	virtual void copy_to(Object &r_copy) const = 0;
};

// Objects that nothing in C++ owns: made by a script, or taken from their parent by one.
class ScriptOwned {
public:
	static void adopt(std::unique_ptr<Object> p_object);
	static std::unique_ptr<Object> take(ObjectID p_id); // null: C++ owns it, or it is gone
	static bool contains(ObjectID p_id);
	// Ends it: at once, or while a script's call is under way when that ends, as the object may be in the middle of a method.
	static void destroy(std::unique_ptr<Object> p_object);
	static uint32_t size();
};

// While one lives, ScriptOwned::destroy() waits.
class ScriptCallScope {
public:
	ScriptCallScope();
	~ScriptCallScope();
	ScriptCallScope(const ScriptCallScope &) = delete;
	ScriptCallScope &operator=(const ScriptCallScope &) = delete;
};

} // namespace lucent
