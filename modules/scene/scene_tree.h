// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/node.h"
#include "modules/scene/scene_context.h"

namespace lucent::scene {

class Camera3D;
class GeometryInstance3D;
class Node3D;
class WorldEnvironment;

// The running scene: a root node and the server's scenario that its nodes appear in.
class SceneTree : public Object {
	LUCENT_CLASS(SceneTree, Object)
public:
	// Null: nodes without pictures. The server must outlive the tree. The tree makes a scenario of its own, and frees it.
	explicit SceneTree(RenderingServer *p_server = nullptr);
	~SceneTree() override;

	Node *get_root() const { return root.get(); } // "root"; never null
	// Replaces the scene below the root; null leaves none.
	void set_current_scene(std::unique_ptr<Node> p_scene);
	Node *get_current_scene() const;
	// The same for a scene from a script's hands (ScriptOwned); null: an error, and nothing changes.
	bool set_current_scene_node(Node *p_scene);
	Status change_scene_to_file(const std::string &p_path);
	Status change_scene_to_packed(const Ref<Resource> &p_scene);
	Status reload_current_scene();
	void set_pause(bool p_paused) { paused = p_paused; } // see Node::ProcessMode
	bool is_paused() const { return paused; }

	// A frame: process notifications, deletions, then flush().
	void process(double p_delta_seconds);
	// Sends to the server what changed since the last time: transforms, then resources. process() does it; call it alone before
	// drawing a scene that does not run.
	void flush();
	double get_process_time() const { return process_time; }
	uint64_t get_frame() const { return frame; }

	std::vector<Node *> get_nodes_in_group(const std::string &p_group) const; // tree order
	// Nodes that have no such method are left out.
	void call_group(const std::string &p_group, const std::string &p_method, const Array &p_arguments = {});
	Status set_group(const std::string &p_group, const std::string &p_property, const Variant &p_value);
	void notify_group(const std::string &p_group, int p_what);
	int get_node_count() const { return node_count; }
	void queue_delete(Node *p_node) { deletions.push_back(p_node->get_instance_id()); }

	SceneContext *get_context() const { return context.get(); } // null: no server
	ScenarioRid get_scenario() const { return scenario; }

	// The camera that a viewport should show; null: there is none.
	Camera3D *get_camera_3d() const;
	// After nodes came into the scenario or left it by another way than entering and leaving the tree.
	void world_changed() { update_environment(); }
	// The first that entered and has an environment acts, as in Godot.
	WorldEnvironment *get_world_environment() const;

private:
	friend class Node;
	friend class Node3D;
	friend class Camera3D;
	friend class WorldEnvironment;
	friend class GeometryInstance3D;
	void node_entered(Node *p_node);
	void node_left(Node *p_node);
	void queue_transform(ObjectID p_node) { moved.push_back(p_node); }
	void camera_entered(Camera3D *p_camera);
	void camera_left(Camera3D *p_camera);
	void set_camera(Camera3D *p_camera);
	void environment_entered(WorldEnvironment *p_node);
	void environment_left(WorldEnvironment *p_node);
	void update_environment();
	void visibility_range_entered(GeometryInstance3D *p_node) { ranged.push_back(p_node); }
	void visibility_range_left(GeometryInstance3D *p_node) { std::erase(ranged, p_node); }
	void update_visibility_ranges();

	std::unique_ptr<SceneContext> context;
	ScenarioRid scenario;
	std::vector<ObjectID> moved; // Node3Ds to notify
	std::vector<ObjectID> deletions;
	std::vector<Camera3D *> cameras; // in the tree, in order of entry
	Camera3D *current_camera = nullptr;
	std::vector<WorldEnvironment *> world_environments;
	std::vector<GeometryInstance3D *> ranged; // with a visibility range
	ObjectID current_scene;
	int node_count = 0;
	bool paused = false;
	double process_time = 0.0;
	uint64_t frame = 0;
	std::unique_ptr<Node> root;
};

} // namespace lucent::scene
