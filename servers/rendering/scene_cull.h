// SPDX-License-Identifier: MIT
#pragma once
// Frustum culling and the making of draw lists, on the CPU.

#include "servers/rendering/gpu_scene.h"

#include <array>

namespace lucent {

// Planes point inwards: dot(plane, (p, 1)) >= 0 inside.
struct Frustum {
	std::array<Vector4, 6> planes;
	explicit Frustum(const Projection &p_clip_from_world);
	bool intersects(const AABB &p_box) const;
};

// One instanced draw: count entries of the draw instances from first_instance.
struct DrawBatch {
	const SceneDraw *draw = nullptr;
	uint32_t first_instance = 0;
	uint32_t instance_count = 0;
};

// Appends the instances to r_instances, one batch for neighbours that differ only in the instance.
class DrawListBuilder {
public:
	explicit DrawListBuilder(std::vector<uint32_t> &r_instances) :
			instances(r_instances) {}
	void add(const SceneDraw &p_draw);
	std::vector<DrawBatch> batches;

private:
	std::vector<uint32_t> &instances;
};

std::vector<DrawBatch> cull_opaque(const GpuScene &p_scene, const Projection &p_clip_from_world, uint32_t p_cull_mask, std::vector<uint32_t> &r_instances);
// Back to front along p_forward, lower render_priority first.
std::vector<DrawBatch> cull_transparent(const GpuScene &p_scene, const Projection &p_clip_from_world, uint32_t p_cull_mask, const Vector3 &p_forward, std::vector<uint32_t> &r_instances);
std::vector<DrawBatch> cull_shadow_casters(const GpuScene &p_scene, const Projection &p_clip_from_world, std::vector<uint32_t> &r_instances);

} // namespace lucent
