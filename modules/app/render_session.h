// SPDX-License-Identifier: MIT
#pragma once

#include "modules/app/render_options.h"
#include "modules/scene/scene_tree.h"

namespace lucent {

// One scene and one viewport on it.
class RenderSession {
public:
	explicit RenderSession(RenderingServer &p_server) :
			server(p_server), tree(&p_server) {}
	~RenderSession();
	RenderSession(const RenderSession &) = delete;
	RenderSession &operator=(const RenderSession &) = delete;

	// Reads a .tscn, .glb or .gltf. Where it has no WorldEnvironment, adds what Godot's editor shows then: "WorldEnvironment" with a
	// procedural sky (and SDFGI), and without a DirectionalLight3D also "DirectionalLight3D"; their sizes follow the scene's.
	// p_strict: a part that can't be read is an error; else it is left out, and said.
	Status load(const std::string &p_path, bool p_strict = false);
	// The scene's own root.
	scene::Node &root() { return *tree.get_current_scene(); }
	// Chooses the camera (p_options.camera, the scene's current one, its first one, one that frames the scene).
	Status open_viewport(const RenderOptions &p_options);
	ViewportRid viewport() const { return viewport_rid; }
	void draw_frame();

private:
	Result<CameraRid> choose_camera(const RenderOptions &p_options);

	RenderingServer &server;
	std::string path;
	scene::SceneTree tree;
	ViewportRid viewport_rid;
};

} // namespace lucent
