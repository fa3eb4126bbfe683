// SPDX-License-Identifier: MIT
#include "servers/rendering/rendering_server_impl.h"

namespace lucent {

namespace {
// Beyond this many boxes a frame, they become one.
constexpr size_t MAX_DIRTY_BOXES = 256;
constexpr float EVERYWHERE_M = 1e9f;
} // namespace

AABB light_box(const Light &p_light, const Transform3D &p_transform) {
	if (p_light.type == LightType::DIRECTIONAL) {
		return { Vector3(-EVERYWHERE_M), Vector3(EVERYWHERE_M) };
	}
	return { p_transform.origin - p_light.range_m, p_transform.origin + p_light.range_m };
}

AABB RenderingServer::Impl::instance_box(const Instance &p_instance) const {
	if (const Light *light = scene.lights.get(p_instance.light)) {
		return light_box(*light, p_instance.transform);
	}
	const Mesh *mesh = scene.meshes.get(p_instance.mesh);
	return mesh != nullptr ? mesh->aabb.xform(p_instance.transform) : AABB();
}

void RenderingServer::Impl::mark_dirty(ScenarioRid p_scenario, const AABB &p_box, bool p_geometry) {
	Scenario *scenario = scene.scenarios.get(p_scenario);
	if (scenario == nullptr || p_box.is_empty()) {
		return;
	}
	const uint64_t version = next_version();
	(p_geometry ? scenario->geometry_version : scenario->light_version) = version;
	scenario->dirty.push_back({ p_box, version, p_geometry });
	if (scenario->dirty.size() > MAX_DIRTY_BOXES) {
		DirtyBox all = scenario->dirty.back();
		for (const DirtyBox &dirty : scenario->dirty) {
			all.box.merge_with(dirty.box);
			all.geometry = all.geometry || dirty.geometry;
		}
		scenario->dirty = { all };
	}
}

void RenderingServer::Impl::mark_mesh_users(MeshRid p_mesh, const AABB &p_old_local) {
	const Mesh *mesh = scene.meshes.get(p_mesh);
	scene.instances.for_each([&](InstanceRid, Instance &r_instance) {
		if (r_instance.mesh == p_mesh && r_instance.visible) {
			AABB box = p_old_local.xform(r_instance.transform);
			if (mesh != nullptr) {
				box.merge_with(mesh->aabb.xform(r_instance.transform));
			}
			mark_dirty(r_instance.scenario, box, true);
		}
	});
}

void RenderingServer::Impl::mark_light_users(LightRid p_light, const Light &p_old) {
	scene.instances.for_each([&](InstanceRid, Instance &r_instance) {
		if (r_instance.light == p_light && r_instance.visible) {
			AABB box = light_box(p_old, r_instance.transform);
			box.merge_with(instance_box(r_instance));
			mark_dirty(r_instance.scenario, box, false);
		}
	});
}

void RenderingServer::Impl::mark_material_users(MaterialRid p_material) {
	const Material *material = scene.materials.get(p_material);
	scene.instances.for_each([&](InstanceRid, Instance &r_instance) {
		const Mesh *mesh = scene.meshes.get(r_instance.mesh);
		if (mesh == nullptr || !r_instance.visible) {
			return;
		}
		for (uint32_t i = 0; i < mesh->surfaces.size(); i++) {
			if (scene.surface_material(r_instance, *mesh, i) == material) {
				mark_dirty(r_instance.scenario, instance_box(r_instance), true);
				return;
			}
		}
	});
}

void RenderingServer::Impl::mark_environment_users(EnvironmentRid p_environment) {
	scene.scenarios.for_each([&](ScenarioRid, Scenario &r_scenario) {
		if (r_scenario.environment == p_environment || r_scenario.fallback_environment == p_environment) {
			r_scenario.light_version = next_version();
		}
	});
	scene.version++;
}

void RenderingServer::Impl::mark_sky_users(SkyRid p_sky) {
	scene.environments.for_each([&](EnvironmentRid p_rid, Environment &r_environment) {
		if (r_environment.sky == p_sky) {
			r_environment.version = next_version();
			mark_environment_users(p_rid);
		}
	});
}

RenderingServer::RenderingServer(RenderingDevice *p_device) :
		impl(std::make_unique<Impl>()) {
	impl->device = p_device;
	if (p_device != nullptr) {
		impl->frame_renderer = std::make_unique<FrameRenderer>(*p_device);
	}
}

void RenderingServer::open_device(RenderingDevice &r_device) {
	ERR_FAIL_COND_MSG(impl->device != nullptr, "the server has a device already");
	impl->device = &r_device;
	impl->frame_renderer = std::make_unique<FrameRenderer>(r_device);
}

RenderingServer::~RenderingServer() = default;

TextureRid RenderingServer::texture_2d_create(std::shared_ptr<const Image> p_image, bool p_srgb) {
	ERR_FAIL_COND_V_MSG(p_image == nullptr || p_image->is_empty(), TextureRid(), "the image is empty");
	const size_t size_bytes = size_t(p_image->width) * p_image->height * p_image->texel_size_bytes();
	ERR_FAIL_COND_V_MSG(p_image->texels.size() != size_bytes, TextureRid(), "the image has {} bytes, {} expected", p_image->texels.size(), size_bytes);
	return impl->scene.textures.make({ std::move(p_image), p_srgb, impl->next_version() });
}

void RenderingServer::texture_2d_update(TextureRid p_texture, std::shared_ptr<const Image> p_image, bool p_srgb) {
	SceneTexture *texture = impl->scene.textures.get(p_texture);
	ERR_FAIL_COND_MSG(texture == nullptr, "no such texture");
	ERR_FAIL_COND_MSG(p_image == nullptr || p_image->is_empty(), "the image is empty");
	const size_t size_bytes = size_t(p_image->width) * p_image->height * p_image->texel_size_bytes();
	ERR_FAIL_COND_MSG(p_image->texels.size() != size_bytes, "the image has {} bytes, {} expected", p_image->texels.size(), size_bytes);
	*texture = { std::move(p_image), p_srgb, impl->next_version() };
	impl->scene.materials.for_each([&](MaterialRid p_rid, Material &r_material) {
		for (const TextureRef &ref : r_material.textures) {
			if (ref.texture == p_texture) {
				r_material.version = impl->next_version();
				impl->mark_material_users(p_rid);
				return;
			}
		}
	});
	impl->scene.skies.for_each([&](SkyRid p_rid, Sky &r_sky) {
		if (r_sky.panorama == p_texture) {
			r_sky.version = impl->next_version();
			impl->mark_sky_users(p_rid);
		}
	});
}

MaterialRid RenderingServer::material_create() {
	Material material;
	material.version = impl->next_version();
	return impl->scene.materials.make(material);
}

void RenderingServer::material_set(MaterialRid p_material, const Material &p_parameters) {
	Material *material = impl->scene.materials.get(p_material);
	ERR_FAIL_COND_MSG(material == nullptr, "no such material");
	*material = p_parameters;
	material->version = impl->next_version();
	impl->mark_material_users(p_material);
}

LightRid RenderingServer::directional_light_create() {
	Light light;
	light.type = LightType::DIRECTIONAL;
	light.version = impl->next_version();
	return impl->scene.lights.make(light);
}

LightRid RenderingServer::omni_light_create() {
	Light light;
	light.type = LightType::OMNI;
	light.version = impl->next_version();
	return impl->scene.lights.make(light);
}

LightRid RenderingServer::spot_light_create() {
	Light light;
	light.type = LightType::SPOT;
	light.version = impl->next_version();
	return impl->scene.lights.make(light);
}

void RenderingServer::light_set(LightRid p_light, const Light &p_parameters) {
	Light *light = impl->scene.lights.get(p_light);
	ERR_FAIL_COND_MSG(light == nullptr, "no such light");
	const Light old = *light;
	*light = p_parameters;
	light->type = old.type;
	light->version = impl->next_version();
	impl->mark_light_users(p_light, old);
}

const RenderScene &RenderingServer::scenario_snapshot() const {
	return impl->scene;
}

RenderingDevice *RenderingServer::get_rendering_device() const {
	return impl->device;
}

} // namespace lucent
