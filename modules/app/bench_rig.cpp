// SPDX-License-Identifier: MIT
#include "modules/app/bench_rig.h"

#include "drivers/vulkan/vulkan_driver.h"
#include "modules/app/property_setting.h"
#include "modules/app/stats_file.h"
#include "modules/scene/camera_3d.h"
#include "modules/scene/world_environment.h"

#include <chrono>

namespace lucent {

namespace {

template <typename T, typename F>
T *find_in_tree(scene::Node &p_node, const F &p_wanted) {
	if (T *found = dynamic_cast<T *>(&p_node); found != nullptr && p_wanted(*found)) {
		return found;
	}
	for (const std::unique_ptr<scene::Node> &child : p_node.get_children()) {
		if (T *found = find_in_tree<T>(*child, p_wanted)) {
			return found;
		}
	}
	return nullptr;
}

} // namespace

Result<std::unique_ptr<RenderingDevice>> create_bench_device(const BenchOptions &p_options) {
	Result<std::unique_ptr<RenderingDeviceDriver>> driver = create_vulkan_driver({ p_options.device, p_options.validation });
	if (!driver) {
		return driver.error();
	}
	return RenderingDevice::create(driver.take());
}

double FrameSample::gpu_ms() const {
	double sum = 0;
	for (const PassTiming &pass : passes) {
		sum += pass.gpu_ms;
	}
	return sum;
}

double FrameSample::gi_ms() const {
	double sum = 0;
	for (const PassTiming &pass : passes) {
		sum += is_gi_pass(pass.name) ? pass.gpu_ms : 0.0;
	}
	return sum;
}

Status BenchScene::load(const std::string &p_path, const BenchOptions &p_options, uint32_t p_width, uint32_t p_height) {
	if (const Status status = session.load(p_path); !status) {
		return status;
	}
	if (p_options.grid != 0 && environment() != nullptr) {
		environment()->sdfgi.grid_size_cells = p_options.grid;
		environment()->state_changed();
	}
	for (const std::string &setting : p_options.settings) {
		if (const Status status = apply_setting(root(), setting); !status) {
			return status;
		}
	}
	RenderOptions view;
	view.width = p_width;
	view.height = p_height;
	return session.open_viewport(view);
}

scene::Environment *BenchScene::environment() {
	const auto *node = find_in_tree<scene::WorldEnvironment>(root(), [](const scene::WorldEnvironment &p_node) { return p_node.get_environment() != nullptr; });
	return node == nullptr ? nullptr : node->get_environment().get();
}

scene::Camera3D *BenchScene::camera() {
	return find_in_tree<scene::Camera3D>(root(), [](const scene::Camera3D &p_camera) { return p_camera.is_current(); });
}

void BenchScene::set_sdfgi_enabled(bool p_enabled) {
	scene::Environment *environment = this->environment();
	if (environment == nullptr || environment->sdfgi.enabled == p_enabled) {
		return;
	}
	if (!p_enabled) {
		ambient_source = int(environment->parameters.ambient_source);
	}
	environment->sdfgi.enabled = p_enabled;
	environment->parameters.ambient_source = p_enabled ? AmbientSource(ambient_source) : AmbientSource::DISABLED;
	environment->state_changed();
}

FrameSample BenchScene::draw() {
	const auto start = std::chrono::steady_clock::now();
	session.draw_frame();
	// Timings then are those of the frame just drawn, not of the one two before.
	device.wait_idle();
	FrameSample sample;
	sample.wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
	sample.passes = device.timings();
	sample.stats = server.get_frame_stats();
	return sample;
}

bool BenchScene::settle(uint32_t p_frames, uint32_t *r_frames) {
	uint32_t frame = 0;
	bool settled = false;
	while (frame < p_frames && !settled) {
		settled = draw().stats.gi.converged;
		frame++;
	}
	if (r_frames != nullptr) {
		*r_frames = frame;
	}
	return settled;
}

MetricImage BenchScene::picture(ViewportBuffer p_buffer) {
	ViewportImage image = server.viewport_get_image(session.viewport(), p_buffer);
	return { image.width, image.height, std::move(image.values) };
}

} // namespace lucent
