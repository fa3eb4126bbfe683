// SPDX-License-Identifier: MIT
#pragma once
// Draws the scene's viewports: frame_renderer.cpp is the frame, one line a pass, top to bottom.

#include "servers/rendering/rendering_server.h"
#include "servers/rendering/viewport_state.h"

#include <map>

namespace lucent {

class Sdfgi;

class FrameRenderer {
public:
	explicit FrameRenderer(RenderingDevice &p_device);
	~FrameRenderer();

	// Draws every viewport that has a scenario, a camera and a size; clears the dirty boxes of what it drew.
	void draw(RenderScene &r_scene);
	// Waits for the GPU. Empty: the viewport was not drawn, or has no such buffer.
	ViewportImage read_back(ViewportRid p_viewport, ViewportBuffer p_buffer);
	FrameStats stats() const;
	static std::vector<std::string> debug_views();

private:
	struct World {
		RenderOrigin origin;
		bool placed = false; // the origin, in this frame
		GpuScene scene;
		std::shared_ptr<Sdfgi> gi;
		World(RenderingDevice &p_device, ScenarioRid p_scenario) :
				scene(p_device, p_scenario) {}
	};
	void place_world(const RenderScene &p_scene, const Viewport &p_viewport, World &r_world);
	void draw_viewport(PassRecorder &r_recorder, const RenderScene &p_scene, const Viewport &p_viewport, World &r_world, ViewportState &r_state);
	void update_gi(PassRecorder &r_recorder, const FrameSetup &p_setup, World &r_world, const ViewportState &p_state);
	void gather_gi(PassRecorder &r_recorder, const FrameSetup &p_setup, World &r_world, const ViewportState &p_state);
	void draw_light(PassRecorder &r_recorder, const FrameSetup &p_setup, World &r_world, ViewportState &r_state);
	void draw_debug_view(PassRecorder &r_recorder, const std::string &p_view, const FrameSetup &p_setup, World &r_world, const ViewportState &p_state);
	void drop_stale(const RenderScene &p_scene);
	SceneBindings scene_bindings(const World &p_world, const ViewportState &p_state) const;
	ShadingBindings shading_bindings(const World &p_world, const ViewportState &p_state) const;

	RenderingDevice &device;
	GpuAssets assets;
	uint64_t assets_version = 0;
	std::map<uint32_t, std::pair<ScenarioRid, std::unique_ptr<World>>> worlds; // by the id's index
	std::map<uint32_t, std::pair<ViewportRid, std::unique_ptr<ViewportState>>> viewports;
	FrameStats frame_stats;
};

} // namespace lucent
