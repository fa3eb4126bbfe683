// SPDX-License-Identifier: MIT
#pragma once
// Godot's shapes: same properties, texture coordinates and tangents. Counter-clockwise triangles face outwards.

#include "modules/scene/mesh.h"

namespace lucent::scene {

class PrimitiveMesh : public Mesh {
	LUCENT_CLASS(PrimitiveMesh, Mesh)
public:
	int get_surface_count() const override { return 1; }
	std::shared_ptr<const MeshSurface> surface_get_arrays(int p_surface) const override;
	Ref<Material> surface_get_material(int p_surface) const override { return p_surface == 0 ? material : nullptr; }
	void surface_set_material(int p_surface, const Ref<Material> &p_material) override;
	void set_material(const Ref<Material> &p_material) { surface_set_material(0, p_material); }
	Ref<Material> get_material() const { return material; }
	void set_flip_faces(bool p_flip);
	bool get_flip_faces() const { return flip_faces; }
	// After a change of the shape's parameters.
	void state_changed();

protected:
	virtual MeshSurface create_surface() const { return {}; }

private:
	Ref<Material> material;
	bool flip_faces = false;
	mutable std::shared_ptr<const MeshSurface> surface; // null: to be made
};

class BoxMesh : public PrimitiveMesh {
	LUCENT_CLASS(BoxMesh, PrimitiveMesh)
public:
	struct State {
		Vector3 size{ 1.0f };
		int subdivide_width = 0;
		int subdivide_height = 0;
		int subdivide_depth = 0;
	} state;

protected:
	MeshSurface create_surface() const override;
};

class SphereMesh : public PrimitiveMesh {
	LUCENT_CLASS(SphereMesh, PrimitiveMesh)
public:
	struct State {
		float radius = 0.5f;
		float height = 1.0f;
		int radial_segments = 64;
		int rings = 32;
		bool is_hemisphere = false;
	} state;

protected:
	MeshSurface create_surface() const override;
};

class PlaneMesh : public PrimitiveMesh {
	LUCENT_CLASS(PlaneMesh, PrimitiveMesh)
public:
	enum class Orientation : uint8_t {
		FACE_X,
		FACE_Y,
		FACE_Z
	};
	struct State {
		Vector2 size{ 2.0f };
		int subdivide_width = 0;
		int subdivide_depth = 0;
		Vector3 center_offset{ 0.0f };
		Orientation orientation = Orientation::FACE_Y;
	} state;

protected:
	MeshSurface create_surface() const override;
};

class QuadMesh : public PlaneMesh {
	LUCENT_CLASS(QuadMesh, PlaneMesh)
public:
	QuadMesh() {
		state.size = Vector2(1.0f);
		state.orientation = Orientation::FACE_Z;
	}
};

class CylinderMesh : public PrimitiveMesh {
	LUCENT_CLASS(CylinderMesh, PrimitiveMesh)
public:
	struct State {
		float top_radius = 0.5f;
		float bottom_radius = 0.5f;
		float height = 2.0f;
		int radial_segments = 64;
		int rings = 4;
		bool cap_top = true;
		bool cap_bottom = true;
	} state;

protected:
	MeshSurface create_surface() const override;
};

// The height holds both round ends: a radius above half of it raises it, a height below twice the radius lowers the radius.
class CapsuleMesh : public PrimitiveMesh {
	LUCENT_CLASS(CapsuleMesh, PrimitiveMesh)
public:
	struct State {
		float radius = 0.5f;
		float height = 2.0f;
		int radial_segments = 64;
		int rings = 8;
	} state;
	void set_radius(float p_radius);
	float get_radius() const { return state.radius; }
	void set_height(float p_height);
	float get_height() const { return state.height; }

protected:
	MeshSurface create_surface() const override;
};

class PrismMesh : public PrimitiveMesh {
	LUCENT_CLASS(PrismMesh, PrimitiveMesh)
public:
	struct State {
		float left_to_right = 0.5f; // where the ridge is, along x
		Vector3 size{ 1.0f };
		int subdivide_width = 0;
		int subdivide_height = 0;
		int subdivide_depth = 0;
	} state;

protected:
	MeshSurface create_surface() const override;
};

class TorusMesh : public PrimitiveMesh {
	LUCENT_CLASS(TorusMesh, PrimitiveMesh)
public:
	struct State {
		float inner_radius = 0.5f;
		float outer_radius = 1.0f;
		int rings = 64; // around the axis
		int ring_segments = 32; // around the tube
	} state;

protected:
	MeshSurface create_surface() const override;
};

} // namespace lucent::scene
