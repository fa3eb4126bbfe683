// SPDX-License-Identifier: MIT
#pragma once
// Scene classes live in lucent::scene: scene::Material is the resource that people edit, lucent::Material the plain data that it
// sends to the server.

#include "servers/core/object.h"
#include "servers/rendering/rendering_server.h"

#include <vector>

namespace lucent::scene {

class ServerResource;

// Ties a tree's resources to one RenderingServer. Resources make their server objects when a node first needs them, and send
// changes once a frame, in flush(). A resource belongs to one context at a time; when the context ends, its server objects go.
class SceneContext {
public:
	explicit SceneContext(RenderingServer &p_server) :
			rendering_server(p_server) {}
	~SceneContext();
	SceneContext(const SceneContext &) = delete;
	SceneContext &operator=(const SceneContext &) = delete;

	RenderingServer &server() { return rendering_server; }
	// Sends every resource that changed since the last flush, once.
	void flush();

private:
	friend class ServerResource;
	RenderingServer &rendering_server;
	std::vector<ServerResource *> attached;
	std::vector<ObjectID> queue;
};

// A resource with an object on the server.
class ServerResource : public Resource {
public:
	~ServerResource() override;

	// After an edit: the server hears at the next flush, users of the resource now.
	void state_changed();

protected:
	// Puts the resource into the context and sends it, unless that is done. False: it lives in another context (an error is printed).
	bool attach(SceneContext &p_context);
	void leave_context();
	SceneContext *get_context() const { return context; }
	// Sends everything, making server objects as needed. Called at most once a flush.
	virtual void send(SceneContext &p_context) = 0;
	// Asked at each flush: whether what was sent depends on something else that changed.
	virtual bool is_stale(SceneContext &) const { return false; }
	// Frees the server objects. The context is still there.
	virtual void free_server_objects(RenderingServer &p_server) = 0;

private:
	friend class SceneContext;
	SceneContext *context = nullptr;
	bool queued = false;
};

} // namespace lucent::scene
