// SPDX-License-Identifier: MIT
#include "servers/rendering/gpu_scene.h"

#include <algorithm>
#include <cstring>
#include <tuple>

namespace lucent {

namespace {
MaterialRid resolve_material(const RenderScene &p_scene, const Instance &p_instance, const MeshSurface &p_surface, uint32_t p_index) {
	if (p_scene.materials.get(p_instance.material_override) != nullptr) {
		return p_instance.material_override;
	}
	if (p_index < p_instance.surface_override_materials.size() && p_scene.materials.get(p_instance.surface_override_materials[p_index]) != nullptr) {
		return p_instance.surface_override_materials[p_index];
	}
	return p_scene.materials.get(p_surface.material) != nullptr ? p_surface.material : MaterialRid();
}

void store_rows(const Transform3D &p_transform, Vector4 *r_rows) {
	for (int row = 0; row < 3; row++) {
		r_rows[row] = Vector4(p_transform.basis[0][row], p_transform.basis[1][row], p_transform.basis[2][row], p_transform.origin[row]);
	}
}

shader::LightData light_data(const Light &p_light, const Transform3D &p_transform) {
	shader::LightData data{};
	const float z_length = glm::length(p_transform.basis[2]);
	data.position = p_transform.origin;
	data.direction = z_length > 0.0f ? -p_transform.basis[2] / z_length : Vector3(0, 0, -1);
	data.range = std::max(p_light.range_m, 1e-3f);
	data.attenuation = p_light.attenuation;
	data.color = p_light.color * p_light.energy * (p_light.negative ? -1.0f : 1.0f);
	data.indirect_energy = p_light.indirect_energy;
	data.specular = p_light.specular_scale();
	data.spot_cos = std::cos(glm::radians(p_light.spot_angle_degrees));
	data.spot_exponent = p_light.spot_exponent();
	data.angular_radius = glm::radians(p_light.angular_size_degrees);
	data.size = p_light.size_m;
	data.shadow_bias = p_light.shadow_bias;
	data.shadow_normal_bias = p_light.shadow_normal_bias;
	data.shadow_opacity = p_light.shadow_opacity;
	data.type = uint32_t(p_light.type);
	const bool sky_only = p_light.type == LightType::DIRECTIONAL && p_light.sky_mode == SkyMode::SKY_ONLY;
	data.flags |= p_light.shadow_enabled ? LIGHT_FLAG_SHADOW : 0;
	data.flags |= p_light.bake_mode != LightBakeMode::DISABLED && !sky_only ? LIGHT_FLAG_GI : 0;
	data.shadow_index = -1;
	return data;
}

// Uploads what differs from p_old, all of it where the buffer was remade.
template <typename T>
void upload_changes(RenderingDevice &p_device, BufferHandle p_buffer, bool p_remade, const std::vector<T> &p_values, std::vector<T> &r_old) {
	size_t first = 0;
	size_t last = p_values.size();
	const auto same = [&](size_t p_index) { return p_index < r_old.size() && std::memcmp(&p_values[p_index], &r_old[p_index], sizeof(T)) == 0; };
	while (!p_remade && first < last && same(first)) {
		first++;
	}
	while (!p_remade && last > first && same(last - 1)) {
		last--;
	}
	if (last > first) {
		p_device.upload_buffer(p_buffer, first * sizeof(T), std::as_bytes(std::span(&p_values[first], last - first)));
	}
	r_old = p_values;
}

auto draw_order(const SceneDraw &p_draw) {
	return std::tuple(p_draw.transparent, p_draw.scissor, p_draw.cull, p_draw.mirrored, p_draw.material, p_draw.geometry.first_index, p_draw.instance);
}
} // namespace

void GpuScene::collect_instance(const RenderScene &p_scene, const GpuAssets &p_assets, const Instance &p_instance, const Mesh &p_mesh) {
	shader::InstanceData data{};
	const Transform3D transform = render_origin.render_from_world(p_instance.transform);
	store_rows(transform, data.world_from_local);
	store_rows(render_origin.render_from_world(p_instance.previous_transform), data.previous_world_from_local);
	const bool mirrored = glm::determinant(transform.basis) < 0.0f;
	data.flags = mirrored ? INSTANCE_FLAG_MIRRORED : 0;
	data.transparency = p_instance.transparency;
	const AABB box = p_mesh.aabb.xform(transform);
	scene_bounds.merge_with(box);
	const Material default_material;
	for (uint32_t i = 0; i < p_mesh.surfaces.size(); i++) {
		const MaterialRid rid = resolve_material(p_scene, p_instance, *p_mesh.surfaces[i], i);
		const Material *material = rid.is_valid() ? p_scene.materials.get(rid) : &default_material;
		SceneDraw draw;
		draw.geometry = p_assets.surface(p_mesh.surfaces[i].get());
		draw.instance = uint32_t(instance_values.size());
		draw.material = rid.is_valid() ? GpuAssets::material_index(rid) : GpuAssets::DEFAULT_MATERIAL;
		draw.layers = p_instance.layers;
		draw.cull = material->cull;
		draw.blend = material->blend;
		draw.mirrored = mirrored;
		draw.transparent = material->transparency == TransparencyMode::ALPHA_BLEND || material->blend != MaterialBlend::MIX || p_instance.transparency > 0.0f;
		draw.scissor = material->transparency == TransparencyMode::ALPHA_SCISSOR;
		draw.drawn = p_instance.shadow_casting != ShadowCasting::SHADOWS_ONLY;
		draw.casts_shadow = p_instance.shadow_casting != ShadowCasting::OFF && !draw.transparent;
		draw.render_priority = material->render_priority;
		draw.box = box;
		scene_draws.push_back(draw);
		if (p_instance.gi_mode == GiMode::STATIC && draw.drawn) {
			view.gi_surfaces.push_back({ view.gi_triangle_count, view.gi_triangle_count, draw.geometry.first_index, draw.geometry.vertex_offset, draw.instance, draw.material });
			view.gi_surface_boxes.push_back(box);
			view.gi_triangle_count += draw.geometry.index_count / 3;
		}
	}
	instance_values.push_back(data);
}

void GpuScene::collect_lights(const RenderScene &p_scene) {
	light_values.clear();
	light_ids.clear();
	for (const bool gi : { true, false }) {
		p_scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
			const Light *light = p_scene.lights.get(p_instance.light);
			if (light == nullptr || p_instance.scenario != scenario_rid || !p_instance.visible) {
				return;
			}
			const shader::LightData data = light_data(*light, render_origin.render_from_world(p_instance.transform));
			if (((data.flags & LIGHT_FLAG_GI) != 0) == gi) {
				light_values.push_back(data);
				light_ids.push_back(p_instance.light);
			}
		});
		if (gi) {
			view.light_count = uint32_t(light_values.size());
		}
	}
}

