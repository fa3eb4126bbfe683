// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/material.h"

#include <memory>
#include <string>
#include <vector>

namespace lucent::scene {

// Triangles in surfaces, each with a material.
class Mesh : public ServerResource {
	LUCENT_CLASS(Mesh, Resource)
public:
	~Mesh() override { leave_context(); }

	virtual int get_surface_count() const { return 0; }
	// Null: no such surface. MeshSurface::material is not set here; see surface_get_material.
	virtual std::shared_ptr<const MeshSurface> surface_get_arrays(int) const { return nullptr; }
	virtual Ref<Material> surface_get_material(int) const { return nullptr; }
	virtual void surface_set_material(int, const Ref<Material> &) {}
	AABB get_aabb() const; // local; empty without vertices
	MeshRid get_rid(SceneContext &p_context);

protected:
	// Vertices changed; a change of materials alone is cheaper.
	void geometry_changed();
	void send(SceneContext &p_context) override;
	void free_server_objects(RenderingServer &p_server) override;

private:
	MeshRid rid;
	bool geometry_sent = false;
};

// Godot's Mesh.ArrayType.
enum class MeshArray : uint8_t {
	VERTEX,
	NORMAL,
	TANGENT,
	COLOR,
	TEX_UV,
	TEX_UV2,
	INDEX = 12,
	COUNT,
};
// A wrong type, length or index is an error that says which.
Result<MeshSurface> surface_from_arrays(const Array &p_arrays);
Array arrays_from_surface(const MeshSurface &p_surface);
// What RenderingServer would refuse: lengths, indices, values that aren't finite. p_name stands for the mesh in the message.
Status check_surface(const MeshSurface &p_surface, const std::string &p_name);

// A mesh of given triangles.
class ArrayMesh : public Mesh {
	LUCENT_CLASS(ArrayMesh, Mesh)
public:
	int get_surface_count() const override { return int(surfaces.size()); }
	std::shared_ptr<const MeshSurface> surface_get_arrays(int p_surface) const override;
	Ref<Material> surface_get_material(int p_surface) const override;
	void surface_set_material(int p_surface, const Ref<Material> &p_material) override;
	void add_surface(MeshSurface p_arrays, Ref<Material> p_material = nullptr, std::string p_name = "");
	// Godot's form: arrays by Mesh.ArrayType, null where there are none; three vertices a triangle where there is no index.
	Status add_surface_from_arrays(int p_primitive, const Array &p_arrays);
	void clear_surfaces();
	void surface_remove(int p_surface);
	std::string surface_get_name(int p_surface) const;

	// surface_N/material
	bool _set(const std::string &p_name, const Variant &p_value) override;
	bool _get(const std::string &p_name, Variant &r_value) const override;
	void _get_property_list(std::vector<PropertyInfo> &r_list) const override;

private:
	struct Surface {
		std::shared_ptr<const MeshSurface> arrays;
		Ref<Material> material;
		std::string name;
	};
	std::vector<Surface> surfaces;
};

} // namespace lucent::scene
