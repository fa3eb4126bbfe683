// SPDX-License-Identifier: MIT
#pragma once
// The passes that draw surfaces into the screen's targets.

#include "servers/rendering/passes/scene_bindings.h"

#include <functional>

namespace lucent {

struct DepthPrepassInputs {
	const SceneBindings &scene;
	const GpuAssets &assets;
	std::span<const DrawBatch> batches;
	TextureHandle depth; // out, D32_FLOAT, cleared to 0
	TextureHandle normal_roughness; // out, RGBA16_FLOAT
	TextureHandle motion; // out, RG16_FLOAT, uv now - uv before
};
void depth_prepass(PassRecorder &r_recorder, const DepthPrepassInputs &p_in);

// Extra targets of the opaque pass, RGBA16_FLOAT. All or none.
struct AovTargets {
	TextureHandle direct, indirect_diffuse, indirect_specular, emission, albedo;
};

struct OpaqueInputs {
	const SceneBindings &scene;
	const ShadingBindings &shading;
	const GpuAssets &assets;
	std::span<const DrawBatch> batches;
	TextureHandle gi_irradiance, gi_radiance; // screen-sized where GI is on
	TextureHandle depth; // of depth_prepass
	TextureHandle color; // out, RGBA16_FLOAT
	const AovTargets *aov = nullptr;
};
void opaque(PassRecorder &r_recorder, const OpaqueInputs &p_in);

struct TransparentInputs {
	const SceneBindings &scene;
	const ShadingBindings &shading;
	const GpuAssets &assets;
	std::span<const DrawBatch> batches; // back to front
	TextureHandle depth;
	TextureHandle color; // blended into
	std::function<void(RenderPass &)> bind_gi; // binds what gi_sample_inc.glsl reads; empty: no GI
};
void transparent(PassRecorder &r_recorder, const TransparentInputs &p_in);

} // namespace lucent
