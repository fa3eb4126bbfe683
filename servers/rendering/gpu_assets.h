// SPDX-License-Identifier: MIT
#pragma once
// What all scenarios share on the device: geometry arenas, textures, materials. Uploads only what changed.

#include "servers/rendering/device/rendering_device.h"
#include "servers/rendering/range_allocator.h"
#include "servers/rendering/render_scene.h"
#include "servers/rendering/shaders/scene_io.h"

#include <unordered_map>
#include <vector>

namespace lucent {

struct SurfaceGeometry {
	uint32_t first_index = 0;
	uint32_t index_count = 0;
	int32_t vertex_offset = 0;
};

// A buffer that is remade larger when it must hold more. Contents are lost then.
struct GrowingBuffer {
	OwnedBuffer buffer;
	uint64_t size_bytes = 0;
	// True: the buffer was remade.
	bool reserve(RenderingDevice &p_device, uint64_t p_size_bytes, uint32_t p_usage, const char *p_name);
};

class GpuAssets {
public:
	static constexpr uint32_t DEFAULT_MATERIAL = 0;
	static constexpr uint32_t GI_TEXTURE_SIZE_TEXELS = 128;

	explicit GpuAssets(RenderingDevice &p_device);
	void update(const RenderScene &p_scene);

	const SurfaceGeometry &surface(const MeshSurface *p_surface) const { return surfaces.at(p_surface).geometry; }
	// Indices into the materials buffer are the ids' plus 1; 0 is the material of surfaces without one.
	static uint32_t material_index(MaterialRid p_material) { return p_material.index + 1; }
	BindingSetHandle material_set(uint32_t p_index) const { return materials[p_index].set; }

	BufferHandle positions() const { return positions_buffer.buffer; }
	BufferHandle attributes() const { return attributes_buffer.buffer; }
	BufferHandle indices() const { return indices_buffer.buffer; }
	BufferHandle material_buffer() const { return materials_buffer.buffer; }
	TextureHandle gi_textures() const { return gi_array; }
	// White where p_texture is no texture.
	TextureHandle texture(TextureRid p_texture) const;
	TextureHandle black() const { return black_texture; }
	TextureHandle environment_brdf() const { return environment_brdf_texture; } // BrdfTable, RG16_FLOAT

private:
	struct GpuSurface {
		std::shared_ptr<const MeshSurface> source;
		SurfaceGeometry geometry;
		uint64_t seen = 0; // update in which a mesh had it
	};
	struct GpuTexture {
		OwnedTexture texture;
		Vector4 mean{ 1.0f }; // of its texels, as stored
		uint64_t version = 0;
	};
	struct GpuMaterial {
		OwnedBindingSet set;
		uint64_t version = 0;
	};
	void update_surfaces(const RenderScene &p_scene);
	void upload_surface(const GpuSurface &p_surface);
	void update_textures(const RenderScene &p_scene);
	void update_gi_textures(const RenderScene &p_scene);
	void update_materials(const RenderScene &p_scene);
	OwnedBindingSet make_material_set(const Material &p_material) const;
	shader::MaterialData material_data(const Material &p_material) const;
	// p_slot's mean times the factor.
	float mean_of(const Material &p_material, TextureSlot p_slot, float p_factor) const;
	OwnedTexture make_texture(const SceneTexture &p_texture, const std::string &p_name, Vector4 &r_mean);
	OwnedTexture make_pixel(uint32_t p_rgba, const char *p_name);
	OwnedTexture make_environment_brdf();

	RenderingDevice &device;
	uint64_t update_count = 0;
	std::unordered_map<const MeshSurface *, GpuSurface> surfaces;
	RangeAllocator vertex_ranges;
	RangeAllocator index_ranges;
	GrowingBuffer positions_buffer, attributes_buffer, indices_buffer, materials_buffer;
	std::vector<GpuTexture> textures; // by the id's index
	std::vector<GpuMaterial> materials;
	std::vector<shader::MaterialData> material_values;
	OwnedTexture white_texture, black_texture, flat_normal_texture, environment_brdf_texture;
	OwnedTexture gi_array;
	std::vector<std::pair<TextureRid, uint64_t>> gi_layers; // texture and version by layer
};

} // namespace lucent
