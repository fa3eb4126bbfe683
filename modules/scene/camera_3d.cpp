// SPDX-License-Identifier: MIT
#include "modules/scene/camera_3d.h"

#include "modules/scene/scene_tree.h"
#include "modules/scene/viewport.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

void Camera3D::_notification(int p_what) {
	Node3D::_notification(p_what);
	switch (p_what) {
		case NOTIFICATION_ENTER_WORLD:
			if (get_tree()->get_context() && is_in_tree_world(*this)) {
				rid = get_tree()->get_context()->server().camera_create();
				state_changed();
			}
			if (!find_viewport(*this)) {
				get_tree()->camera_entered(this);
			}
			break;
		case NOTIFICATION_EXIT_WORLD:
			current = is_current();
			get_tree()->camera_left(this);
			if (rid.is_valid()) {
				get_tree()->get_context()->server().free(rid);
				rid = {};
			}
			break;
		case NOTIFICATION_TRANSFORM_CHANGED:
			if (rid.is_valid()) {
				get_tree()->get_context()->server().camera_set_transform(rid, get_camera_transform());
			}
			break;
	}
}

void Camera3D::state_changed() {
	if (rid.is_valid()) {
		SceneContext &context = *get_tree()->get_context();
		lucent::Camera camera = parameters;
		camera.transform = get_camera_transform();
		camera.environment = environment ? environment->get_rid(context) : EnvironmentRid();
		context.server().camera_set(rid, camera);
	}
}

Transform3D Camera3D::get_camera_transform() const {
	const Transform3D &place = get_global_transform();
	const Basis rotation = decompose_basis(place.basis).rotation;
	return { rotation, place.origin + rotation[0] * offset.horizontal + rotation[1] * offset.vertical };
}

void Camera3D::set_current(bool p_current) {
	current = p_current;
	if (!is_inside_tree() || find_viewport(*this)) {
		return;
	}
	if (p_current) {
		get_tree()->set_camera(this);
	} else if (get_tree()->get_camera_3d() == this) {
		get_tree()->set_camera(nullptr);
	}
}

bool Camera3D::is_current() const {
	return is_inside_tree() && !find_viewport(*this) ? get_tree()->get_camera_3d() == this : current;
}

void Camera3D::set_environment(const Ref<Environment> &p_environment) {
	const Ref<Environment> old = std::exchange(environment, p_environment);
	state_changed();
}

void Camera3D::set_keep_aspect(KeepAspect p_mode) {
	parameters.keep_height = p_mode == KeepAspect::HEIGHT;
	state_changed();
}

void Camera3D::bind(ClassBuilder<Camera3D> &r_class) {
	constexpr auto P = &Camera3D::parameters;
	using Camera = lucent::Camera;
	r_class.doc("Looks along its -z.");
	r_class.enumeration("ProjectionType", { { "PROJECTION_PERSPECTIVE", Camera::Kind::PERSPECTIVE }, { "PROJECTION_ORTHOGONAL", Camera::Kind::ORTHOGONAL }, { "PROJECTION_FRUSTUM", Camera::Kind::FRUSTUM } });
	r_class.enumeration("KeepAspect", { { "KEEP_WIDTH", KeepAspect::WIDTH }, { "KEEP_HEIGHT", KeepAspect::HEIGHT } });
	r_class.property("keep_aspect", &Camera3D::set_keep_aspect, &Camera3D::get_keep_aspect).enum_of("KeepAspect").doc("Whether fov and size are the picture's width or height.");
	r_class.field("cull_mask", P, &Camera::cull_mask).doc("The layers that are drawn, as bits.");
	r_class.property("environment", &Camera3D::set_environment, &Camera3D::get_environment).doc("In place of the scene's, for this camera.");
	r_class.field("h_offset", &Camera3D::offset, &Offset::horizontal).doc("Moves the eye to the right, in metres.");
	r_class.field("v_offset", &Camera3D::offset, &Offset::vertical).doc("Moves the eye up, in metres.");
	r_class.field("projection", P, &Camera::kind).enum_of("ProjectionType").doc("The kind of projection.");
	r_class.property("current", &Camera3D::set_current, &Camera3D::is_current).doc("Whether this camera shows.");
	r_class.field("fov", P, &Camera::fov_degrees).range(1, 179, 0.1).enforced().doc("The angle of view, in degrees.");
	r_class.field("size", P, &Camera::size_m).range(1e-6, 100, 1e-6).or_greater().enforced().doc("Size of an orthogonal view, or of a frustum's near plane, in metres.");
	r_class.field("frustum_offset", P, &Camera::frustum_offset).doc("Moves a frustum's near plane, in metres.");
	r_class.field("near", P, &Camera::near_m).range(1e-7, 10, 1e-7).or_greater().enforced().doc("The nearest that is drawn, in metres.");
	r_class.field("far", P, &Camera::far_m).range(1e-6, 4000, 1e-6).or_greater().enforced().doc("The farthest that is drawn, in metres.");
	r_class.method("make_current", &Camera3D::make_current).doc("Lets this camera show.");
	r_class.method("get_camera_transform", &Camera3D::get_camera_transform).doc("The eye's place in the world, offsets included.");
}

} // namespace lucent::scene
