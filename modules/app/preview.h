// SPDX-License-Identifier: MIT
#pragma once
// What Godot's editor shows in its 3D view where a scene has nothing of its own (editor/plugins/node_3d_editor_plugin.cpp, Godot 4).

#include "servers/core/math_types.h"

namespace lucent {

namespace scene {
class Node;
class Camera3D;
} // namespace scene

// Adds children called WorldEnvironment and DirectionalLight3D, as far as needed: see RenderSession::load.
void add_preview_environment(scene::Node &r_root);

// Adds a child Camera3D that frames p_bounds.
scene::Camera3D *add_framing_camera(scene::Node &r_root, const AABB &p_bounds, float p_aspect);

} // namespace lucent
