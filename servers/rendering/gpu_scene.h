// SPDX-License-Identifier: MIT
#pragma once
// The device's copy of a RenderScene: geometry arenas, instances, materials, lights. Uploads only what changed.
// (Interface that GI relies on; the renderer's owner adds what the raster passes need.)

#include "servers/rendering/device/resource_types.h"
#include "servers/rendering/render_scene.h"
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

} // namespace lucent
