// SPDX-License-Identifier: MIT
#pragma once
// The lit world that GI techniques share: owns the cascades' cells, distance field and surface records, and builds them from triangles.
// Formats and addressing: world_io.h; method: doc/sdfgi.md, "The world".

#include "servers/rendering/device/rendering_device.h"
#include "servers/rendering/gi/world/world_io.h"
#include "servers/rendering/gpu_scene.h"

#include <vector>

namespace lucent {

struct GiWorldDesc {
	uint32_t cascades = 4; // 1 to WORLD_MAX_CASCADES
	uint32_t grid_size = 128; // cells an axis, a power of two, 32 to 256
	float min_cell_m = 0.2f; // cascade c: min_cell_m * 2^c
	float y_multiplier = 1.5f; // cells are flatter than wide by this
	bool operator==(const GiWorldDesc &) const = default;
};

class GiWorld {
public:
	GiWorld(RenderingDevice &p_device, const GiWorldDesc &p_desc);

	const GiWorldDesc &desc() const { return world_desc; }
	Vector3 cell_m(uint32_t p_cascade) const;
	Vector3i origin_cells(uint32_t p_cascade) const { return params.cascades[p_cascade].origin_cells; }
	void set_origin_cells(uint32_t p_cascade, const Vector3i &p_origin) { params.cascades[p_cascade].origin_cells = p_origin; }
	void set_sky_scale(float p_scale) { params.sky_scale = p_scale; }

	// Sends the parameters to the device; before any other pass of the frame.
	void upload_params(PassRecorder &r_recorder);
	// Keeps the scene's triangles for rays; when geometry has changed, before the cascades are built.
	void store_triangles(PassRecorder &r_recorder, const GiSceneView &p_scene);
	// Voxelises a cascade from nothing: cells, bits, records, distance field. The records' light becomes black.
	void rebuild_cascade(PassRecorder &r_recorder, const GiSceneView &p_scene, uint32_t p_cascade);
	// Finds the points that a cascade's records light from; after all rebuilds, since it traces rays.
	void place_record_starts(PassRecorder &r_recorder, uint32_t p_cascade);
	// The list for next-event estimation; after the starts.
	void collect_emitters(PassRecorder &r_recorder);
	// What was written this frame becomes what is read.
	void swap_light() { current_light ^= 1; }

	// Binds WORLD_PARAMS … WORLD_SDF / … WORLD_SKY_SAMPLER for shaders that include trace_world_inc.glsl / surface_light_inc.glsl.
	// p_base: added to each binding, see GI_SAMPLE_BINDING_BASE.
	template <typename Pass>
	void bind_trace(Pass &r_pass, uint32_t p_base = 0) const {
		r_pass.uniform(p_base + WORLD_PARAMS, params_buffer).read(p_base + WORLD_OCCUPANCY, occupancy).read(p_base + WORLD_BRICK_CELL_BASE, brick_cell_base).read(p_base + WORLD_CELLS, cells).read(p_base + WORLD_SDF, sdf);
		r_pass.read(p_base + WORLD_CELL_TRIANGLES, cell_triangles).read(p_base + WORLD_TRIANGLES, world_triangles);
	}
	template <typename Pass>
	void bind_light(Pass &r_pass, TextureHandle p_sky, uint32_t p_base = 0) const {
		bind_trace(r_pass, p_base);
		r_pass.read(p_base + WORLD_RECORDS, records).read(p_base + WORLD_RECORD_LIGHT, record_light[current_light]).read(p_base + WORLD_SKY, p_sky);
		r_pass.sampler(p_base + WORLD_SKY_SAMPLER, sky_sampler);
	}
	BufferHandle params_handle() const { return params_buffer; }
	BufferHandle counts_handle() const { return counts; }
	BufferHandle emitters_handle() const { return emitters; }
	BufferHandle emitter_count_handle() const { return emitter_count; }
	BufferHandle record_state_handle() const { return record_state; }
	BufferHandle next_light_handle() const { return record_light[current_light ^ 1]; }
	BufferHandle occupancy_handle() const { return occupancy; }
	BufferHandle sdf_handle() const { return sdf; }
	BufferHandle cells_handle() const { return cells; }
	BufferHandle brick_cell_base_handle() const { return brick_cell_base; }
	BufferHandle records_handle() const { return records; }
	const shader::GiWorldParams &parameters() const { return params; }
	uint32_t record_capacity() const { return params.record_capacity; }
	uint64_t size_bytes() const { return bytes + world_triangle_bytes; }

private:
	OwnedBuffer make_buffer(const char *p_name, uint64_t p_size_bytes, uint32_t p_usage = BUFFER_STORAGE);
	void clear_words(PassRecorder &r_recorder, const char *p_name, BufferHandle p_buffer, uint32_t p_first, uint32_t p_count, uint32_t p_value = 0);
	void build_sdf(PassRecorder &r_recorder, uint32_t p_cascade);
	ComputePass geometry_pass(PassRecorder &r_recorder, const char *p_name, Shader p_shader, const GiSceneView &p_scene, BufferHandle p_surfaces, const shader::VoxelizeConstants &p_constants);
	uint32_t cull_surfaces(const GiSceneView &p_scene, uint32_t p_cascade, uint32_t &r_triangles);

	RenderingDevice &device;
	GiWorldDesc world_desc;
	shader::GiWorldParams params{};
	uint64_t bytes = 0;
	uint32_t current_light = 0;
	OwnedBuffer params_buffer;
	OwnedBuffer occupancy;
	OwnedBuffer brick_cell_base;
	OwnedBuffer cells;
	OwnedBuffer sdf;
	OwnedBuffer cell_triangles;
	OwnedBuffer world_triangles;
	OwnedBuffer all_surfaces;
	uint64_t world_triangle_bytes = 0;
	uint32_t stored_triangles = 0;
	OwnedBuffer records;
	OwnedBuffer record_light[2];
	OwnedBuffer record_state;
	OwnedBuffer counts;
	OwnedBuffer emitters;
	OwnedBuffer emitter_count;
	// Scratch of one cascade's build.
	OwnedBuffer accumulators;
	OwnedBuffer column_stretches;
	OwnedBuffer distance_scratch[2];
	OwnedBuffer near_bricks[2];
	OwnedBuffer near_list;
	std::vector<OwnedBuffer> surfaces; // by cascade
	SamplerHandle sky_sampler;
};

} // namespace lucent
