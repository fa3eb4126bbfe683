// SPDX-License-Identifier: MIT
#include "servers/rendering/rendering_server_impl.h"

namespace lucent {

namespace {
constexpr uint32_t MAX_VIEWPORT_TEXELS = 16384; // an axis
}

ViewportRid RenderingServer::viewport_create() {
	return impl->scene.viewports.make(Viewport());
}

void RenderingServer::viewport_set_size(ViewportRid p_viewport, uint32_t p_width, uint32_t p_height) {
	Viewport *viewport = impl->scene.viewports.get(p_viewport);
	ERR_FAIL_COND_MSG(viewport == nullptr, "no such viewport");
	ERR_FAIL_COND_MSG(p_width == 0 || p_height == 0 || p_width > MAX_VIEWPORT_TEXELS || p_height > MAX_VIEWPORT_TEXELS, "{}x{} is outside of 1 to {} an axis", p_width, p_height, MAX_VIEWPORT_TEXELS);
	const uint32_t limit = impl->device != nullptr ? impl->device->info().max_texture_2d_texels : MAX_VIEWPORT_TEXELS;
	ERR_FAIL_COND_MSG(p_width > limit || p_height > limit, "{}x{} exceeds the device's limit of {} an axis", p_width, p_height, limit);
	viewport->width = p_width;
	viewport->height = p_height;
}

void RenderingServer::viewport_set_scenario(ViewportRid p_viewport, ScenarioRid p_scenario) {
	Viewport *viewport = impl->scene.viewports.get(p_viewport);
	ERR_FAIL_COND_MSG(viewport == nullptr, "no such viewport");
	ERR_FAIL_COND_MSG(p_scenario.is_valid() && impl->scene.scenarios.get(p_scenario) == nullptr, "no such scenario");
	viewport->scenario = p_scenario;
}

void RenderingServer::viewport_attach_camera(ViewportRid p_viewport, CameraRid p_camera) {
	Viewport *viewport = impl->scene.viewports.get(p_viewport);
	ERR_FAIL_COND_MSG(viewport == nullptr, "no such viewport");
	ERR_FAIL_COND_MSG(p_camera.is_valid() && impl->scene.cameras.get(p_camera) == nullptr, "no such camera");
	viewport->camera = p_camera;
}

void RenderingServer::viewport_set_picture_enabled(ViewportRid p_viewport, bool p_enabled) {
	Viewport *viewport = impl->scene.viewports.get(p_viewport);
	ERR_FAIL_COND_MSG(viewport == nullptr, "no such viewport");
	viewport->picture_enabled = p_enabled;
}

void RenderingServer::viewport_set_debug_view(ViewportRid p_viewport, const std::string &p_view) {
	Viewport *viewport = impl->scene.viewports.get(p_viewport);
	ERR_FAIL_COND_MSG(viewport == nullptr, "no such viewport");
	viewport->debug_view = p_view;
}

void RenderingServer::viewport_set_aov(ViewportRid p_viewport, bool p_enabled) {
	Viewport *viewport = impl->scene.viewports.get(p_viewport);
	ERR_FAIL_COND_MSG(viewport == nullptr, "no such viewport");
	viewport->aov = p_enabled;
}

ViewportImage RenderingServer::viewport_get_image(ViewportRid p_viewport, ViewportBuffer p_buffer) {
	ERR_FAIL_COND_V_MSG(impl->scene.viewports.get(p_viewport) == nullptr, ViewportImage(), "no such viewport");
	ERR_FAIL_COND_V_MSG(impl->device == nullptr, ViewportImage(), "the server has no device");
	ViewportImage image = impl->frame_renderer->read_back(p_viewport, p_buffer);
	ERR_FAIL_COND_V_MSG(image.values.empty(), ViewportImage(), "the viewport has not been drawn, or not with this buffer");
	return image;
}

void RenderingServer::draw() {
	ERR_FAIL_COND_MSG(impl->device == nullptr, "the server has no device");
	impl->frame_renderer->draw(impl->scene);
	for (const InstanceRid rid : impl->moved) {
		if (Instance *instance = impl->scene.instances.get(rid)) {
			instance->previous_transform = instance->transform;
			instance->drawn = true;
		}
	}
	// The next frame uploads the previous transforms.
	impl->scene.version += impl->moved.empty() ? 0 : 1;
	impl->moved.clear();
}

FrameStats RenderingServer::get_frame_stats() const {
	return impl->frame_renderer != nullptr ? impl->frame_renderer->stats() : FrameStats();
}

std::vector<std::string> RenderingServer::get_debug_views() const {
	return FrameRenderer::debug_views();
}

void RenderingServer::free(TextureRid p_rid) {
	ERR_FAIL_COND_MSG(!impl->scene.textures.free(p_rid), "no such texture");
	impl->scene.materials.for_each([&](MaterialRid p_material, Material &r_material) {
		for (TextureRef &ref : r_material.textures) {
			if (ref.texture == p_rid) {
				ref.texture = TextureRid();
				r_material.version = impl->next_version();
				impl->mark_material_users(p_material);
			}
		}
	});
	impl->scene.skies.for_each([&](SkyRid p_sky, Sky &r_sky) {
		if (r_sky.panorama == p_rid) {
			r_sky.panorama = TextureRid();
			r_sky.version = impl->next_version();
			impl->mark_sky_users(p_sky);
		}
	});
}

void RenderingServer::free(MaterialRid p_rid) {
	ERR_FAIL_COND_MSG(impl->scene.materials.get(p_rid) == nullptr, "no such material");
	impl->mark_material_users(p_rid);
	impl->scene.materials.free(p_rid);
}

void RenderingServer::free(MeshRid p_rid) {
	const Mesh *mesh = impl->scene.meshes.get(p_rid);
	ERR_FAIL_COND_MSG(mesh == nullptr, "no such mesh");
	impl->mark_mesh_users(p_rid, mesh->aabb);
	impl->scene.instances.for_each([&](InstanceRid, Instance &r_instance) {
		if (r_instance.mesh == p_rid) {
			r_instance.mesh = MeshRid();
			r_instance.version = impl->next_version();
		}
	});
	impl->scene.meshes.free(p_rid);
}

void RenderingServer::free(LightRid p_rid) {
	const Light *light = impl->scene.lights.get(p_rid);
	ERR_FAIL_COND_MSG(light == nullptr, "no such light");
	impl->mark_light_users(p_rid, *light);
	impl->scene.instances.for_each([&](InstanceRid, Instance &r_instance) {
		if (r_instance.light == p_rid) {
			r_instance.light = LightRid();
			r_instance.version = impl->next_version();
		}
	});
	impl->scene.lights.free(p_rid);
}

void RenderingServer::free(InstanceRid p_rid) {
	Instance *instance = impl->scene.instances.get(p_rid);
	ERR_FAIL_COND_MSG(instance == nullptr, "no such instance");
	if (instance->visible) {
		impl->mark_dirty(instance->scenario, impl->instance_box(*instance), !impl->is_light(*instance));
	}
	impl->scene.instances.free(p_rid);
	impl->scene.version++;
}

void RenderingServer::free(SkyRid p_rid) {
	ERR_FAIL_COND_MSG(impl->scene.skies.get(p_rid) == nullptr, "no such sky");
	impl->mark_sky_users(p_rid);
	impl->scene.skies.free(p_rid);
}

void RenderingServer::free(EnvironmentRid p_rid) {
	ERR_FAIL_COND_MSG(impl->scene.environments.get(p_rid) == nullptr, "no such environment");
	impl->mark_environment_users(p_rid);
	impl->scene.environments.free(p_rid);
}

void RenderingServer::free(CameraRid p_rid) {
	ERR_FAIL_COND_MSG(!impl->scene.cameras.free(p_rid), "no such camera");
}

void RenderingServer::free(ScenarioRid p_rid) {
	ERR_FAIL_COND_MSG(!impl->scene.scenarios.free(p_rid), "no such scenario");
	impl->scene.version++;
}

void RenderingServer::free(ViewportRid p_rid) {
	ERR_FAIL_COND_MSG(!impl->scene.viewports.free(p_rid), "no such viewport");
}

} // namespace lucent
