// SPDX-License-Identifier: MIT
#include "modules/scene/node_3d.h"

#include "modules/scene/scene_tree.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

Node3D *Node3D::get_parent_node_3d() const {
	return top_level ? nullptr : dynamic_cast<Node3D *>(get_parent());
}

void Node3D::set_transform(const Transform3D &p_transform) {
	local = p_transform;
	euler_dirty = true;
	propagate_transform_changed();
}

const Transform3D &Node3D::get_global_transform() const {
	if (global_dirty) {
		const Node3D *above = get_parent_node_3d();
		global = above ? above->get_global_transform() * local : local;
		global_dirty = false;
	}
	return global;
}

void Node3D::set_global_transform(const Transform3D &p_transform) {
	const Node3D *above = get_parent_node_3d();
	set_transform(above ? above->get_global_transform().affine_inverse() * p_transform : p_transform);
}

void Node3D::set_position(const Vector3 &p_position) {
	local.origin = p_position;
	propagate_transform_changed();
}

void Node3D::update_euler_and_scale() const {
	if (euler_dirty) {
		const RotationScale parts = decompose_basis(local.basis);
		euler = euler_from_basis(parts.rotation, rotation_order);
		scale = parts.scale;
		euler_dirty = false;
	}
}

void Node3D::local_changed() {
	local.basis = compose_basis(basis_from_euler(euler, rotation_order), scale);
	propagate_transform_changed();
}

void Node3D::set_rotation(const Vector3 &p_euler) {
	update_euler_and_scale();
	euler = p_euler;
	local_changed();
}

Vector3 Node3D::get_rotation() const {
	update_euler_and_scale();
	return euler;
}

void Node3D::set_rotation_degrees(const Vector3 &p_degrees) {
	set_rotation(glm::radians(p_degrees));
}

Vector3 Node3D::get_rotation_degrees() const {
	return glm::degrees(get_rotation());
}

void Node3D::set_rotation_order(EulerOrder p_order) {
	update_euler_and_scale();
	// The rotation stays; its angles are other ones.
	euler = euler_from_basis(basis_from_euler(euler, rotation_order), p_order);
	rotation_order = p_order;
}

void Node3D::set_scale(const Vector3 &p_scale) {
	update_euler_and_scale();
	scale = p_scale;
	local_changed();
}

Vector3 Node3D::get_scale() const {
	update_euler_and_scale();
	return scale;
}

void Node3D::set_basis(const Basis &p_basis) {
	set_transform({ p_basis, local.origin });
}

void Node3D::set_quaternion(const Quaternion &p_quaternion) {
	ERR_FAIL_COND_MSG(!(glm::length(p_quaternion) > 0.0f), "a rotation's quaternion is not 0");
	update_euler_and_scale();
	euler = euler_from_basis(glm::mat3_cast(glm::normalize(p_quaternion)), rotation_order);
	local_changed();
}

Quaternion Node3D::get_quaternion() const {
	return glm::quat_cast(decompose_basis(local.basis).rotation);
}

void Node3D::set_global_position(const Vector3 &p_position) {
	const Node3D *above = get_parent_node_3d();
	set_position(above ? above->get_global_transform().affine_inverse().xform(p_position) : p_position);
}

void Node3D::set_global_basis(const Basis &p_basis) {
	set_global_transform({ p_basis, get_global_position() });
}

void Node3D::set_global_rotation(const Vector3 &p_euler) {
	const Vector3 global_scale = decompose_basis(get_global_basis()).scale;
	set_global_basis(compose_basis(basis_from_euler(p_euler, rotation_order), global_scale));
}

Vector3 Node3D::get_global_rotation() const {
	return euler_from_basis(decompose_basis(get_global_basis()).rotation, rotation_order);
}

void Node3D::look_at(const Vector3 &p_target, const Vector3 &p_up) {
	const Vector3 origin = get_global_position();
	const Vector3 side = glm::cross(origin - p_target, p_up);
	ERR_FAIL_COND_MSG(!(glm::length(side) > 0.0f), "look_at: the target is at the node or straight along the up vector");
	const Vector3 back = glm::normalize(origin - p_target);
	const Vector3 right = glm::normalize(glm::cross(p_up, back));
	const Basis rotation(right, glm::cross(back, right), back);
	set_global_transform({ compose_basis(rotation, decompose_basis(get_global_basis()).scale), origin });
}

void Node3D::set_as_top_level(bool p_top_level) {
	if (top_level != p_top_level) {
		top_level = p_top_level;
		propagate_transform_changed();
	}
}

