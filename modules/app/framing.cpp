// SPDX-License-Identifier: MIT
#include "modules/app/framing.h"

#include <algorithm>

namespace lucent {

AABB visible_bounds(const RenderScene &p_scene) {
	AABB bounds;
	p_scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
		const Mesh *mesh = p_scene.meshes.get(p_instance.mesh);
		if (mesh != nullptr && p_instance.visible && !mesh->aabb.is_empty()) {
			bounds.merge_with(mesh->aabb.xform(p_instance.transform));
		}
	});
	return bounds;
}

Framing frame_bounds(const AABB &p_bounds, float p_fov_y_degrees, float p_aspect) {
	static const Vector3 DIRECTION(0.55f, 0.4f, 1.0f); // from the centre to the eye
	static const float MARGIN = 1.05f;
	const AABB bounds = p_bounds.is_empty() ? AABB{ Vector3(-1.0f), Vector3(1.0f) } : p_bounds;
	const Vector3 back = glm::normalize(DIRECTION);
	const Vector3 right = glm::normalize(glm::cross(Vector3(0, 1, 0), back));
	const Vector3 up = glm::cross(back, right);
	const float tan_y = std::tan(glm::radians(p_fov_y_degrees) * 0.5f) / MARGIN;
	const float tan_x = tan_y * p_aspect;
	const float radius = std::max(0.5f * glm::length(bounds.size()), 1e-9f);
	float distance = 0.0f; // at which every corner is inside
	for (int i = 0; i < 8; i++) {
		const Vector3 half = 0.5f * bounds.size() * Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
		const float beside = std::max(std::abs(glm::dot(half, right)) / tan_x, std::abs(glm::dot(half, up)) / tan_y);
		distance = std::max(distance, glm::dot(half, back) + beside);
	}
	distance = std::max(distance, 1.01f * radius);
	Framing framing;
	framing.transform = { Basis(right, up, back), bounds.center() + back * distance };
	framing.near_m = 0.1f * (distance - radius);
	framing.far_m = 20.0f * (distance + radius);
	return framing;
}

} // namespace lucent
