// SPDX-License-Identifier: MIT
#include "servers/rendering/gpu_assets.h"

#include "servers/rendering/mesh_attributes.h"

#include <algorithm>

namespace lucent {

bool GrowingBuffer::reserve(RenderingDevice &p_device, uint64_t p_size_bytes, uint32_t p_usage, const char *p_name) {
	if (buffer.is_valid() && p_size_bytes <= size_bytes) {
		return false;
	}
	size_bytes = std::max<uint64_t>({ p_size_bytes, size_bytes + size_bytes / 2, 256 });
	buffer = p_device.create_buffer({ size_bytes, p_usage, p_name });
	return true;
}

GpuAssets::GpuAssets(RenderingDevice &p_device) :
		device(p_device) {
	white_texture = make_pixel(0xFFFFFFFFu, "scene.white");
	black_texture = make_pixel(0xFF000000u, "scene.black");
	flat_normal_texture = make_pixel(0xFFFF8080u, "scene.flat_normal");
	environment_brdf_texture = make_environment_brdf();
}

void GpuAssets::update(const RenderScene &p_scene) {
	update_count++;
	update_textures(p_scene);
	update_gi_textures(p_scene);
	update_materials(p_scene);
	update_surfaces(p_scene);
}

void GpuAssets::update_surfaces(const RenderScene &p_scene) {
	std::vector<const MeshSurface *> added;
	uint64_t vertices = 0;
	uint64_t indices = 0;
	p_scene.meshes.for_each([&](MeshRid, const Mesh &p_mesh) {
		for (const std::shared_ptr<const MeshSurface> &surface : p_mesh.surfaces) {
			GpuSurface &entry = surfaces[surface.get()];
			if (entry.source == nullptr) {
				entry.source = surface;
				added.push_back(surface.get());
			}
			entry.seen = update_count;
		}
	});
	std::erase_if(surfaces, [&](const auto &p_item) {
		const GpuSurface &surface = p_item.second;
		if (surface.seen == update_count) {
			vertices += surface.source->positions.size();
			indices += surface.source->indices.size();
			return false;
		}
		vertex_ranges.free(uint64_t(surface.geometry.vertex_offset), surface.source->positions.size());
		index_ranges.free(surface.geometry.first_index, surface.geometry.index_count);
		return true;
	});
	for (const MeshSurface *source : added) {
		GpuSurface &surface = surfaces[source];
		uint64_t vertex_offset = vertex_ranges.allocate(source->positions.size());
		if (vertex_offset == UINT64_MAX) {
			vertex_ranges.grow(std::max(vertex_ranges.capacity() + source->positions.size(), vertices));
			vertex_offset = vertex_ranges.allocate(source->positions.size());
		}
		uint64_t first_index = index_ranges.allocate(source->indices.size());
		if (first_index == UINT64_MAX) {
			index_ranges.grow(std::max(index_ranges.capacity() + source->indices.size(), indices));
			first_index = index_ranges.allocate(source->indices.size());
		}
		surface.geometry = { uint32_t(first_index), uint32_t(source->indices.size()), int32_t(vertex_offset) };
	}
	bool remade = positions_buffer.reserve(device, vertex_ranges.capacity() * sizeof(Vector3), BUFFER_STORAGE, "scene.positions");
	remade |= attributes_buffer.reserve(device, vertex_ranges.capacity() * sizeof(shader::VertexAttributes), BUFFER_STORAGE, "scene.attributes");
	remade |= indices_buffer.reserve(device, index_ranges.capacity() * sizeof(uint32_t), BUFFER_STORAGE | BUFFER_INDEX, "scene.indices");
	if (remade) {
		for (const auto &[source, surface] : surfaces) {
			upload_surface(surface);
		}
	} else {
		for (const MeshSurface *source : added) {
			upload_surface(surfaces[source]);
		}
	}
}

void GpuAssets::upload_surface(const GpuSurface &p_surface) {
	const uint64_t vertex_offset = uint64_t(p_surface.geometry.vertex_offset);
	device.upload_buffer(positions_buffer.buffer, p_surface.source->positions, vertex_offset * sizeof(Vector3));
	device.upload_buffer(attributes_buffer.buffer, make_vertex_attributes(*p_surface.source), vertex_offset * sizeof(shader::VertexAttributes));
	device.upload_buffer(indices_buffer.buffer, p_surface.source->indices, uint64_t(p_surface.geometry.first_index) * sizeof(uint32_t));
}

} // namespace lucent
