// SPDX-License-Identifier: MIT
#pragma once
// Private to rendering_server*.cpp: the scene's edits and what they make dirty.

#include "servers/rendering/frame_renderer.h"
#include "servers/rendering/rendering_server.h"

namespace lucent {

struct RenderingServer::Impl {
	RenderingDevice *device = nullptr;
	std::unique_ptr<FrameRenderer> frame_renderer; // null without a device
	RenderScene scene;
	std::vector<InstanceRid> moved; // since the last drawn frame

	uint64_t next_version() { return ++scene.version; }

	// World box of what an instance shows or lights; empty: nothing.
	AABB instance_box(const Instance &p_instance) const;
	bool is_light(const Instance &p_instance) const { return p_instance.light.is_valid(); }
	void mark_dirty(ScenarioRid p_scenario, const AABB &p_box, bool p_geometry);
	// Marks the boxes before and after p_edit as one.
	template <typename F>
	void edit_instance(InstanceRid p_rid, Instance &r_instance, F &&p_edit);
	template <typename F>
	void edit_environment(EnvironmentRid p_rid, F &&p_edit); // rendering_server_environment.cpp
	// Call these after the edit, with what was there before.
	void mark_mesh_users(MeshRid p_mesh, const AABB &p_old_local);
	void mark_light_users(LightRid p_light, const Light &p_old);
	void mark_material_users(MaterialRid p_material);
	void mark_sky_users(SkyRid p_sky);
	void mark_environment_users(EnvironmentRid p_environment);
};

AABB light_box(const Light &p_light, const Transform3D &p_transform);

template <typename F>
void RenderingServer::Impl::edit_instance(InstanceRid p_rid, Instance &r_instance, F &&p_edit) {
	const AABB old_box = r_instance.visible ? instance_box(r_instance) : AABB();
	const ScenarioRid old_scenario = r_instance.scenario;
	const bool was_light = is_light(r_instance);
	p_edit(r_instance);
	if (!r_instance.drawn) {
		r_instance.previous_transform = r_instance.transform;
	}
	r_instance.version = next_version();
	AABB new_box = r_instance.visible ? instance_box(r_instance) : AABB();
	if (old_scenario == r_instance.scenario && was_light == is_light(r_instance)) {
		new_box.merge_with(old_box);
	} else {
		mark_dirty(old_scenario, old_box, !was_light);
	}
	mark_dirty(r_instance.scenario, new_box, !is_light(r_instance));
	moved.push_back(p_rid);
}

} // namespace lucent
