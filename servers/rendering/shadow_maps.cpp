// SPDX-License-Identifier: MIT
#include "servers/rendering/shadow_maps.h"

#include <algorithm>
#include <cstring>

namespace lucent {

namespace {
// Godot's directional_shadow_split_1 to 3, as parts of the distance that the sun's shadows reach.
constexpr float SPLIT_ENDS[SUN_SPLITS] = { 0.1f, 0.2f, 0.5f, 1.0f };
constexpr float GUARD_TEXELS = 4.0f; // beyond a cube face's 90 degrees, for the filter's reach
constexpr uint32_t FEW_LIGHT_LAYERS = 24; // up to here, maps of 1024 x 1024

Vector3 any_up(const Vector3 &p_forward) {
	return std::abs(p_forward.y) < 0.99f ? Vector3(0, 1, 0) : Vector3(1, 0, 0);
}

// Rows: right, up, forward; no translation.
Basis light_from_world(const Vector3 &p_forward, const Vector3 &p_up) {
	const Vector3 right = glm::normalize(glm::cross(p_forward, p_up));
	return glm::transpose(Basis(right, glm::cross(right, p_forward), p_forward));
}

// A box's range along a light's axes.
AABB light_space_box(const AABB &p_box, const Basis &p_light_from_world) {
	return p_box.xform({ p_light_from_world, Vector3(0.0f) });
}

uint32_t layers_of(const shader::LightData &p_light) {
	return p_light.type == LIGHT_TYPE_DIRECTIONAL ? SUN_SPLITS : p_light.type == LIGHT_TYPE_OMNI ? 6
																								 : 1;
}

float importance(const shader::LightData &p_light) {
	return (std::abs(p_light.color.x) + std::abs(p_light.color.y) + std::abs(p_light.color.z)) * p_light.range * p_light.range;
}
} // namespace

std::vector<int> ShadowMaps::choose_lights(const GpuScene &p_scene) {
	const std::vector<shader::LightData> &lights = p_scene.lights();
	std::vector<uint32_t> order;
	for (uint32_t i = 0; i < lights.size(); i++) {
		if ((lights[i].flags & LIGHT_FLAG_SHADOW) != 0) {
			order.push_back(i);
		}
	}
	std::stable_sort(order.begin(), order.end(), [&](uint32_t p_a, uint32_t p_b) {
		const bool sun_a = lights[p_a].type == LIGHT_TYPE_DIRECTIONAL;
		const bool sun_b = lights[p_b].type == LIGHT_TYPE_DIRECTIONAL;
		return sun_a != sun_b ? sun_a : importance(lights[p_a]) > importance(lights[p_b]);
	});
	std::vector<int> indices(lights.size(), -1);
	uint32_t suns = 0;
	uint32_t layers = 0;
	for (const uint32_t i : order) {
		const bool sun = lights[i].type == LIGHT_TYPE_DIRECTIONAL;
		if (sun ? suns >= MAX_SUNS : layers + layers_of(lights[i]) > MAX_LIGHT_LAYERS) {
			log_warning_once("too many shadows", "more lights cast shadows than there is room for; the least important go without");
			continue;
		}
		indices[i] = int(suns * SUN_SPLITS + layers);
		(sun ? suns : layers) += sun ? 1 : layers_of(lights[i]);
	}
	resize_maps(suns * SUN_SPLITS, layers);
	return indices;
}

void ShadowMaps::resize_maps(uint32_t p_sun_layers, uint32_t p_light_layers) {
	TextureDesc desc;
	desc.type = TextureType::TEXTURE_2D_ARRAY;
	desc.format = Format::D32_FLOAT;
	desc.usage = TEXTURE_SAMPLED | TEXTURE_DEPTH_TARGET;
	if (!sun_texture.is_valid() || p_sun_layers > sun_layers) {
		sun_layers = p_sun_layers;
		desc.width = desc.height = p_sun_layers > 0 ? SUN_SIZE_TEXELS : 1;
		desc.layers = std::max(p_sun_layers, 1u);
		desc.name = "shadows.sun";
		sun_texture = device.create_texture(desc);
		drawn_sun.assign(desc.layers, {});
	}
	if (!light_texture.is_valid() || p_light_layers > light_layers) {
		light_layers = p_light_layers;
		light_size_texels = p_light_layers == 0 ? 1 : p_light_layers <= FEW_LIGHT_LAYERS ? 1024
																						 : 512;
		desc.width = desc.height = light_size_texels;
		desc.layers = std::max(p_light_layers, 1u);
		desc.name = "shadows.lights";
		light_texture = device.create_texture(desc);
		drawn_light.assign(desc.layers, {});
	}
}

void ShadowMaps::add_view(const Projection &p_clip_from_world, bool p_sun, uint32_t p_layer, float p_texel_size, float p_end_m) {
	Projection uv_from_clip(1.0f);
	uv_from_clip[0][0] = uv_from_clip[1][1] = uv_from_clip[3][0] = uv_from_clip[3][1] = 0.5f;
	view_values.push_back({ uv_from_clip * p_clip_from_world, p_texel_size, p_end_m, p_layer });
	planned.push_back({ p_clip_from_world, p_sun ? sun_texture.handle() : light_texture.handle(), p_layer, {} });
}

void ShadowMaps::add_sun(const GpuScene &p_scene, const shader::LightData &p_light, const Camera &p_camera, float p_aspect, float p_max_distance_m, uint32_t p_first_layer) {
	const Basis rotation = light_from_world(p_light.direction, any_up(p_light.direction));
	const AABB bounds = p_scene.bounds().is_empty() ? AABB{ Vector3(-1.0f), Vector3(1.0f) } : p_scene.bounds();
	const AABB box = light_space_box(bounds, rotation);
	// 1 cm of a scene of 10 m; at least what floats there can tell apart.
	const float margin_m = std::max(0.001f * glm::length(box.size()), 1e-6f * glm::length(box.center()) + 1e-9f);
	const Projection clip_from_view = camera_projection(p_camera, p_aspect);
	const Projection view_from_clip = glm::inverse(clip_from_view);
	const float farthest_m = -bounds.xform(p_camera.transform.affine_inverse()).min.z;
	const float reach_m = std::max(std::min(p_max_distance_m, farthest_m), p_camera.near_m * 2.0f);
	float start_m = p_camera.near_m;
	for (uint32_t split = 0; split < SUN_SPLITS; split++) {
		const float end_m = std::max(reach_m * SPLIT_ENDS[split], p_camera.near_m * 1.5f);
		AABB slice; // of the view's frustum, view space
		for (uint32_t corner = 0; corner < 8; corner++) {
			const Vector2 ndc((corner & 1) != 0 ? 1.0f : -1.0f, (corner & 2) != 0 ? 1.0f : -1.0f);
			const Vector4 near_point = view_from_clip * Vector4(ndc, 1.0f, 1.0f);
			const Vector4 mid_point = view_from_clip * Vector4(ndc, 0.5f, 1.0f);
			const Vector3 from = Vector3(near_point) / near_point.w;
			const Vector3 to = Vector3(mid_point) / mid_point.w;
			slice.expand_to(from + (to - from) * ((-(corner < 4 ? start_m : end_m) - from.z) / (to.z - from.z)));
		}
		// A sphere, so that turning the camera does not change the map's scale.
		const Vector3 center = rotation * p_camera.transform.xform(slice.center());
		const float exact_radius_m = 0.5f * glm::length(slice.size());
		const float step_m = std::exp2(std::floor(std::log2(exact_radius_m)) - 6.0f); // 1/16 m from 4 to 8 m
		const float radius_m = std::ceil(exact_radius_m / step_m) * step_m;
		Vector2 low, high;
		for (int axis = 0; axis < 2; axis++) {
			if (box.max[axis] - box.min[axis] <= 2.0f * radius_m) {
				low[axis] = box.min[axis] - margin_m;
				high[axis] = box.max[axis] + margin_m;
			} else {
				const float texel_m = 2.0f * radius_m / float(SUN_SIZE_TEXELS - 2);
				low[axis] = std::floor((center[axis] - radius_m) / texel_m) * texel_m;
				high[axis] = low[axis] + texel_m * float(SUN_SIZE_TEXELS);
			}
		}
		const float depth_margin_m = margin_m + 0.001f * (box.max.z - box.min.z);
		const Vector3 minimum(low, box.min.z - depth_margin_m);
		const Vector3 maximum(high, box.max.z + depth_margin_m);
		Projection clip_from_light(1.0f);
		for (int axis = 0; axis < 3; axis++) {
			const float extent = maximum[axis] - minimum[axis];
			clip_from_light[axis][axis] = (axis < 2 ? 2.0f : 1.0f) / extent;
			clip_from_light[3][axis] = axis < 2 ? -(maximum[axis] + minimum[axis]) / extent : -minimum[axis] / extent;
		}
		const float texel_m = std::max(high.x - low.x, high.y - low.y) / float(SUN_SIZE_TEXELS);
		const bool last = split + 1 == SUN_SPLITS;
		add_view(clip_from_light * Projection(rotation), true, p_first_layer + split, texel_m, last ? p_max_distance_m : end_m);
		start_m = end_m;
	}
}

void ShadowMaps::add_perspective(const shader::LightData &p_light, const Vector3 &p_forward, const Vector3 &p_up, float p_tan_half, uint32_t p_layer) {
	const Basis rotation = light_from_world(p_forward, p_up);
	const float near_m = std::min(0.05f, 0.01f * p_light.range);
	const float far_m = std::max(p_light.range, near_m * 2.0f);
	const float tan_half = p_tan_half * (1.0f + GUARD_TEXELS / float(light_size_texels));
	Projection clip_from_light(0.0f);
	clip_from_light[0][0] = clip_from_light[1][1] = 1.0f / tan_half;
	clip_from_light[2][2] = far_m / (far_m - near_m);
	clip_from_light[2][3] = 1.0f;
	clip_from_light[3][2] = -far_m * near_m / (far_m - near_m);
	const Projection clip_from_world = clip_from_light * Transform3D{ rotation, -(rotation * p_light.position) }.to_matrix();
	add_view(clip_from_world, false, p_layer, 2.0f * tan_half / float(light_size_texels), far_m);
}

void ShadowMaps::add_omni(const shader::LightData &p_light, uint32_t p_first_layer) {
	for (uint32_t face = 0; face < 6; face++) {
		Vector3 forward(0.0f);
		forward[int(face / 2)] = face % 2 == 0 ? 1.0f : -1.0f;
		add_perspective(p_light, forward, any_up(forward), 1.0f, p_first_layer + face);
	}
}

void ShadowMaps::add_spot(const shader::LightData &p_light, uint32_t p_layer) {
	const float cosine = std::clamp(p_light.spot_cos, 0.02f, 0.9999f);
	add_perspective(p_light, p_light.direction, any_up(p_light.direction), std::sqrt(1.0f - cosine * cosine) / cosine, p_layer);
}

void ShadowMaps::plan(GpuScene &r_scene, const RenderScene &p_scene, const Camera &p_camera, float p_aspect, uint64_t p_geometry_version, std::vector<uint32_t> &r_draw_instances) {
	const std::vector<int> indices = choose_lights(r_scene);
	r_scene.set_shadow_indices(indices);
	view_values.clear();
	planned.clear();
	draw_jobs.clear();
	std::vector<std::pair<int, uint32_t>> order; // shadow index, light
	for (uint32_t i = 0; i < indices.size(); i++) {
		if (indices[i] >= 0) {
			order.emplace_back(indices[i], i);
		}
	}
	std::sort(order.begin(), order.end());
	uint32_t light_layer = 0;
	for (const auto &[index, i] : order) {
		const shader::LightData &light = r_scene.lights()[i];
		if (light.type == LIGHT_TYPE_DIRECTIONAL) {
			const Light *source = p_scene.lights.get(r_scene.light_rids()[i]);
			add_sun(r_scene, light, p_camera, p_aspect, source != nullptr ? source->shadow_max_distance_m : 100.0f, uint32_t(index));
		} else {
			light.type == LIGHT_TYPE_OMNI ? add_omni(light, light_layer) : add_spot(light, light_layer);
			light_layer += layers_of(light);
		}
	}
	for (ShadowJob &job : planned) {
		DrawnLayer &drawn = (job.map == sun_texture.handle() ? drawn_sun : drawn_light)[job.layer];
		const DrawnLayer now = { job.clip_from_world, r_scene.origin().position_m(), p_geometry_version };
		if (drawn != now) {
			drawn = now;
			job.batches = cull_shadow_casters(r_scene, job.clip_from_world, r_draw_instances);
			draw_jobs.push_back(std::move(job));
		}
	}
	const uint64_t size_bytes = view_values.size() * sizeof(shader::ShadowView);
	const bool remade = views_buffer.reserve(device, size_bytes, BUFFER_STORAGE, "shadows.views");
	const bool same = view_values.size() == uploaded_views.size() && std::memcmp(view_values.data(), uploaded_views.data(), size_bytes) == 0;
	if (!view_values.empty() && (remade || !same)) {
		device.upload_buffer(views_buffer.buffer, view_values);
		uploaded_views = view_values;
	}
}

void draw_shadow_maps(PassRecorder &r_recorder, const SceneBindings &p_scene, const GpuAssets &p_assets, const std::vector<ShadowJob> &p_jobs) {
	for (const ShadowJob &job : p_jobs) {
		std::vector<DrawCommand> draws;
		draws.reserve(job.batches.size());
		bool any_scissor = false;
		for (const DrawBatch &batch : job.batches) {
			DrawState state;
			state.vertex_shader = batch.draw->scissor ? Shader::SHADOW_SCISSOR_VERT : Shader::SHADOW_VERT;
			state.fragment_shader = batch.draw->scissor ? Shader::SHADOW_SCISSOR_FRAG : Shader::NONE;
			// Walls of one sheet stop light from behind too, as they do in GI.
			state.cull = CullMode::NONE;
			state.depth_compare = CompareOp::LESS_OR_EQUAL;
			state.depth_clamp = true;
			DrawCommand command = make_draw(batch, p_assets, state);
			command.set_constants(shader::ShadowDrawConstants{ job.clip_from_world, batch.draw->material });
			if (batch.draw->scissor) {
				any_scissor = true;
			} else {
				command.material = BindingSetHandle();
			}
			draws.push_back(command);
		}
		RenderPass pass = r_recorder.render("shadow_maps");
		pass.depth({ job.map, 0, job.layer }, LoadOp::CLEAR, 1.0f);
		if (any_scissor) {
			pass.read(RASTER_MATERIALS, p_scene.materials);
		}
		bind_geometry(pass, p_scene).draw(draws);
	}
}

} // namespace lucent
