// SPDX-License-Identifier: MIT
#include "servers/core/script_instance.h"

#include "servers/core/object.h"

#include <unordered_map>

namespace lucent {

namespace {

struct Owned {
	std::unordered_map<uint64_t, std::unique_ptr<Object>> objects;
	std::vector<std::unique_ptr<Object>> doomed;
	uint32_t depth = 0;
};

// Never destroyed: see ObjectDB.
Owned &owned() {
	static Owned *instance = new Owned;
	return *instance;
}

} // namespace

void ScriptOwned::adopt(std::unique_ptr<Object> p_object) {
	if (!p_object) {
		return;
	}
	Object *object = p_object.get();
	owned().objects[object->get_instance_id().value] = std::move(p_object);
	if (ScriptInstance *script = object->get_script_instance()) {
		script->owned_by_script(true);
	}
}

std::unique_ptr<Object> ScriptOwned::take(ObjectID p_id) {
	const auto found = owned().objects.find(p_id.value);
	if (found == owned().objects.end()) {
		return nullptr;
	}
	std::unique_ptr<Object> object = std::move(found->second);
	owned().objects.erase(found);
	if (ScriptInstance *script = object->get_script_instance()) {
		script->owned_by_script(false);
	}
	return object;
}

bool ScriptOwned::contains(ObjectID p_id) {
	return owned().objects.contains(p_id.value);
}

void ScriptOwned::destroy(std::unique_ptr<Object> p_object) {
	if (p_object && owned().depth > 0) {
		owned().doomed.push_back(std::move(p_object));
	}
}

uint32_t ScriptOwned::size() {
	return uint32_t(owned().objects.size());
}

ScriptCallScope::ScriptCallScope() {
	owned().depth++;
}

ScriptCallScope::~ScriptCallScope() {
	// Ends may doom others.
	while (owned().depth == 1 && !owned().doomed.empty()) {
		const std::unique_ptr<Object> object = std::move(owned().doomed.back());
		owned().doomed.pop_back();
	}
	owned().depth--;
}

} // namespace lucent
