// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/euler.h"
#include "modules/scene/node.h"

namespace lucent::scene {

// A node with a place. The chain of transforms ends at a parent that is not a Node3D. Metres, radians.
class Node3D : public Node {
	LUCENT_CLASS(Node3D, Node)
public:
	enum {
		NOTIFICATION_ENTER_WORLD = 41,
		NOTIFICATION_EXIT_WORLD = 42,
		NOTIFICATION_VISIBILITY_CHANGED = 43,
		NOTIFICATION_TRANSFORM_CHANGED = 2000, // once a frame, if the global transform changed and set_notify_transform is on
	};

	void set_transform(const Transform3D &p_transform);
	Transform3D get_transform() const { return local; }
	void set_global_transform(const Transform3D &p_transform);
	const Transform3D &get_global_transform() const;

	void set_position(const Vector3 &p_position);
	Vector3 get_position() const { return local.origin; }
	void set_rotation(const Vector3 &p_euler);
	Vector3 get_rotation() const;
	void set_rotation_degrees(const Vector3 &p_degrees);
	Vector3 get_rotation_degrees() const;
	void set_rotation_order(EulerOrder p_order);
	EulerOrder get_rotation_order() const { return rotation_order; }
	void set_scale(const Vector3 &p_scale);
	Vector3 get_scale() const;
	void set_basis(const Basis &p_basis);
	Basis get_basis() const { return local.basis; }
	void set_quaternion(const Quaternion &p_quaternion);
	Quaternion get_quaternion() const;
	void set_global_position(const Vector3 &p_position);
	Vector3 get_global_position() const { return get_global_transform().origin; }
	void set_global_basis(const Basis &p_basis);
	Basis get_global_basis() const { return get_global_transform().basis; }
	void set_global_rotation(const Vector3 &p_euler);
	Vector3 get_global_rotation() const;

	// -z towards p_target, y near p_up; all in world space. Keeps the scale.
	void look_at(const Vector3 &p_target, const Vector3 &p_up = Vector3(0, 1, 0));

	// The parents' transforms do not act.
	void set_as_top_level(bool p_top_level);
	bool is_set_as_top_level() const { return top_level; }

	void set_visible(bool p_visible);
	bool is_visible() const { return visible; }
	bool is_visible_in_tree() const; // and all parents are

	void set_notify_transform(bool p_enabled) { notify_transform = p_enabled; }
	Node3D *get_parent_node_3d() const; // null: the transform is the world's

protected:
	void _notification(int p_what) override;

private:
	friend class SceneTree;
	void local_changed();
	void propagate_transform_changed();
	void propagate_visibility_changed();
	void send_transform_changed();
	// Euler angles and scale are kept as they were set; they come from the basis when that was set last.
	void update_euler_and_scale() const;

	Transform3D local;
	mutable Transform3D global;
	mutable bool global_dirty = true;
	mutable Vector3 euler{ 0.0f };
	mutable Vector3 scale{ 1.0f };
	mutable bool euler_dirty = false;
	EulerOrder rotation_order = EulerOrder::YXZ;
	bool top_level = false;
	bool visible = true;
	bool notify_transform = false;
	bool transform_queued = false;
};

} // namespace lucent::scene
