// SPDX-License-Identifier: MIT
#include "servers/rendering/rendering_server_impl.h"

#include <algorithm>

namespace lucent {

namespace {
bool is_finite(const Vector3 &p_value) {
	return std::isfinite(p_value.x) && std::isfinite(p_value.y) && std::isfinite(p_value.z);
}

// Empty: nothing wrong.
std::string check_surface(const MeshSurface &p_surface) {
	const size_t vertices = p_surface.positions.size();
	if (vertices == 0 || p_surface.indices.empty()) {
		return "a surface needs positions and indices";
	}
	if (p_surface.indices.size() % 3 != 0) {
		return fmt::format("{} indices are no whole number of triangles", p_surface.indices.size());
	}
	for (const size_t count : { p_surface.normals.size(), p_surface.tangents.size(), p_surface.uvs.size(), p_surface.uv2s.size(), p_surface.colors.size() }) {
		if (count != 0 && count != vertices) {
			return fmt::format("an attribute has {} values for {} positions", count, vertices);
		}
	}
	for (size_t i = 0; i < vertices; i++) {
		if (!is_finite(p_surface.positions[i])) {
			return fmt::format("position {} is not finite", i);
		}
	}
	const uint32_t largest = *std::max_element(p_surface.indices.begin(), p_surface.indices.end());
	if (largest >= vertices) {
		return fmt::format("index {} is out of range, the surface has {} vertices", largest, vertices);
	}
	return "";
}
} // namespace

MeshRid RenderingServer::mesh_create() {
	Mesh mesh;
	mesh.version = impl->next_version();
	return impl->scene.meshes.make(std::move(mesh));
}

void RenderingServer::mesh_clear(MeshRid p_mesh) {
	Mesh *mesh = impl->scene.meshes.get(p_mesh);
	ERR_FAIL_COND_MSG(mesh == nullptr, "no such mesh");
	const AABB old = mesh->aabb;
	*mesh = Mesh();
	mesh->version = impl->next_version();
	impl->mark_mesh_users(p_mesh, old);
}

void RenderingServer::mesh_add_surface(MeshRid p_mesh, MeshSurface p_surface) {
	Mesh *mesh = impl->scene.meshes.get(p_mesh);
	ERR_FAIL_COND_MSG(mesh == nullptr, "no such mesh");
	const std::string problem = check_surface(p_surface);
	ERR_FAIL_COND_MSG(!problem.empty(), "{}", problem);
	const AABB old = mesh->aabb;
	for (const Vector3 &position : p_surface.positions) {
		mesh->aabb.expand_to(position);
	}
	mesh->surfaces.push_back(std::make_shared<const MeshSurface>(std::move(p_surface)));
	mesh->version = impl->next_version();
	impl->mark_mesh_users(p_mesh, old);
}

void RenderingServer::mesh_surface_set_material(MeshRid p_mesh, uint32_t p_surface, MaterialRid p_material) {
	Mesh *mesh = impl->scene.meshes.get(p_mesh);
	ERR_FAIL_COND_MSG(mesh == nullptr, "no such mesh");
	ERR_FAIL_COND_MSG(p_surface >= mesh->surfaces.size(), "surface {} of {}", p_surface, mesh->surfaces.size());
	ERR_FAIL_COND_MSG(p_material.is_valid() && impl->scene.materials.get(p_material) == nullptr, "no such material");
	MeshSurface surface = *mesh->surfaces[p_surface];
	surface.material = p_material;
	mesh->surfaces[p_surface] = std::make_shared<const MeshSurface>(std::move(surface));
	mesh->version = impl->next_version();
	impl->mark_mesh_users(p_mesh, mesh->aabb);
}

AABB RenderingServer::mesh_get_aabb(MeshRid p_mesh) const {
	const Mesh *mesh = impl->scene.meshes.get(p_mesh);
	ERR_FAIL_COND_V_MSG(mesh == nullptr, AABB(), "no such mesh");
	return mesh->aabb;
}

} // namespace lucent
