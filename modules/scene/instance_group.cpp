// SPDX-License-Identifier: MIT
#include "modules/scene/instance_group.h"

#include "modules/scene/scene_tree.h"
#include "modules/scene/viewport.h"

namespace lucent::scene {

void InstanceGroup::enter(const Node3D &p_node, std::vector<PlacedMesh> p_meshes, const InstanceLook &p_look) {
	leave();
	meshes = std::move(p_meshes);
	context = p_node.is_inside_tree() && is_in_tree_world(p_node) ? p_node.get_tree()->get_context() : nullptr;
	if (!context) {
		return;
	}
	RenderingServer &server = context->server();
	for (const PlacedMesh &placed : meshes) {
		const InstanceRid instance = server.instance_create();
		instances.push_back(instance);
		server.instance_set_transform(instance, p_node.get_global_transform() * placed.transform);
		server.instance_set_visible(instance, p_node.is_visible_in_tree());
		server.instance_set_layer_mask(instance, p_look.layers);
		server.instance_geometry_set_material_override(instance, p_look.material_override);
		server.instance_geometry_set_cast_shadows_setting(instance, placed.cast_shadow.value_or(p_look.cast_shadow));
		server.instance_geometry_set_gi_mode(instance, p_look.gi_mode);
		server.instance_geometry_set_transparency(instance, p_look.transparency);
		server.instance_set_base(instance, placed.mesh->get_rid(*context));
		server.instance_set_scenario(instance, p_node.get_tree()->get_scenario());
	}
}

void InstanceGroup::leave() {
	if (context) {
		for (const InstanceRid instance : instances) {
			context->server().free(instance);
		}
	}
	instances.clear();
	context = nullptr;
}

void InstanceGroup::set_transform(const Transform3D &p_transform) {
	for (size_t i = 0; i < instances.size(); i++) {
		context->server().instance_set_transform(instances[i], p_transform * meshes[i].transform);
	}
}

void InstanceGroup::set_visible(bool p_visible) {
	for (const InstanceRid instance : instances) {
		context->server().instance_set_visible(instance, p_visible);
	}
}

} // namespace lucent::scene
