// SPDX-License-Identifier: MIT
#include "modules/scene/mesh.h"

#include "servers/core/class_builder.h"

#include <cstdio>

namespace lucent::scene {

AABB Mesh::get_aabb() const {
	AABB box;
	for (int i = 0; i < get_surface_count(); i++) {
		for (const Vector3 &position : surface_get_arrays(i)->positions) {
			box.expand_to(position);
		}
	}
	return box;
}

MeshRid Mesh::get_rid(SceneContext &p_context) {
	return attach(p_context) ? rid : MeshRid();
}

void Mesh::geometry_changed() {
	geometry_sent = false;
	state_changed();
}

void Mesh::send(SceneContext &p_context) {
	RenderingServer &server = p_context.server();
	if (!rid.is_valid()) {
		rid = server.mesh_create();
	} else if (!geometry_sent) {
		server.mesh_clear(rid);
	}
	for (int i = 0; i < get_surface_count(); i++) {
		const std::shared_ptr<const MeshSurface> arrays = surface_get_arrays(i);
		if (arrays->indices.empty()) {
			continue; // a shape of size 0
		}
		const Ref<Material> material = surface_get_material(i);
		const MaterialRid material_rid = material ? material->get_rid(p_context) : MaterialRid();
		if (geometry_sent) {
			server.mesh_surface_set_material(rid, uint32_t(i), material_rid);
		} else {
			MeshSurface surface = *arrays;
			surface.material = material_rid;
			server.mesh_add_surface(rid, std::move(surface));
		}
	}
	geometry_sent = true;
}

void Mesh::free_server_objects(RenderingServer &p_server) {
	p_server.free(rid);
	rid = {};
	geometry_sent = false;
}

std::shared_ptr<const MeshSurface> ArrayMesh::surface_get_arrays(int p_surface) const {
	return p_surface >= 0 && p_surface < get_surface_count() ? surfaces[size_t(p_surface)].arrays : nullptr;
}

Ref<Material> ArrayMesh::surface_get_material(int p_surface) const {
	return p_surface >= 0 && p_surface < get_surface_count() ? surfaces[size_t(p_surface)].material : nullptr;
}

void ArrayMesh::surface_set_material(int p_surface, const Ref<Material> &p_material) {
	ERR_FAIL_COND_MSG(p_surface < 0 || p_surface >= get_surface_count(), "surface {} of {}", p_surface, get_surface_count());
	surfaces[size_t(p_surface)].material = p_material;
	state_changed();
}

std::string ArrayMesh::surface_get_name(int p_surface) const {
	return p_surface >= 0 && p_surface < get_surface_count() ? surfaces[size_t(p_surface)].name : std::string();
}

void ArrayMesh::add_surface(MeshSurface p_arrays, Ref<Material> p_material, std::string p_name) {
	ERR_FAIL_COND_MSG(p_arrays.positions.empty() || p_arrays.indices.empty() || p_arrays.indices.size() % 3 != 0, "a surface needs positions and whole triangles");
	surfaces.push_back({ std::make_shared<const MeshSurface>(std::move(p_arrays)), std::move(p_material), std::move(p_name) });
	geometry_changed();
}

void ArrayMesh::clear_surfaces() {
	surfaces.clear();
	geometry_changed();
}

// The N of "surface_N/material", or -1.
static int material_surface(const std::string &p_name) {
	int surface = -1;
	int length = 0;
	const bool matches = std::sscanf(p_name.c_str(), "surface_%d/material%n", &surface, &length) == 1 && size_t(length) == p_name.size();
	return matches ? surface : -1;
}

bool ArrayMesh::_set(const std::string &p_name, const Variant &p_value) {
	const int surface = material_surface(p_name);
	const std::optional<Ref<Material>> material = variant_cast<Ref<Material>>(p_value);
	if (surface < 0 || surface >= get_surface_count() || !material) {
		return false;
	}
	surface_set_material(surface, *material);
	return true;
}

bool ArrayMesh::_get(const std::string &p_name, Variant &r_value) const {
	const int surface = material_surface(p_name);
	if (surface < 0 || surface >= get_surface_count()) {
		return false;
	}
	r_value = surfaces[size_t(surface)].material;
	return true;
}

void ArrayMesh::_get_property_list(std::vector<PropertyInfo> &r_list) const {
	for (int i = 0; i < get_surface_count(); i++) {
		PropertyInfo property;
		property.name = fmt::format("surface_{}/material", i);
		property.type = Variant::Type::OBJECT;
		property.class_name = "Material";
		property.hint = PropertyHint::RESOURCE_TYPE;
		r_list.push_back(std::move(property));
	}
}

void Mesh::bind(ClassBuilder<Mesh> &r_class) {
	r_class.doc("Triangles in surfaces, each with a material.");
	r_class.method("get_surface_count", &Mesh::get_surface_count).doc("How many surfaces there are.");
	r_class.method("surface_get_material", &Mesh::surface_get_material, { "surf_idx" }).doc("The material of one surface, or null.");
	r_class.method("surface_set_material", &Mesh::surface_set_material, { "surf_idx", "material" }).doc("Gives one surface a material.");
	r_class.enumeration("PrimitiveType", { { "PRIMITIVE_TRIANGLES", 3, "Three vertices a triangle." } });
	r_class.enumeration("ArrayType", { { "ARRAY_VERTEX", MeshArray::VERTEX, "Positions, in metres." }, { "ARRAY_NORMAL", MeshArray::NORMAL, "Unit normals." }, { "ARRAY_TANGENT", MeshArray::TANGENT, "Tangents, 4 floats a vertex; the last is the bitangent's sign." }, { "ARRAY_COLOR", MeshArray::COLOR, "Linear colours." }, { "ARRAY_TEX_UV", MeshArray::TEX_UV, "Texture coordinates." }, { "ARRAY_TEX_UV2", MeshArray::TEX_UV2, "The second texture coordinates." }, { "ARRAY_INDEX", MeshArray::INDEX, "Vertices of the triangles." }, { "ARRAY_MAX", MeshArray::COUNT, "How many arrays a surface has." } });
	r_class.method(
				   "surface_get_arrays", +[](const Mesh &p_mesh, int p_surface) -> Result<Array> {
					   const std::shared_ptr<const MeshSurface> surface = p_mesh.surface_get_arrays(p_surface);
					   return surface ? Result<Array>(arrays_from_surface(*surface)) : Result<Array>(make_error("Mesh.surface_get_arrays(): there is no surface {}", p_surface)); }, { "surf_idx" })
			.doc("The arrays of a surface by ArrayType, null where there are none.");
	r_class.method("get_aabb", &Mesh::get_aabb).doc("The box around all vertices, in the mesh's own space.");
}

void ArrayMesh::bind(ClassBuilder<ArrayMesh> &r_class) {
	r_class.doc("A mesh of given triangles, as files have them.");
	r_class.method("add_surface_from_arrays", &ArrayMesh::add_surface_from_arrays, { "primitive", "arrays" }).argument_class(0, "Mesh.PrimitiveType").doc("Adds a surface of arrays by Mesh.ArrayType, null where there are none. Without indices three vertices are a triangle; counter-clockwise is the front.");
	r_class.method("surface_remove", &ArrayMesh::surface_remove, { "surf_idx" }).doc("Removes a surface.");
	r_class.method(
				   "surface_get_array_len", +[](const ArrayMesh &p_mesh, int p_surface) {
					   const std::shared_ptr<const MeshSurface> surface = p_mesh.surface_get_arrays(p_surface);
					   return surface ? int64_t(surface->positions.size()) : int64_t(0); }, { "surf_idx" })
			.doc("How many vertices a surface has.");
	r_class.method(
				   "surface_get_array_index_len", +[](const ArrayMesh &p_mesh, int p_surface) {
					   const std::shared_ptr<const MeshSurface> surface = p_mesh.surface_get_arrays(p_surface);
					   return surface ? int64_t(surface->indices.size()) : int64_t(0); }, { "surf_idx" })
			.doc("How many indices a surface has.");
	r_class.method("clear_surfaces", &ArrayMesh::clear_surfaces).doc("Removes all surfaces.");
	r_class.method("surface_get_name", &ArrayMesh::surface_get_name, { "surf_idx" }).doc("The name of one surface.");
}

} // namespace lucent::scene
