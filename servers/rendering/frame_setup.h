// SPDX-License-Identifier: MIT
#pragma once
// What one view of one frame needs to know: matrices, environment, lists of lights. Pure CPU.

#include "servers/rendering/gpu_scene.h"
#include "servers/rendering/passes/frame_io.h"
#include "servers/rendering/passes/light_clusters_io.h"
#include "servers/rendering/passes/sky_io.h"
#include "servers/rendering/passes/tonemap_io.h"

namespace lucent {

// A viewport's environment: the camera's, the scenario's or the fallback; an empty one where there is none.
const Environment &find_environment(const RenderScene &p_scene, const Scenario &p_scenario, const Camera &p_camera);

struct FrameSetup {
	const Environment *environment = nullptr;
	float aspect = 1.0f;
	Projection clip_from_view{ 1.0f };
	Projection clip_from_world{ 1.0f };
	shader::FrameData frame{};
	shader::SkyData sky{};
	TextureRid panorama;
	shader::TonemapConstants tonemap{};
	shader::LightClustersConstants clusters{};
	uint32_t cluster_mask_count = 0; // 0: no light but the sun
};

// p_camera: relative to the scene's RenderOrigin.
FrameSetup make_frame_setup(const RenderScene &p_scene, const Viewport &p_viewport, const Scenario &p_scenario, const Camera &p_camera, const GpuScene &p_gpu_scene);

} // namespace lucent
