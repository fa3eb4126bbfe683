// SPDX-License-Identifier: MIT
#pragma once
// The device's copy of a RenderScene: geometry arenas, instances, materials, lights. Uploads only what changed. All positions are relative
// to the scenario's RenderOrigin.

#include "servers/rendering/gpu_assets.h"
#include "servers/rendering/render_origin.h"
#include "servers/rendering/shaders/scene_io.h"

#include <vector>

namespace lucent {

// Everything that GI reads of a scenario. Handles stay valid for the frame; counts may be 0, buffers are never null.
struct GiSceneView {
	BufferHandle positions; // vec3 floats, tightly packed
	BufferHandle attributes; // shader::VertexAttributes
	BufferHandle indices; // uint32
	BufferHandle instances; // shader::InstanceData
	BufferHandle materials; // shader::MaterialData
	BufferHandle lights; // shader::LightData, those with LIGHT_FLAG_GI first
	uint32_t light_count = 0; // those with LIGHT_FLAG_GI
	TextureHandle gi_textures; // 2D array of RGBA8_SRGB: each texture that an albedo or emission slot uses, box-filtered to 128 x 128
	SamplerHandle gi_sampler; // linear, repeat

	// Opaque, alpha-scissored and alpha-blended surfaces (the voxelizer tests alpha) of visible instances with GiMode::STATIC, stable order; shadows-only instances are left out.
	std::vector<shader::GiSurface> gi_surfaces;
	std::vector<AABB> gi_surface_boxes; // world, beside gi_surfaces
	uint32_t gi_triangle_count = 0;

	uint64_t geometry_version = 0; // changes when anything that the voxelizer reads does
	uint64_t light_version = 0; // … when lights or the sky do

	TextureHandle sky_octahedral; // RGBA16F, square, world directions (octahedral_inc.glsl), radiance with energy; the background colour where there is no sky; no sun disc
	Vector3 ambient_color{ 0.0f }; // what lights a point outside of every cascade
};

// One surface of one visible instance.
struct SceneDraw {
	SurfaceGeometry geometry;
	uint32_t instance = 0; // into the instances buffer
	uint32_t material = 0; // into the materials buffer
	uint32_t layers = 1;
	MaterialCull cull = MaterialCull::BACK;
	MaterialBlend blend = MaterialBlend::MIX;
	bool mirrored = false;
	bool transparent = false; // drawn in the transparent pass
	bool scissor = false;
	bool drawn = true; // false: shadows only
	bool casts_shadow = true;
	int32_t render_priority = 0;
	AABB box; // world
};

// One scenario on the device.
class GpuScene {
public:
	GpuScene(RenderingDevice &p_device, ScenarioRid p_scenario) :
			device(p_device), scenario_rid(p_scenario) {}
	// The assets must have been updated first.
	void update(const RenderScene &p_scene, const GpuAssets &p_assets, const RenderOrigin &p_origin);

	ScenarioRid scenario() const { return scenario_rid; }
	const RenderOrigin &origin() const { return render_origin; }
	// Sorted by state, material and geometry, so that equal neighbours become one instanced draw.
	const std::vector<SceneDraw> &draws() const { return scene_draws; }
	const AABB &bounds() const { return scene_bounds; } // of what is drawn or casts shadows
	const std::vector<shader::LightData> &lights() const { return light_values; }
	const std::vector<LightRid> &light_rids() const { return light_ids; }
	// p_shadow_indices: LightData::shadow_index of each light.
	void set_shadow_indices(const std::vector<int> &p_shadow_indices);
	// All but the sky.
	const GiSceneView &gi_view() const { return view; }

private:
	void collect(const RenderScene &p_scene, const GpuAssets &p_assets);
	void collect_lights(const RenderScene &p_scene);
	void collect_instance(const RenderScene &p_scene, const GpuAssets &p_assets, const Instance &p_instance, const Mesh &p_mesh);
	void upload_lights();

	RenderingDevice &device;
	ScenarioRid scenario_rid;
	uint64_t scene_version = 0;
	RenderOrigin render_origin;
	std::vector<SceneDraw> scene_draws;
	AABB scene_bounds;
	std::vector<shader::InstanceData> instance_values, uploaded_instances;
	std::vector<shader::LightData> light_values, uploaded_lights;
	std::vector<LightRid> light_ids;
	GrowingBuffer instances_buffer, lights_buffer;
	GiSceneView view;
};

} // namespace lucent
