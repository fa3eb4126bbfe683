// SPDX-License-Identifier: MIT
#include "servers/rendering/scene_cull.h"

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>

namespace lucent {

// Gribb and Hartmann, "Fast Extraction of Viewing Frustum Planes from the World-View-Projection Matrix", 2001.
Frustum::Frustum(const Projection &p_clip_from_world) {
	const Vector4 x = glm::row(p_clip_from_world, 0);
	const Vector4 y = glm::row(p_clip_from_world, 1);
	const Vector4 z = glm::row(p_clip_from_world, 2);
	const Vector4 w = glm::row(p_clip_from_world, 3);
	planes = { w + x, w - x, w + y, w - y, z, w - z };
}

bool Frustum::intersects(const AABB &p_box) const {
	for (const Vector4 &plane : planes) {
		const Vector3 normal(plane);
		const Vector3 farthest = glm::mix(p_box.min, p_box.max, glm::greaterThan(normal, Vector3(0.0f)));
		if (glm::dot(normal, farthest) + plane.w < 0.0f) {
			return false;
		}
	}
	return true;
}

void DrawListBuilder::add(const SceneDraw &p_draw) {
	if (!batches.empty()) {
		DrawBatch &last = batches.back();
		const SceneDraw &other = *last.draw;
		if (other.material == p_draw.material && other.geometry.first_index == p_draw.geometry.first_index && other.mirrored == p_draw.mirrored) {
			last.instance_count++;
			instances.push_back(p_draw.instance);
			return;
		}
	}
	batches.push_back({ &p_draw, uint32_t(instances.size()), 1 });
	instances.push_back(p_draw.instance);
}

std::vector<DrawBatch> cull_opaque(const GpuScene &p_scene, const Projection &p_clip_from_world, uint32_t p_cull_mask, std::vector<uint32_t> &r_instances) {
	const Frustum frustum(p_clip_from_world);
	DrawListBuilder builder(r_instances);
	for (const SceneDraw &draw : p_scene.draws()) {
		if (draw.drawn && !draw.transparent && (draw.layers & p_cull_mask) != 0 && frustum.intersects(draw.box)) {
			builder.add(draw);
		}
	}
	return std::move(builder.batches);
}

std::vector<DrawBatch> cull_transparent(const GpuScene &p_scene, const Projection &p_clip_from_world, uint32_t p_cull_mask, const Vector3 &p_forward, std::vector<uint32_t> &r_instances) {
	const Frustum frustum(p_clip_from_world);
	std::vector<const SceneDraw *> visible;
	for (const SceneDraw &draw : p_scene.draws()) {
		if (draw.drawn && draw.transparent && (draw.layers & p_cull_mask) != 0 && frustum.intersects(draw.box)) {
			visible.push_back(&draw);
		}
	}
	std::stable_sort(visible.begin(), visible.end(), [&](const SceneDraw *p_a, const SceneDraw *p_b) {
		if (p_a->render_priority != p_b->render_priority) {
			return p_a->render_priority < p_b->render_priority;
		}
		return glm::dot(p_a->box.center(), p_forward) > glm::dot(p_b->box.center(), p_forward);
	});
	DrawListBuilder builder(r_instances);
	for (const SceneDraw *draw : visible) {
		builder.add(*draw);
	}
	return std::move(builder.batches);
}

std::vector<DrawBatch> cull_shadow_casters(const GpuScene &p_scene, const Projection &p_clip_from_world, std::vector<uint32_t> &r_instances) {
	const Frustum frustum(p_clip_from_world);
	DrawListBuilder builder(r_instances);
	for (const SceneDraw &draw : p_scene.draws()) {
		if (draw.casts_shadow && frustum.intersects(draw.box)) {
			builder.add(draw);
		}
	}
	return std::move(builder.batches);
}

} // namespace lucent
