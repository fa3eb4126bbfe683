// SPDX-License-Identifier: MIT
#include "servers/rendering/render_scene.h"

#include <glm/gtc/matrix_transform.hpp>

namespace lucent {

const Environment *RenderScene::find_environment(const Scenario &p_scenario, const Camera &p_camera) const {
	for (const EnvironmentRid rid : { p_camera.environment, p_scenario.environment, p_scenario.fallback_environment }) {
		if (const Environment *environment = environments.get(rid)) {
			return environment;
		}
	}
	return nullptr;
}

const Material *RenderScene::surface_material(const Instance &p_instance, const Mesh &p_mesh, uint32_t p_surface) const {
	if (const Material *material = materials.get(p_instance.material_override)) {
		return material;
	}
	if (p_surface < p_instance.surface_override_materials.size()) {
		if (const Material *material = materials.get(p_instance.surface_override_materials[p_surface])) {
			return material;
		}
	}
	return p_surface < p_mesh.surfaces.size() ? materials.get(p_mesh.surfaces[p_surface]->material) : nullptr;
}

Projection camera_projection(const Camera &p_camera, float p_aspect) {
	const float near_m = std::max(p_camera.near_m, 1e-7f);
	const float far_m = std::max(p_camera.far_m, near_m * 1.001f);
	const float size = p_camera.kind == Camera::Kind::PERSPECTIVE ? 2.0f * near_m * std::tan(0.5f * glm::radians(p_camera.fov_degrees)) : p_camera.size_m;
	Vector2 half(0.5f * size); // of the near plane
	if (p_camera.keep_height) {
		half.x *= p_aspect;
	} else {
		half.y /= p_aspect;
	}
	const Vector2 offset = p_camera.kind == Camera::Kind::FRUSTUM ? p_camera.frustum_offset : Vector2(0.0f);
	Projection projection(0.0f);
	if (p_camera.kind == Camera::Kind::ORTHOGONAL) {
		projection[0][0] = 1.0f / half.x;
		projection[1][1] = -1.0f / half.y;
		projection[2][2] = 1.0f / (far_m - near_m);
		projection[3][2] = far_m / (far_m - near_m);
		projection[3][3] = 1.0f;
		return projection;
	}
	projection[0][0] = near_m / half.x;
	projection[1][1] = -near_m / half.y;
	projection[2][0] = offset.x / half.x;
	projection[2][1] = -offset.y / half.y;
	projection[2][2] = near_m / (far_m - near_m);
	projection[2][3] = -1.0f;
	projection[3][2] = near_m * far_m / (far_m - near_m);
	return projection;
}

} // namespace lucent
