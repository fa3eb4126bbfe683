// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/environment.h"
#include "modules/scene/node_3d.h"

namespace lucent::scene {

// Looks along -z.
class Camera3D : public Node3D {
	LUCENT_CLASS(Camera3D, Node3D)
public:
	enum class KeepAspect : uint8_t {
		WIDTH,
		HEIGHT
	};

	Camera3D() { set_notify_transform(true); }

	// In a tree: this is the camera that shows; below a Viewport it never is, for that has its own. Outside: it will be, when it enters.
	void set_current(bool p_current);
	bool is_current() const;
	void make_current() { set_current(true); }
	bool wants_current() const { return current; }
	void set_environment(const Ref<Environment> &p_environment);
	Ref<Environment> get_environment() const { return environment; }
	void set_keep_aspect(KeepAspect p_mode);
	KeepAspect get_keep_aspect() const { return parameters.keep_height ? KeepAspect::HEIGHT : KeepAspect::WIDTH; }

	// After an edit: state_changed(). Transform and environment here are not used.
	lucent::Camera parameters;
	struct Offset {
		float horizontal = 0.0f;
		float vertical = 0.0f;
	} offset; // metres, along the camera's own axes
	void state_changed();

	CameraRid get_camera_rid() const { return rid; } // invalid outside of a tree with a server
	Transform3D get_camera_transform() const; // with the offsets, without scale

protected:
	void _notification(int p_what) override;

private:
	bool current = false;
	Ref<Environment> environment;
	CameraRid rid;
};

} // namespace lucent::scene
