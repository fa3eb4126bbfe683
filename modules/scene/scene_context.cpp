// SPDX-License-Identifier: MIT
#include "modules/scene/scene_context.h"

namespace lucent::scene {

SceneContext::~SceneContext() {
	while (!attached.empty()) {
		attached.back()->leave_context();
	}
}

void SceneContext::flush() {
	for (size_t i = 0; i < attached.size(); i++) { // sending one can attach others, and queue them
		if (attached[i]->is_stale(*this)) {
			attached[i]->send(*this);
		}
	}
	// Sending one resource can attach others, which send themselves at once and queue nothing.
	const std::vector<ObjectID> pending = std::move(queue);
	queue.clear();
	for (const ObjectID id : pending) {
		ServerResource *resource = dynamic_cast<ServerResource *>(ObjectDB::get(id));
		if (resource && resource->context == this && resource->queued) {
			resource->queued = false;
			resource->send(*this);
		}
	}
}

ServerResource::~ServerResource() {
	INVARIANT(!context, "a scene resource was destroyed without leave_context() in its destructor");
}

void ServerResource::state_changed() {
	if (context && !queued) {
		queued = true;
		context->queue.push_back(get_instance_id());
	}
	emit_changed();
}

bool ServerResource::attach(SceneContext &p_context) {
	if (context == &p_context) {
		return true;
	}
	ERR_FAIL_COND_V_MSG(context, false, "{} '{}' is in use by another scene tree", get_class(), get_name());
	context = &p_context;
	context->attached.push_back(this);
	send(p_context);
	return true;
}

void ServerResource::leave_context() {
	if (context) {
		free_server_objects(context->server());
		std::erase(context->attached, this);
		context = nullptr;
		queued = false;
	}
}

} // namespace lucent::scene
