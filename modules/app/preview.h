// SPDX-License-Identifier: MIT
#pragma once
// What Godot's editor shows in its 3D view where a scene has nothing of its own (editor/plugins/node_3d_editor_plugin.cpp, Godot 4).

#include "servers/core/math_types.h"

namespace lucent {

namespace scene {
class Node;
class Camera3D;
class DirectionalLight3D;
class WorldEnvironment;
} // namespace scene

// Adds children called WorldEnvironment and DirectionalLight3D, as far as needed: see RenderSession::load. Answers those that it added.
struct PreviewNodes {
	scene::WorldEnvironment *environment = nullptr;
	scene::DirectionalLight3D *sun = nullptr;
};
PreviewNodes add_preview_environment(scene::Node &r_root);

// Brings GI's cells and the reach of shadows into proportion to the scene, so that its size in metres does not matter.
void fit_preview(const PreviewNodes &p_nodes, const AABB &p_bounds);

// Adds a child Camera3D that frames p_bounds.
scene::Camera3D *add_framing_camera(scene::Node &r_root, const AABB &p_bounds, float p_aspect);

} // namespace lucent