void Node3D::propagate_transform_changed() {
	global_dirty = true;
	if (notify_transform && !transform_queued && is_inside_tree()) {
		transform_queued = true;
		get_tree()->queue_transform(get_instance_id());
	}
	for (const auto &child : get_children()) {
		Node3D *below = dynamic_cast<Node3D *>(child.get());
		// Below a dirty node that has nothing to report everything is dirty already, but queued nodes may be further down.
		if (below && !below->top_level) {
			below->propagate_transform_changed();
		}
	}
}

void Node3D::send_transform_changed() {
	if (transform_queued) {
		transform_queued = false;
		notification(NOTIFICATION_TRANSFORM_CHANGED);
	}
}

bool Node3D::is_visible_in_tree() const {
	const Node3D *above = dynamic_cast<const Node3D *>(get_parent());
	return visible && (!above || above->is_visible_in_tree());
}

void Node3D::set_visible(bool p_visible) {
	if (visible != p_visible) {
		visible = p_visible;
		propagate_visibility_changed();
	}
}

void Node3D::propagate_visibility_changed() {
	notification(NOTIFICATION_VISIBILITY_CHANGED);
	emit_signal("visibility_changed");
	const ChildrenLock lock(*this);
	for (int i = 0; i < get_child_count(); i++) { // a handler may add children
		Node3D *below = dynamic_cast<Node3D *>(get_child(i));
		if (below && below->visible) {
			below->propagate_visibility_changed();
		}
	}
}

void Node3D::_notification(int p_what) {
	Node::_notification(p_what);
	switch (p_what) {
		case NOTIFICATION_ENTER_TREE:
			global_dirty = true;
			transform_queued = false;
			notification(NOTIFICATION_ENTER_WORLD);
			break;
		case NOTIFICATION_EXIT_TREE:
			notification(NOTIFICATION_EXIT_WORLD);
			break;
		case NOTIFICATION_PARENTED:
		case NOTIFICATION_UNPARENTED:
			propagate_transform_changed();
			break;
	}
}

static Basis rotated(const Vector3 &p_axis, float p_angle) {
	return glm::mat3_cast(glm::angleAxis(p_angle, glm::normalize(p_axis)));
}

// Godot's short ways to move, in terms of transforms.
static void bind_movement(ClassBuilder<Node3D> &r_class) {
	r_class.method("look_at", &Node3D::look_at, { "target", "up" }).defaults({ Vector3(0, 1, 0) }).doc("Turns the node's -z towards a point of the world.");
	r_class.method(
				   "look_at_from_position", +[](Node3D &r_node, const Vector3 &p_position, const Vector3 &p_target, const Vector3 &p_up) {
					   r_node.set_global_position(p_position);
					   r_node.look_at(p_target, p_up); }, { "position", "target", "up" })
			.defaults({ Vector3(0, 1, 0) })
			.doc("Puts the node somewhere in the world and turns its -z towards a point.");
	r_class.method(
				   "translate", +[](Node3D &r_node, const Vector3 &p_offset) { r_node.set_position(r_node.get_transform().xform(p_offset)); }, { "offset" })
			.doc("Moves the node along its own axes.");
	r_class.method(
				   "global_translate", +[](Node3D &r_node, const Vector3 &p_offset) { r_node.set_global_position(r_node.get_global_position() + p_offset); }, { "offset" })
			.doc("Moves the node along the world's axes.");
	r_class.method(
				   "rotate", +[](Node3D &r_node, const Vector3 &p_axis, float p_angle) -> Status {
					   if (!(glm::length(p_axis) > 0.0f)) {
						   return make_error("Node3D.rotate(): the axis has no direction");
					   }
					   r_node.set_basis(rotated(p_axis, p_angle) * r_node.get_basis());
					   return Ok(); }, { "axis", "angle" })
			.doc("Turns the node about an axis of the parent, in radians.");
	r_class.method(
				   "rotate_x", +[](Node3D &r_node, float p_angle) { r_node.set_basis(rotated(Vector3(1, 0, 0), p_angle) * r_node.get_basis()); }, { "angle" })
			.doc("Turns the node about the parent's x axis, in radians.");
	r_class.method(
				   "rotate_y", +[](Node3D &r_node, float p_angle) { r_node.set_basis(rotated(Vector3(0, 1, 0), p_angle) * r_node.get_basis()); }, { "angle" })
			.doc("Turns the node about the parent's y axis, in radians.");
	r_class.method(
				   "rotate_z", +[](Node3D &r_node, float p_angle) { r_node.set_basis(rotated(Vector3(0, 0, 1), p_angle) * r_node.get_basis()); }, { "angle" })
			.doc("Turns the node about the parent's z axis, in radians.");
	r_class.method(
				   "to_global", +[](const Node3D &p_node, const Vector3 &p_point) { return p_node.get_global_transform().xform(p_point); }, { "local_point" })
			.doc("A point of the node's space, in the world.");
	r_class.method(
				   "to_local", +[](const Node3D &p_node, const Vector3 &p_point) { return p_node.get_global_transform().affine_inverse().xform(p_point); }, { "global_point" })
			.doc("A point of the world, in the node's space.");
	r_class.method(
				   "show", +[](Node3D &r_node) { r_node.set_visible(true); })
			.doc("Shows the node.");
	r_class.method(
				   "hide", +[](Node3D &r_node) { r_node.set_visible(false); })
			.doc("Hides the node and all below it.");
	r_class.method("get_parent_node_3d", &Node3D::get_parent_node_3d).doc("The parent whose place this one's is relative to, or null.");
	r_class.method("set_notify_transform", &Node3D::set_notify_transform, { "enable" }).doc("Whether NOTIFICATION_TRANSFORM_CHANGED comes.");
}

