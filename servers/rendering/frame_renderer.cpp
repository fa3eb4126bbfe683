// SPDX-License-Identifier: MIT
#include "servers/rendering/frame_renderer.h"

#include "servers/rendering/gi/sdfgi/sdfgi.h"

namespace lucent {

namespace {
// Uploads where something changed; never leaves the buffer empty.
void upload_draw_instances(RenderingDevice &p_device, const std::vector<uint32_t> &p_instances, ViewportState &r_state) {
	const bool remade = r_state.draw_instances.reserve(p_device, p_instances.size() * sizeof(uint32_t), BUFFER_STORAGE, "frame.draw_instances");
	if (!p_instances.empty() && (remade || p_instances != r_state.uploaded_instances)) {
		p_device.upload_buffer(r_state.draw_instances.buffer, p_instances);
		r_state.uploaded_instances = p_instances;
	}
}

GiGatherInputs gather_inputs(const FrameSetup &p_setup, const ViewportState &p_state) {
	const ScreenTargets &targets = p_state.targets;
	return { targets.depth, targets.normal_roughness, targets.gi_irradiance, targets.gi_radiance, p_setup.frame.views[0].world_from_clip, p_setup.frame.views[0].camera_position, targets.width, targets.height };
}

void count_draws(const std::vector<DrawBatch> &p_batches, FrameStats &r_stats) {
	for (const DrawBatch &batch : p_batches) {
		r_stats.draws++;
		r_stats.triangles += uint64_t(batch.draw->geometry.index_count / 3) * batch.instance_count;
	}
}
} // namespace

FrameRenderer::FrameRenderer(RenderingDevice &p_device) :
		device(p_device), assets(p_device) {}
FrameRenderer::~FrameRenderer() = default;

// Chooses the world's origin and brings the device's copy of the scene up to date.
void FrameRenderer::place_world(const RenderScene &p_scene, const Viewport &p_viewport, World &r_world) {
	if (!r_world.placed) {
		const Camera &camera = *p_scene.cameras.get(p_viewport.camera);
		const Environment &environment = find_environment(p_scene, *p_scene.scenarios.get(p_viewport.scenario), camera);
		if (r_world.origin.follow(camera.transform.origin, environment.sdfgi)) {
			r_world.gi.reset();
		}
		r_world.placed = true;
	}
	r_world.scene.update(p_scene, assets, r_world.origin);
}

void FrameRenderer::draw_viewport(PassRecorder &r_recorder, const RenderScene &p_scene, const Viewport &p_viewport, World &r_world, ViewportState &r_state) {
	const Scenario &scenario = *p_scene.scenarios.get(p_viewport.scenario);
	const Camera &world_camera = *p_scene.cameras.get(p_viewport.camera);
	Camera camera = world_camera;
	camera.transform = r_world.origin.render_from_world(world_camera.transform);
	r_state.targets.resize(device, p_viewport.width, p_viewport.height, p_viewport.aov);
	const ScreenTargets &targets = r_state.targets;
	FrameSetup setup = make_frame_setup(p_scene, p_viewport, scenario, camera, r_world.scene);
	setup.frame.gi_enabled = setup.environment->sdfgi.enabled ? 1 : 0;
	if (!p_viewport.picture_enabled) {
		draw_light(r_recorder, setup, r_world, r_state);
		return;
	}
	if (r_state.drawn) {
		setup.frame.views[0].previous_clip_from_world = r_state.previous_clip_from_view * r_world.origin.render_from_world(r_state.previous_camera).affine_inverse().to_matrix();
	}

	std::vector<uint32_t> instances;
	const std::vector<DrawBatch> opaque_batches = cull_opaque(r_world.scene, setup.clip_from_world, camera.cull_mask, instances);
	const std::vector<DrawBatch> transparent_batches = cull_transparent(r_world.scene, setup.clip_from_world, camera.cull_mask, -setup.frame.views[0].camera_back, instances);
	r_state.shadows.plan(r_world.scene, p_scene, camera, setup.aspect, scenario.geometry_version, instances);
	upload_draw_instances(device, instances, r_state);
	device.upload_buffer(r_state.frame_buffer, 0, std::as_bytes(std::span(&setup.frame, 1)));
	r_state.cluster_masks.reserve(device, setup.cluster_mask_count * sizeof(uint32_t), BUFFER_STORAGE, "frame.cluster_masks");
	const bool redraw_sky = r_state.sky.update(setup.sky, assets.texture(setup.panorama));
	const SceneBindings scene = scene_bindings(r_world, r_state);
	const ShadingBindings shading = shading_bindings(r_world, r_state);
	const AovTargets aov = targets.aov_targets();
	const bool gi = setup.frame.gi_enabled != 0;

	depth_prepass(r_recorder, { scene, assets, opaque_batches, targets.depth, targets.normal_roughness, targets.motion });
	draw_shadow_maps(r_recorder, scene, assets, r_state.shadows.jobs());
	if (redraw_sky) {
		r_state.sky.draw(r_recorder);
	}
	if (gi) {
		update_gi(r_recorder, setup, r_world, r_state);
		gather_gi(r_recorder, setup, r_world, r_state);
	}
	if (setup.cluster_mask_count > 0) {
		light_clusters(r_recorder, { r_state.frame_buffer, shading.lights, shading.clusters, setup.clusters, setup.cluster_mask_count });
	}
	opaque(r_recorder, { scene, shading, assets, opaque_batches, gi ? targets.gi_irradiance : assets.black(), gi ? targets.gi_radiance : assets.black(), targets.depth, targets.color, targets.aov ? &aov : nullptr });
	draw_sky(r_recorder, r_state.sky.inputs(), targets.depth, targets.color, targets.width, targets.height);
	if (!transparent_batches.empty()) {
		transparent(r_recorder, { scene, shading, assets, transparent_batches, targets.depth, targets.color, gi ? [&](RenderPass &r_pass) { r_world.gi->bind_sampling(r_pass); } : std::function<void(RenderPass &)>() });
	}
	if (!p_viewport.debug_view.empty()) {
		draw_debug_view(r_recorder, p_viewport.debug_view, setup, r_world, r_state);
	}
	tonemap(r_recorder, targets.color, targets.display, setup.tonemap, targets.width, targets.height);

	count_draws(opaque_batches, frame_stats);
	count_draws(transparent_batches, frame_stats);
	frame_stats.lights += r_world.scene.lights().size();
	r_state.previous_camera = world_camera.transform;
	r_state.previous_clip_from_view = setup.clip_from_view;
	r_state.drawn = true;
}

void FrameRenderer::draw_light(PassRecorder &r_recorder, const FrameSetup &p_setup, World &r_world, ViewportState &r_state) {
	if (r_state.sky.update(p_setup.sky, assets.texture(p_setup.panorama))) {
		r_state.sky.draw(r_recorder);
	}
	if (p_setup.frame.gi_enabled != 0) {
		update_gi(r_recorder, p_setup, r_world, r_state);
	}
	frame_stats.lights += r_world.scene.lights().size();
}

void FrameRenderer::update_gi(PassRecorder &r_recorder, const FrameSetup &p_setup, World &r_world, const ViewportState &p_state) {
	if (r_world.gi == nullptr) {
		r_world.gi = std::make_shared<Sdfgi>(device);
	}
	GiSceneView view = r_world.scene.gi_view();
	view.sky_octahedral = p_state.sky.octahedral();
	view.ambient_color = p_setup.frame.ambient_color;
	r_world.gi->update(r_recorder, p_setup.environment->sdfgi, view, p_setup.frame.views[0].camera_position);
	frame_stats.gi = r_world.gi->stats();
}

void FrameRenderer::gather_gi(PassRecorder &r_recorder, const FrameSetup &p_setup, World &r_world, const ViewportState &p_state) {
	r_world.gi->gather(r_recorder, gather_inputs(p_setup, p_state));
}

void FrameRenderer::draw_debug_view(PassRecorder &r_recorder, const std::string &p_view, const FrameSetup &p_setup, World &r_world, const ViewportState &p_state) {
	const bool known = r_world.gi != nullptr && r_world.gi->draw_debug_view(r_recorder, p_view, gather_inputs(p_setup, p_state), p_state.targets.color);
	if (!known) {
		log_warning_once("debug view " + p_view, fmt::format("there is no debug view '{}', or SDFGI is off", p_view));
	}
}

std::vector<std::string> FrameRenderer::debug_views() {
	return Sdfgi::debug_views();
}

void FrameRenderer::draw(RenderScene &r_scene) {
	drop_stale(r_scene);
	frame_stats = FrameStats();
	PassRecorder &recorder = device.begin_frame();
	if (assets_version != r_scene.version) {
		assets.update(r_scene);
		assets_version = r_scene.version;
	}
	r_scene.viewports.for_each([&](ViewportRid p_rid, Viewport &r_viewport) {
		Scenario *scenario = r_scene.scenarios.get(r_viewport.scenario);
		if (scenario == nullptr || r_scene.cameras.get(r_viewport.camera) == nullptr || r_viewport.width == 0) {
			return;
		}
		auto &[world_rid, world] = worlds[r_viewport.scenario.index];
		if (world == nullptr) {
			world_rid = r_viewport.scenario;
			world = std::make_unique<World>(device, world_rid);
		}
		auto &[viewport_rid, state] = viewports[p_rid.index];
		if (state == nullptr) {
			viewport_rid = p_rid;
			state = std::make_unique<ViewportState>(device);
		}
		place_world(r_scene, r_viewport, *world);
		draw_viewport(recorder, r_scene, r_viewport, *world, *state);
		scenario->dirty.clear();
	});
	device.end_frame();
	for (auto &[index, entry] : worlds) {
		entry.second->placed = false;
		if (entry.second->gi != nullptr) {
			entry.second->gi->after_frame();
			frame_stats.gi = entry.second->gi->stats();
		}
	}
	for (const PassTiming &timing : device.timings()) {
		frame_stats.pass_ms.emplace_back(timing.name, timing.gpu_ms);
	}
}

void FrameRenderer::drop_stale(const RenderScene &p_scene) {
	std::erase_if(worlds, [&](const auto &p_item) { return p_scene.scenarios.get(p_item.second.first) == nullptr; });
	std::erase_if(viewports, [&](const auto &p_item) { return p_scene.viewports.get(p_item.second.first) == nullptr; });
}

SceneBindings FrameRenderer::scene_bindings(const World &p_world, const ViewportState &p_state) const {
	const GiSceneView &view = p_world.scene.gi_view();
	return { p_state.frame_buffer, view.positions, view.attributes, view.indices, view.instances, view.materials, p_state.draw_instances.buffer };
}

ShadingBindings FrameRenderer::shading_bindings(const World &p_world, const ViewportState &p_state) const {
	SamplerDesc clamped;
	clamped.address_u = clamped.address_v = clamped.address_w = AddressMode::CLAMP_TO_EDGE;
	clamped.max_lod = 0.0f;
	SamplerDesc compare = clamped;
	compare.compare = true;
	const ShadowMaps &shadows = p_state.shadows;
	return { p_world.scene.gi_view().lights, p_state.cluster_masks.buffer, shadows.views(), shadows.sun_maps(), shadows.light_maps(), device.sampler(compare), device.sampler(clamped), p_state.sky.irradiance(), p_state.sky.radiance(), assets.environment_brdf() };
}

FrameStats FrameRenderer::stats() const {
	return frame_stats;
}

} // namespace lucent
