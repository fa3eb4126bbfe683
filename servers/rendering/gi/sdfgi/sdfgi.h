// SPDX-License-Identifier: MIT
#pragma once
// Signed-distance-field global illumination of one scenario: decides what runs this frame, owns cascades and volumes. doc/sdfgi.md.

#include "servers/rendering/device/pass_recorder.h"
#include "servers/rendering/gi/sdfgi/sdfgi_settings.h"
#include "servers/rendering/gpu_scene.h"

#include <memory>
#include <string>
#include <vector>

namespace lucent {

class RenderingDevice;

// What the gather reads and writes. Depth is reversed z (0: sky).
struct GiGatherInputs {
	TextureHandle depth; // D32_FLOAT
	TextureHandle normal_roughness; // RGBA16_FLOAT: world normal xyz, roughness
	TextureHandle irradiance; // out, RGBA16_FLOAT: diffuse light / pi (times albedo = radiance), a: 1 where GI knows the answer, to 0 where ambient must serve
	TextureHandle radiance; // out, RGBA16_FLOAT: light from the mirror direction at the pixel's roughness, a as above
	Projection world_from_clip{ 1.0f };
	Vector3 camera_position_m{ 0.0f };
	uint32_t width = 0;
	uint32_t height = 0;
};

// Bindings that gi_sample_inc.glsl needs in a draw's set 0, for transparent surfaces and fog: GI_SAMPLE_BINDING_BASE and up, see gi_sample_inc.glsl.
class Sdfgi {
public:
	explicit Sdfgi(RenderingDevice &p_device);
	~Sdfgi();

	// Voxelises, lights and traces what this frame is due. Recreates resources when settings demand it.
	void update(PassRecorder &r_recorder, const SdfgiSettings &p_settings, const GiSceneView &p_scene, const Vector3 &p_camera_position_m);
	void gather(PassRecorder &r_recorder, const GiGatherInputs &p_inputs);
	// Binds GI for the shaders of a render pass that include gi_sample_inc.glsl.
	void bind_sampling(RenderPass &r_pass) const;

	static std::vector<std::string> debug_views(); // names for viewport_set_debug_view
	// Fills p_target (RGBA16_FLOAT, linear) with a debug view; false: unknown name.
	bool draw_debug_view(PassRecorder &r_recorder, const std::string &p_view, const GiGatherInputs &p_inputs, TextureHandle p_target);

	// After the frame has been submitted: reads the counters of a frame that ends a full set of rays, and decides whether all is settled.
	void after_frame();
	GiStats stats() const;

private:
	struct Impl;
	std::unique_ptr<Impl> impl;
};

} // namespace lucent
