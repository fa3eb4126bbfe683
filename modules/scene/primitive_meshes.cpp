// SPDX-License-Identifier: MIT
#include "modules/scene/primitive_meshes.h"

#include "servers/core/class_builder.h"

#include <algorithm>
#include <utility>

namespace lucent::scene {

std::shared_ptr<const MeshSurface> PrimitiveMesh::surface_get_arrays(int p_surface) const {
	if (p_surface != 0) {
		return nullptr;
	}
	if (!surface) {
		MeshSurface arrays = create_surface();
		if (flip_faces) {
			for (Vector3 &normal : arrays.normals) {
				normal = -normal;
			}
			for (size_t i = 0; i + 2 < arrays.indices.size(); i += 3) {
				std::swap(arrays.indices[i + 1], arrays.indices[i + 2]);
			}
		}
		surface = std::make_shared<const MeshSurface>(std::move(arrays));
	}
	return surface;
}

void PrimitiveMesh::surface_set_material(int p_surface, const Ref<Material> &p_material) {
	if (p_surface == 0 && material != p_material) {
		material = p_material;
		ServerResource::state_changed();
	}
}

void PrimitiveMesh::set_flip_faces(bool p_flip) {
	flip_faces = p_flip;
	state_changed();
}

void PrimitiveMesh::state_changed() {
	surface.reset();
	geometry_changed();
}

void CapsuleMesh::set_radius(float p_radius) {
	state.radius = p_radius;
	state.height = std::max(state.height, 2.0f * p_radius);
	state_changed();
}

void CapsuleMesh::set_height(float p_height) {
	state.height = p_height;
	state.radius = std::min(state.radius, 0.5f * p_height);
	state_changed();
}

void PrimitiveMesh::bind(ClassBuilder<PrimitiveMesh> &r_class) {
	r_class.doc("Base of the shapes: one surface, made from a few numbers.");
	r_class.property("material", &PrimitiveMesh::set_material, &PrimitiveMesh::get_material).doc("The material of the surface.");
	r_class.property("flip_faces", &PrimitiveMesh::set_flip_faces, &PrimitiveMesh::get_flip_faces).doc("Turns the shape inside out.");
}

// Up to 2,048 cuts and 1,024 segments a way keep a mistyped number from filling the memory.
static constexpr int MAX_CUTS = 2048;
static constexpr int MAX_SEGMENTS = 1024;

void BoxMesh::bind(ClassBuilder<BoxMesh> &r_class) {
	r_class.doc("A box around the origin.");
	r_class.field("size", &BoxMesh::state, &State::size).doc("Lengths of the edges, in metres.");
	r_class.field("subdivide_width", &BoxMesh::state, &State::subdivide_width).range(0, MAX_CUTS, 1).enforced().doc("Cuts along x.");
	r_class.field("subdivide_height", &BoxMesh::state, &State::subdivide_height).range(0, MAX_CUTS, 1).enforced().doc("Cuts along y.");
	r_class.field("subdivide_depth", &BoxMesh::state, &State::subdivide_depth).range(0, MAX_CUTS, 1).enforced().doc("Cuts along z.");
}

void SphereMesh::bind(ClassBuilder<SphereMesh> &r_class) {
	r_class.doc("A sphere, an ellipsoid of revolution, or the upper half of one, around the origin.");
	r_class.field("radius", &SphereMesh::state, &State::radius).range(0.001, 100, 0.001).or_greater().enforced().doc("Radius around the y axis, in metres.");
	r_class.field("height", &SphereMesh::state, &State::height).range(0.001, 100, 0.001).or_greater().enforced().doc("Full height, in metres; twice the radius is a sphere.");
	r_class.field("radial_segments", &SphereMesh::state, &State::radial_segments).range(4, MAX_SEGMENTS, 1).enforced().doc("Segments around the y axis.");
	r_class.field("rings", &SphereMesh::state, &State::rings).range(1, MAX_SEGMENTS, 1).enforced().doc("Rings between the poles.");
	r_class.field("is_hemisphere", &SphereMesh::state, &State::is_hemisphere).doc("Only the upper half, with a floor; height is then that half's.");
}

void PlaneMesh::bind(ClassBuilder<PlaneMesh> &r_class) {
	r_class.doc("A flat rectangle, seen from one side.");
	r_class.enumeration("Orientation", { { "FACE_X", Orientation::FACE_X }, { "FACE_Y", Orientation::FACE_Y }, { "FACE_Z", Orientation::FACE_Z } });
	r_class.field("size", &PlaneMesh::state, &State::size).doc("Lengths of the edges, in metres.");
	r_class.field("subdivide_width", &PlaneMesh::state, &State::subdivide_width).range(0, MAX_CUTS, 1).enforced().doc("Cuts along the first edge.");
	r_class.field("subdivide_depth", &PlaneMesh::state, &State::subdivide_depth).range(0, MAX_CUTS, 1).enforced().doc("Cuts along the second edge.");
	r_class.field("center_offset", &PlaneMesh::state, &State::center_offset).doc("Where the middle is.");
	r_class.field("orientation", &PlaneMesh::state, &State::orientation).enum_of("Orientation").doc("The axis that the front faces.");
}

void QuadMesh::bind(ClassBuilder<QuadMesh> &r_class) {
	r_class.doc("A PlaneMesh that faces z and is a metre wide.");
}

void CylinderMesh::bind(ClassBuilder<CylinderMesh> &r_class) {
	r_class.doc("A cylinder, a cone or a part of one, around the y axis.");
	r_class.field("top_radius", &CylinderMesh::state, &State::top_radius).range(0, 100, 0.001).or_greater().doc("Radius at the top, in metres; 0 makes a cone.");
	r_class.field("bottom_radius", &CylinderMesh::state, &State::bottom_radius).range(0, 100, 0.001).or_greater().doc("Radius at the bottom, in metres.");
	r_class.field("height", &CylinderMesh::state, &State::height).range(0.001, 100, 0.001).or_greater().enforced().doc("Full height, in metres.");
	r_class.field("radial_segments", &CylinderMesh::state, &State::radial_segments).range(4, MAX_SEGMENTS, 1).enforced().doc("Segments around the y axis.");
	r_class.field("rings", &CylinderMesh::state, &State::rings).range(0, MAX_SEGMENTS, 1).enforced().doc("Rings between top and bottom.");
	r_class.field("cap_top", &CylinderMesh::state, &State::cap_top).doc("Whether the top is closed.");
	r_class.field("cap_bottom", &CylinderMesh::state, &State::cap_bottom).doc("Whether the bottom is closed.");
}

void CapsuleMesh::bind(ClassBuilder<CapsuleMesh> &r_class) {
	r_class.doc("A cylinder with round ends, around the y axis.");
	r_class.property("radius", &CapsuleMesh::set_radius, &CapsuleMesh::get_radius).range(0.001, 100, 0.001).or_greater().enforced().doc("Radius, in metres; raises the height to at least twice itself.");
	r_class.property("height", &CapsuleMesh::set_height, &CapsuleMesh::get_height).range(0.001, 100, 0.001).or_greater().enforced().doc("Full height with both ends, in metres; lowers the radius to at most half of itself.");
	r_class.field("radial_segments", &CapsuleMesh::state, &State::radial_segments).range(4, MAX_SEGMENTS, 1).enforced().doc("Segments around the y axis.");
	r_class.field("rings", &CapsuleMesh::state, &State::rings).range(0, MAX_SEGMENTS, 1).enforced().doc("Rings of each end and of the middle.");
}

void PrismMesh::bind(ClassBuilder<PrismMesh> &r_class) {
	r_class.doc("A triangle in x and y, drawn out along z.");
	r_class.field("left_to_right", &PrismMesh::state, &State::left_to_right).range(-2, 2, 0.1).doc("Where the ridge is along x: 0 is left, 1 is right.");
	r_class.field("size", &PrismMesh::state, &State::size).doc("Lengths of the box around it, in metres.");
	r_class.field("subdivide_width", &PrismMesh::state, &State::subdivide_width).range(0, MAX_CUTS, 1).enforced().doc("Cuts along x.");
	r_class.field("subdivide_height", &PrismMesh::state, &State::subdivide_height).range(0, MAX_CUTS, 1).enforced().doc("Cuts along y.");
	r_class.field("subdivide_depth", &PrismMesh::state, &State::subdivide_depth).range(0, MAX_CUTS, 1).enforced().doc("Cuts along z.");
}

void TorusMesh::bind(ClassBuilder<TorusMesh> &r_class) {
	r_class.doc("A ring around the y axis.");
	r_class.field("inner_radius", &TorusMesh::state, &State::inner_radius).range(0.001, 1000, 0.001).or_greater().enforced().doc("From the axis to the near side of the tube, in metres.");
	r_class.field("outer_radius", &TorusMesh::state, &State::outer_radius).range(0.001, 1000, 0.001).or_greater().enforced().doc("From the axis to the far side of the tube, in metres.");
	r_class.field("rings", &TorusMesh::state, &State::rings).range(3, MAX_SEGMENTS, 1).enforced().doc("Segments around the axis.");
	r_class.field("ring_segments", &TorusMesh::state, &State::ring_segments).range(3, MAX_SEGMENTS, 1).enforced().doc("Segments around the tube.");
}

} // namespace lucent::scene
