// SPDX-License-Identifier: MIT
#include "modules/app/framing.h"

#include <algorithm>

namespace lucent {

std::vector<AABB> visible_boxes(const RenderScene &p_scene) {
	std::vector<AABB> boxes;
	p_scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
		const Mesh *mesh = p_scene.meshes.get(p_instance.mesh);
		if (mesh != nullptr && p_instance.visible && !mesh->aabb.is_empty()) {
			boxes.push_back(mesh->aabb.xform(p_instance.transform));
		}
	});
	return boxes;
}

static AABB merged(const std::vector<AABB> &p_boxes) {
	AABB bounds;
	for (const AABB &box : p_boxes) {
		bounds.merge_with(box);
	}
	return bounds;
}

AABB visible_bounds(const RenderScene &p_scene) {
	return merged(visible_boxes(p_scene));
}

AABB bounds_without_backdrop(std::vector<AABB> p_boxes) {
	static const float BACKDROP_RADII = 4.0f;
	static const float FLAT = 0.02f; // smallest by largest side
	const auto size = [](const AABB &p_box) { return glm::length(p_box.size()); };
	const auto is_flat = [](const AABB &p_box) {
		const Vector3 sides = p_box.size();
		return std::min({ sides.x, sides.y, sides.z }) <= FLAT * std::max({ sides.x, sides.y, sides.z });
	};
	std::sort(p_boxes.begin(), p_boxes.end(), [&](const AABB &p_a, const AABB &p_b) { return size(p_a) < size(p_b); });
	AABB bounds = merged(p_boxes);
	while (p_boxes.size() > 1 && is_flat(p_boxes.back())) {
		const float largest = size(p_boxes.back());
		p_boxes.pop_back();
		const AABB rest = merged(p_boxes);
		if (!(largest > BACKDROP_RADII * size(rest))) {
			break;
		}
		bounds = rest;
	}
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
