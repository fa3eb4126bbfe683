// SPDX-License-Identifier: MIT
#pragma once
// What passes that draw the scene bind, and how batches become draws.

#include "servers/rendering/passes/frame_io.h"
#include "servers/rendering/scene_cull.h"

namespace lucent {

struct SceneBindings {
	BufferHandle frame; // shader::FrameData
	BufferHandle positions, attributes, indices, instances, materials;
	BufferHandle draw_instances; // uint32: instance of each gl_InstanceIndex
};

struct ShadingBindings {
	BufferHandle lights, clusters, shadow_views;
	TextureHandle sun_shadows, light_shadows;
	SamplerHandle shadow_sampler, linear_sampler;
	TextureHandle sky_irradiance, sky_radiance;
	TextureHandle environment_brdf; // GpuAssets's
};

RenderPass &bind_geometry(RenderPass &r_pass, const SceneBindings &p_scene);
// Geometry, materials and the frame's uniform block.
RenderPass &bind_scene(RenderPass &r_pass, const SceneBindings &p_scene);
RenderPass &bind_shading(RenderPass &r_pass, const ShadingBindings &p_shading);
DrawCommand make_draw(const DrawBatch &p_batch, const GpuAssets &p_assets, const DrawState &p_state);
CullMode cull_mode(MaterialCull p_cull);

} // namespace lucent
