// SPDX-License-Identifier: MIT
#pragma once
// Many meshes that one node shows: each is an instance of the server's.

#include "modules/scene/mesh.h"
#include "modules/scene/node_3d.h"

#include <optional>
#include <vector>

namespace lucent::scene {

struct PlacedMesh {
	Transform3D transform; // to the node
	Ref<Mesh> mesh;
	std::optional<ShadowCasting> cast_shadow = {}; // its own; else the node's
};

struct InstanceLook {
	MaterialRid material_override;
	ShadowCasting cast_shadow = ShadowCasting::ON;
	GiMode gi_mode = GiMode::STATIC;
	float transparency = 0.0f;
	uint32_t layers = 1;
};

// Lives between its node's ENTER_WORLD and EXIT_WORLD.
class InstanceGroup {
public:
	~InstanceGroup() { leave(); }
	// p_node is in a tree, in the world of the tree's viewport and with a server; else nothing happens.
	void enter(const Node3D &p_node, std::vector<PlacedMesh> p_meshes, const InstanceLook &p_look);
	void leave();
	bool is_entered() const { return context != nullptr; }
	void set_transform(const Transform3D &p_transform);
	void set_visible(bool p_visible);
	size_t size() const { return instances.size(); }

private:
	SceneContext *context = nullptr;
	std::vector<PlacedMesh> meshes; // hold what the instances show
	std::vector<InstanceRid> instances;
};

} // namespace lucent::scene