void Node3D::bind(ClassBuilder<Node3D> &r_class) {
	r_class.doc("A node with a place in space, relative to its parent's. Metres and radians.");
	r_class.enumeration("EulerOrder", { { "EULER_ORDER_XYZ", EulerOrder::XYZ }, { "EULER_ORDER_XZY", EulerOrder::XZY }, { "EULER_ORDER_YXZ", EulerOrder::YXZ }, { "EULER_ORDER_YZX", EulerOrder::YZX }, { "EULER_ORDER_ZXY", EulerOrder::ZXY }, { "EULER_ORDER_ZYX", EulerOrder::ZYX } });
	r_class.property("transform", &Node3D::set_transform, &Node3D::get_transform).doc("Place, rotation and scale relative to the parent.");
	r_class.property("global_transform", &Node3D::set_global_transform, &Node3D::get_global_transform).not_stored().doc("Place, rotation and scale in the world.");
	r_class.property("position", &Node3D::set_position, &Node3D::get_position).doc("Place relative to the parent, in metres.");
	r_class.property("rotation", &Node3D::set_rotation, &Node3D::get_rotation).doc("Euler angles relative to the parent, in radians.");
	r_class.property("rotation_degrees", &Node3D::set_rotation_degrees, &Node3D::get_rotation_degrees).not_stored().doc("Euler angles relative to the parent, in degrees.");
	r_class.property("rotation_order", &Node3D::set_rotation_order, &Node3D::get_rotation_order).enum_of("EulerOrder").doc("The order of the Euler angles.");
	r_class.property("scale", &Node3D::set_scale, &Node3D::get_scale).doc("Scale along the node's own axes.");
	r_class.property("basis", &Node3D::set_basis, &Node3D::get_basis).not_stored().doc("Rotation and scale relative to the parent.");
	r_class.property("quaternion", &Node3D::set_quaternion, &Node3D::get_quaternion).not_stored().doc("Rotation relative to the parent.");
	r_class.property("global_position", &Node3D::set_global_position, &Node3D::get_global_position).not_stored().doc("Place in the world, in metres.");
	r_class.property("global_basis", &Node3D::set_global_basis, &Node3D::get_global_basis).not_stored().doc("Rotation and scale in the world.");
	r_class.property("global_rotation", &Node3D::set_global_rotation, &Node3D::get_global_rotation).not_stored().doc("Euler angles in the world, in radians.");
	r_class.property("top_level", &Node3D::set_as_top_level, &Node3D::is_set_as_top_level).doc("Whether the parents' transforms are left out.");
	r_class.property("visible", &Node3D::set_visible, &Node3D::is_visible).doc("Whether the node and all below it are drawn.");
	r_class.method("is_visible_in_tree", &Node3D::is_visible_in_tree).doc("Whether the node and all its parents are visible.");
	bind_movement(r_class);
	r_class.signal("visibility_changed").doc("The node or a parent was shown or hidden.");
	r_class.constant("NOTIFICATION_ENTER_WORLD", NOTIFICATION_ENTER_WORLD).doc("The node appears in the world.");
	r_class.constant("NOTIFICATION_EXIT_WORLD", NOTIFICATION_EXIT_WORLD).doc("The node leaves the world.");
	r_class.constant("NOTIFICATION_VISIBILITY_CHANGED", NOTIFICATION_VISIBILITY_CHANGED).doc("The node or a parent was shown or hidden.");
	r_class.constant("NOTIFICATION_TRANSFORM_CHANGED", NOTIFICATION_TRANSFORM_CHANGED).doc("The global transform changed; once a frame.");
}

} // namespace lucent::scene
