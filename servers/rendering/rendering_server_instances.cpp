// SPDX-License-Identifier: MIT
#include "servers/rendering/rendering_server_impl.h"

namespace lucent {

ScenarioRid RenderingServer::scenario_create() {
	Scenario scenario;
	scenario.geometry_version = scenario.light_version = impl->next_version();
	return impl->scene.scenarios.make(std::move(scenario));
}

void RenderingServer::scenario_set_environment(ScenarioRid p_scenario, EnvironmentRid p_environment) {
	Scenario *scenario = impl->scene.scenarios.get(p_scenario);
	ERR_FAIL_COND_MSG(scenario == nullptr, "no such scenario");
	ERR_FAIL_COND_MSG(p_environment.is_valid() && impl->scene.environments.get(p_environment) == nullptr, "no such environment");
	scenario->environment = p_environment;
	scenario->light_version = impl->next_version();
}

void RenderingServer::scenario_set_fallback_environment(ScenarioRid p_scenario, EnvironmentRid p_environment) {
	Scenario *scenario = impl->scene.scenarios.get(p_scenario);
	ERR_FAIL_COND_MSG(scenario == nullptr, "no such scenario");
	ERR_FAIL_COND_MSG(p_environment.is_valid() && impl->scene.environments.get(p_environment) == nullptr, "no such environment");
	scenario->fallback_environment = p_environment;
	scenario->light_version = impl->next_version();
}

InstanceRid RenderingServer::instance_create() {
	Instance instance;
	instance.version = impl->next_version();
	return impl->scene.instances.make(std::move(instance));
}

void RenderingServer::instance_set_base(InstanceRid p_instance, MeshRid p_mesh) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	ERR_FAIL_COND_MSG(p_mesh.is_valid() && impl->scene.meshes.get(p_mesh) == nullptr, "no such mesh");
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) {
		r_instance.mesh = p_mesh;
		r_instance.light = LightRid();
	});
}

void RenderingServer::instance_set_base(InstanceRid p_instance, LightRid p_light) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	ERR_FAIL_COND_MSG(p_light.is_valid() && impl->scene.lights.get(p_light) == nullptr, "no such light");
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) {
		r_instance.light = p_light;
		r_instance.mesh = MeshRid();
	});
}

void RenderingServer::instance_set_scenario(InstanceRid p_instance, ScenarioRid p_scenario) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	ERR_FAIL_COND_MSG(p_scenario.is_valid() && impl->scene.scenarios.get(p_scenario) == nullptr, "no such scenario");
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) {
		r_instance.scenario = p_scenario;
		r_instance.drawn = false;
	});
}

void RenderingServer::instance_set_transform(InstanceRid p_instance, const Transform3D &p_transform) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	for (int i = 0; i < 3; i++) {
		const Vector3 &column = p_transform.basis[i];
		ERR_FAIL_COND_MSG(!std::isfinite(column.x + column.y + column.z + p_transform.origin[i]), "the transform is not finite");
	}
	if (instance->transform == p_transform) {
		return;
	}
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) { r_instance.transform = p_transform; });
}

void RenderingServer::instance_set_visible(InstanceRid p_instance, bool p_visible) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	if (instance->visible == p_visible) {
		return;
	}
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) { r_instance.visible = p_visible; });
}

void RenderingServer::instance_set_layer_mask(InstanceRid p_instance, uint32_t p_mask) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) { r_instance.layers = p_mask; });
}

void RenderingServer::instance_set_surface_override_material(InstanceRid p_instance, uint32_t p_surface, MaterialRid p_material) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	ERR_FAIL_COND_MSG(p_material.is_valid() && impl->scene.materials.get(p_material) == nullptr, "no such material");
	const Mesh *mesh = impl->scene.meshes.get(instance->mesh);
	ERR_FAIL_COND_MSG(mesh == nullptr || p_surface >= mesh->surfaces.size(), "the instance has no surface {}", p_surface);
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) {
		if (r_instance.surface_override_materials.size() <= p_surface) {
			r_instance.surface_override_materials.resize(p_surface + 1);
		}
		r_instance.surface_override_materials[p_surface] = p_material;
	});
}

void RenderingServer::instance_geometry_set_material_override(InstanceRid p_instance, MaterialRid p_material) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	ERR_FAIL_COND_MSG(p_material.is_valid() && impl->scene.materials.get(p_material) == nullptr, "no such material");
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) { r_instance.material_override = p_material; });
}

void RenderingServer::instance_geometry_set_gi_mode(InstanceRid p_instance, GiMode p_mode) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) { r_instance.gi_mode = p_mode; });
}

void RenderingServer::instance_geometry_set_cast_shadows_setting(InstanceRid p_instance, ShadowCasting p_setting) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) { r_instance.shadow_casting = p_setting; });
}

void RenderingServer::instance_geometry_set_transparency(InstanceRid p_instance, float p_transparency) {
	Instance *instance = impl->scene.instances.get(p_instance);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	impl->edit_instance(p_instance, *instance, [&](Instance &r_instance) { r_instance.transparency = glm::clamp(p_transparency, 0.0f, 1.0f); });
}

} // namespace lucent
