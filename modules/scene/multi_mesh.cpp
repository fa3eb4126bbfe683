// SPDX-License-Identifier: MIT
#include "modules/scene/multi_mesh.h"

#include "modules/scene/scene_tree.h"
#include "servers/core/class_builder.h"

#include <algorithm>

namespace lucent::scene {

std::vector<PlacedMesh> MultiMesh::get_placed() const {
	const bool is_3d = state.transform_format == TransformFormat::TRANSFORM_3D;
	const size_t stride = (is_3d ? 12u : 8u) + (state.use_colors ? 4u : 0u) + (state.use_custom_data ? 4u : 0u);
	const size_t wanted = size_t(std::max(state.visible_instance_count < 0 ? state.instance_count : std::min(state.visible_instance_count, state.instance_count), 0));
	std::vector<PlacedMesh> placed;
	for (size_t i = 0; state.mesh && i < wanted && (i + 1) * stride <= state.buffer.size(); i++) {
		const float *m = &state.buffer[i * stride];
		Transform3D place;
		if (is_3d) {
			place = { Basis(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]), Vector3(m[3], m[7], m[11]) };
		} else { // x and y of a plane at z = 0; the third number of a row is padding
			place = { Basis(m[0], m[4], 0.0f, m[1], m[5], 0.0f, 0.0f, 0.0f, 1.0f), Vector3(m[3], m[7], 0.0f) };
		}
		placed.push_back({ place, state.mesh });
	}
	return placed;
}

void MultiMeshInstance3D::set_multimesh(const Ref<MultiMesh> &p_multimesh) {
	if (multimesh) {
		multimesh->disconnect(connection);
	}
	multimesh = p_multimesh;
	if (multimesh) {
		connection = multimesh->connect(
				"changed", [this](const Array &) { rebuild(); }, this);
	}
	rebuild();
}

AABB MultiMeshInstance3D::get_aabb() const {
	AABB bounds;
	for (const PlacedMesh &placed : multimesh ? multimesh->get_placed() : std::vector<PlacedMesh>()) {
		if (const AABB box = placed.mesh->get_aabb(); !box.is_empty()) {
			bounds.merge_with(box.xform(placed.transform));
		}
	}
	return bounds;
}

void MultiMeshInstance3D::rebuild() {
	if (!get_context()) {
		return;
	}
	InstanceLook look{ {}, get_cast_shadow(), get_gi_mode(), get_transparency(), get_layer_mask() };
	if (get_material_override()) {
		look.material_override = get_material_override()->get_rid(*get_context());
	}
	group.enter(*this, multimesh ? multimesh->get_placed() : std::vector<PlacedMesh>(), look);
	group.set_visible(is_shown());
}

void MultiMeshInstance3D::_notification(int p_what) {
	if (p_what == NOTIFICATION_EXIT_WORLD) {
		group.leave();
	}
	GeometryInstance3D::_notification(p_what);
	switch (p_what) {
		case NOTIFICATION_ENTER_WORLD:
			rebuild();
			break;
		case NOTIFICATION_TRANSFORM_CHANGED:
			group.set_transform(get_global_transform());
			break;
		case NOTIFICATION_VISIBILITY_CHANGED:
			group.set_visible(is_shown());
			break;
	}
}

void MultiMesh::bind(ClassBuilder<MultiMesh> &r_class) {
	constexpr auto S = &MultiMesh::state;
	r_class.doc("One mesh in many places.");
	r_class.enumeration("TransformFormat", { { "TRANSFORM_2D", TransformFormat::TRANSFORM_2D }, { "TRANSFORM_3D", TransformFormat::TRANSFORM_3D } });
	r_class.field("transform_format", S, &State::transform_format).enum_of("TransformFormat").doc("Whether places are of a plane or of space.");
	r_class.field("use_colors", S, &State::use_colors).doc("Whether the buffer has a colour for each instance; it is not shown.");
	r_class.field("use_custom_data", S, &State::use_custom_data).doc("Whether the buffer has four more numbers for each instance.");
	r_class.field("instance_count", S, &State::instance_count).range(0, MAX_INSTANCES, 1).enforced().doc("How many instances there are.");
	r_class.field("visible_instance_count", S, &State::visible_instance_count).range(-1, MAX_INSTANCES, 1).enforced().doc("How many of them show; -1 is all.");
	r_class.field("mesh", S, &State::mesh).doc("The mesh.");
	r_class.field("buffer", S, &State::buffer).doc("The instances' places, row by row, with their colours and numbers.");
}

void MultiMeshInstance3D::bind(ClassBuilder<MultiMeshInstance3D> &r_class) {
	r_class.doc("Shows a MultiMesh.");
	r_class.property("multimesh", &MultiMeshInstance3D::set_multimesh, &MultiMeshInstance3D::get_multimesh).doc("The mesh and its places.");
}

} // namespace lucent::scene