void GpuScene::collect(const RenderScene &p_scene, const GpuAssets &p_assets) {
	scene_draws.clear();
	instance_values.clear();
	scene_bounds = AABB();
	view.gi_surfaces.clear();
	view.gi_surface_boxes.clear();
	view.gi_triangle_count = 0;
	p_scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
		const Mesh *mesh = p_scene.meshes.get(p_instance.mesh);
		if (mesh != nullptr && p_instance.scenario == scenario_rid && p_instance.visible) {
			collect_instance(p_scene, p_assets, p_instance, *mesh);
		}
	});
	std::sort(scene_draws.begin(), scene_draws.end(), [](const SceneDraw &p_a, const SceneDraw &p_b) { return draw_order(p_a) < draw_order(p_b); });
	collect_lights(p_scene);
}

void GpuScene::update(const RenderScene &p_scene, const GpuAssets &p_assets, const RenderOrigin &p_origin) {
	const Scenario *scenario = p_scene.scenarios.get(scenario_rid);
	if (scenario == nullptr || (scene_version == p_scene.version && render_origin.position_m() == p_origin.position_m())) {
		return;
	}
	render_origin = p_origin;
	scene_version = p_scene.version;
	collect(p_scene, p_assets);
	const bool remade = instances_buffer.reserve(device, instance_values.size() * sizeof(shader::InstanceData), BUFFER_STORAGE, "scene.instances");
	upload_changes(device, instances_buffer.buffer, remade, instance_values, uploaded_instances);
	upload_lights();
	view.positions = p_assets.positions();
	view.attributes = p_assets.attributes();
	view.indices = p_assets.indices();
	view.instances = instances_buffer.buffer;
	view.materials = p_assets.material_buffer();
	view.gi_textures = p_assets.gi_textures();
	view.gi_sampler = device.sampler({ .max_lod = 0.0f });
	view.geometry_version = scenario->geometry_version;
	view.light_version = scenario->light_version;
}

void GpuScene::upload_lights() {
	const bool remade = lights_buffer.reserve(device, light_values.size() * sizeof(shader::LightData), BUFFER_STORAGE, "scene.lights");
	upload_changes(device, lights_buffer.buffer, remade, light_values, uploaded_lights);
	view.lights = lights_buffer.buffer;
}

void GpuScene::set_shadow_indices(const std::vector<int> &p_shadow_indices) {
	for (size_t i = 0; i < light_values.size(); i++) {
		light_values[i].shadow_index = p_shadow_indices[i];
	}
	upload_lights();
}

} // namespace lucent
