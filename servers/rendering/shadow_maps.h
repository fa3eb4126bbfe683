// SPDX-License-Identifier: MIT
#pragma once
// Which lights get shadow maps, from where they look, and which maps must be drawn again.

#include "servers/rendering/passes/scene_bindings.h"

namespace lucent {

struct ShadowJob {
	Projection clip_from_world{ 1.0f };
	TextureHandle map;
	uint32_t layer = 0;
	std::vector<DrawBatch> batches;
};

class ShadowMaps {
public:
	static constexpr uint32_t SUN_SIZE_TEXELS = 2048;
	static constexpr uint32_t MAX_SUNS = 2;
	static constexpr uint32_t MAX_LIGHT_LAYERS = 96;

	explicit ShadowMaps(RenderingDevice &p_device) :
			device(p_device) {}

	// Sets the scene's shadow indices, makes the maps that are missing and lists the ones to draw (cleared to 1, standard z).
	// p_camera: relative to the scene's RenderOrigin.
	void plan(GpuScene &r_scene, const RenderScene &p_scene, const Camera &p_camera, float p_aspect, uint64_t p_geometry_version, std::vector<uint32_t> &r_draw_instances);

	const std::vector<ShadowJob> &jobs() const { return draw_jobs; }
	BufferHandle views() const { return views_buffer.buffer; }
	TextureHandle sun_maps() const { return sun_texture; }
	TextureHandle light_maps() const { return light_texture; }

private:
	struct DrawnLayer {
		Projection clip_from_world{ 0.0f };
		Vector3 origin_m{ 0.0f }; // the matrix may be the same about another origin
		uint64_t geometry_version = 0;
		bool operator==(const DrawnLayer &) const = default;
	};
	std::vector<int> choose_lights(const GpuScene &p_scene);
	void resize_maps(uint32_t p_sun_layers, uint32_t p_light_layers);
	void add_sun(const GpuScene &p_scene, const shader::LightData &p_light, const Camera &p_camera, float p_aspect, float p_max_distance_m, uint32_t p_first_layer);
	void add_omni(const shader::LightData &p_light, uint32_t p_first_layer);
	void add_spot(const shader::LightData &p_light, uint32_t p_layer);
	void add_perspective(const shader::LightData &p_light, const Vector3 &p_forward, const Vector3 &p_up, float p_tan_half, uint32_t p_layer);
	void add_view(const Projection &p_clip_from_world, bool p_sun, uint32_t p_layer, float p_texel_size, float p_end_m);

	RenderingDevice &device;
	OwnedTexture sun_texture, light_texture;
	uint32_t sun_layers = 0, light_layers = 0, light_size_texels = 0;
	std::vector<DrawnLayer> drawn_sun, drawn_light;
	GrowingBuffer views_buffer;
	std::vector<shader::ShadowView> view_values, uploaded_views;
	std::vector<ShadowJob> planned, draw_jobs; // planned: every view; draw_jobs: those that changed
};

void draw_shadow_maps(PassRecorder &r_recorder, const SceneBindings &p_scene, const GpuAssets &p_assets, const std::vector<ShadowJob> &p_jobs);

} // namespace lucent
