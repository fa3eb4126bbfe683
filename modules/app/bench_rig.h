// SPDX-License-Identifier: MIT
#pragma once
// A device and scenes on it, for measuring: frames drawn one at a time, with everything known about each.

#include "modules/app/bench_options.h"
#include "modules/app/render_session.h"
#include "modules/reference/image_metrics.h"
#include "servers/rendering/device/rendering_device.h"

namespace lucent {

namespace scene {
class Camera3D;
class Environment;
} // namespace scene

Result<std::unique_ptr<RenderingDevice>> create_bench_device(const BenchOptions &p_options);

struct FrameSample {
	std::vector<PassTiming> passes; // of this very frame; empty where the device has no timestamps
	FrameStats stats;
	double wall_ms = 0; // until the GPU had finished

	double gpu_ms() const;
	double gi_ms() const;
};

// One scene with its server. What the constructor can't do, load says.
class BenchScene {
public:
	explicit BenchScene(RenderingDevice &p_device) :
			device(p_device), server(&p_device), session(server) {}

	// Reads the scene, applies --set and --grid, opens the viewport.
	Status load(const std::string &p_path, const BenchOptions &p_options, uint32_t p_width, uint32_t p_height);
	RenderingServer &rendering_server() { return server; }
	ViewportRid viewport() const { return session.viewport(); }
	scene::Node &root() { return session.root(); }
	// Of the scene's own nodes; null: it has none.
	scene::Environment *environment();
	scene::Camera3D *camera();
	void set_sdfgi_enabled(bool p_enabled); // off: ambient light too, so that only lamps' light is left
	void set_size(uint32_t p_width, uint32_t p_height) { server.viewport_set_size(session.viewport(), p_width, p_height); }

	void keep_layers(bool p_enabled) { server.viewport_set_aov(session.viewport(), p_enabled); } // for picture() of more than colour

	FrameSample draw();
	// Until the light has settled, at most p_frames. True: it has.
	bool settle(uint32_t p_frames, uint32_t *r_frames = nullptr);
	MetricImage picture(ViewportBuffer p_buffer);

private:
	RenderingDevice &device;
	RenderingServer server;
	RenderSession session;
	int ambient_source = 0; // as it was before set_sdfgi_enabled(false)
};

} // namespace lucent
