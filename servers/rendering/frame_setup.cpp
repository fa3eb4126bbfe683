// SPDX-License-Identifier: MIT
#include "servers/rendering/frame_setup.h"

#include <algorithm>

namespace lucent {

namespace {
// Godot's rendering/environment/defaults/default_clear_color, 0.3 in sRGB.
const Vector3 DEFAULT_CLEAR_COLOR(0.0732f);
constexpr float CLUSTER_NEAR_M = 0.25f;

Vector3 background_color(const Environment &p_environment) {
	return (p_environment.background == BackgroundMode::COLOR ? p_environment.background_color : DEFAULT_CLEAR_COLOR) * p_environment.background_energy;
}

const Sky *background_sky(const RenderScene &p_scene, const Environment &p_environment) {
	return p_environment.background == BackgroundMode::SKY ? p_scene.skies.get(p_environment.sky) : nullptr;
}

// Godot: a colour, a sky, or a mix of both by ambient_light_sky_contribution.
void set_ambient(const RenderScene &p_scene, const Environment &p_environment, shader::FrameData &r_frame) {
	const Vector3 color = p_environment.ambient_color * p_environment.ambient_energy;
	const bool has_sky = p_scene.skies.get(p_environment.sky) != nullptr;
	switch (p_environment.ambient_source) {
		case AmbientSource::DISABLED:
			return;
		case AmbientSource::COLOR:
			r_frame.ambient_color = color;
			return;
		case AmbientSource::BACKGROUND:
			if (p_environment.background != BackgroundMode::SKY) {
				const bool has_background = p_environment.background == BackgroundMode::COLOR || p_environment.background == BackgroundMode::CLEAR_COLOR;
				r_frame.ambient_color = has_background ? background_color(p_environment) : color;
				return;
			}
			break;
		case AmbientSource::SKY:
			break;
	}
	r_frame.ambient_color = color;
	r_frame.ambient_sky_mix = has_sky ? std::clamp(p_environment.ambient_sky_contribution, 0.0f, 1.0f) : 0.0f;
	r_frame.ambient_sky_energy = 1.0f;
}

void set_sky_suns(const RenderScene &p_scene, const GpuScene &p_gpu_scene, shader::SkyData &r_sky) {
	const std::vector<shader::LightData> &lights = p_gpu_scene.lights();
	for (size_t i = 0; i < lights.size() && r_sky.sun_count < MAX_SKY_SUNS; i++) {
		const Light *light = p_scene.lights.get(p_gpu_scene.light_rids()[i]);
		if (light != nullptr && lights[i].type == LIGHT_TYPE_DIRECTIONAL && light->sky_mode != SkyMode::LIGHT_ONLY) {
			r_sky.suns[r_sky.sun_count++] = { -lights[i].direction, std::cos(lights[i].angular_radius), lights[i].color };
		}
	}
}

shader::SkyData make_sky(const RenderScene &p_scene, const GpuScene &p_gpu_scene, const Environment &p_environment, const Camera &p_camera, float p_aspect) {
	shader::SkyData data{};
	Camera camera = p_camera;
	const Sky *sky = background_sky(p_scene, p_environment);
	if (sky != nullptr && p_environment.sky_custom_fov_degrees > 0.0f) {
		// As in Godot: a vertical angle, whatever the camera's projection is. 180 degrees have no tangent.
		camera.kind = Camera::Kind::PERSPECTIVE;
		camera.keep_height = true;
		camera.fov_degrees = std::min(p_environment.sky_custom_fov_degrees, 179.0f);
	}
	const Projection view_from_world = Projection(glm::transpose(camera.transform.basis));
	data.world_direction_from_clip = glm::inverse(camera_projection(camera, p_aspect) * view_from_world);
	data.sky_from_world = Projection(glm::transpose(p_environment.sky_rotation));
	data.color = background_color(p_environment);
	data.kind = SKY_KIND_COLOR;
	if (sky == nullptr) {
		return data;
	}
	data.kind = sky->kind == SkyKind::PANORAMA ? SKY_KIND_PANORAMA : SKY_KIND_PROCEDURAL;
	data.energy = sky->energy_multiplier * p_environment.background_energy;
	data.sky_top = sky->sky_top_color * sky->sky_energy;
	data.sky_horizon = sky->sky_horizon_color * sky->sky_energy;
	data.ground_bottom = sky->ground_bottom_color * sky->ground_energy;
	data.ground_horizon = sky->ground_horizon_color * sky->ground_energy;
	// The exponents that Godot 4's ProceduralSkyMaterial derives from its curves.
	data.inverse_sky_curve = 0.6f / std::max(sky->sky_curve, 1e-4f);
	data.inverse_ground_curve = 0.6f / std::max(sky->ground_curve, 1e-4f);
	data.inverse_sun_curve = 1.6f / std::pow(std::max(sky->sun_curve, 1e-4f), 1.4f);
	data.cos_sun_angle_max = std::cos(glm::radians(sky->sun_angle_max_degrees));
	set_sky_suns(p_scene, p_gpu_scene, data);
	return data;
}

void set_lights(const RenderScene &p_scene, const GpuScene &p_gpu_scene, FrameSetup &r_setup) {
	shader::FrameData &frame = r_setup.frame;
	const std::vector<shader::LightData> &lights = p_gpu_scene.lights();
	float reach_m = CLUSTER_NEAR_M * 2.0f;
	bool any_positional = false;
	for (uint32_t i = 0; i < lights.size(); i++) {
		const Light *light = p_scene.lights.get(p_gpu_scene.light_rids()[i]);
		if (lights[i].type != LIGHT_TYPE_DIRECTIONAL) {
			any_positional = true;
			const Vector4 center = frame.views[0].view_from_world * Vector4(lights[i].position, 1.0f);
			reach_m = std::max(reach_m, -center.z + lights[i].range);
		} else if (frame.directional_count < MAX_DIRECTIONAL_LIGHTS && light != nullptr && light->sky_mode != SkyMode::SKY_ONLY) {
			frame.directional_lights[frame.directional_count++] = i;
		}
	}
	if (lights.size() > MAX_CLUSTER_WORDS * 32) {
		log_warning_once("too many lights", fmt::format("only the first {} lights light surfaces directly", MAX_CLUSTER_WORDS * 32));
	}
	frame.cluster_count = { (frame.size_pixels.x + CLUSTER_TILE_PIXELS - 1) / CLUSTER_TILE_PIXELS, (frame.size_pixels.y + CLUSTER_TILE_PIXELS - 1) / CLUSTER_TILE_PIXELS, CLUSTER_SLICES };
	frame.cluster_words = any_positional ? std::min<uint32_t>(uint32_t(lights.size() + 31) / 32, MAX_CLUSTER_WORDS) : 0;
	frame.cluster_near_m = CLUSTER_NEAR_M;
	frame.cluster_slices_per_log2 = float(CLUSTER_SLICES) / std::log2(reach_m / CLUSTER_NEAR_M);
	r_setup.clusters = { glm::inverse(r_setup.clip_from_view), uint32_t(lights.size()) };
	r_setup.cluster_mask_count = frame.cluster_count.x * frame.cluster_count.y * frame.cluster_count.z * frame.cluster_words;
}
} // namespace

const Environment &find_environment(const RenderScene &p_scene, const Scenario &p_scenario, const Camera &p_camera) {
	static const Environment none = [] {
		Environment environment;
		environment.ambient_source = AmbientSource::DISABLED;
		return environment;
	}();
	const Environment *environment = p_scene.find_environment(p_scenario, p_camera);
	return environment != nullptr ? *environment : none;
}

FrameSetup make_frame_setup(const RenderScene &p_scene, const Viewport &p_viewport, const Scenario &p_scenario, const Camera &p_camera, const GpuScene &p_gpu_scene) {
	FrameSetup setup;
	setup.environment = &find_environment(p_scene, p_scenario, p_camera);
	setup.aspect = float(p_viewport.width) / float(p_viewport.height);
	setup.clip_from_view = camera_projection(p_camera, setup.aspect);
	shader::ViewData &view = setup.frame.views[0];
	view.view_from_world = p_camera.transform.affine_inverse().to_matrix();
	setup.clip_from_world = setup.clip_from_view * view.view_from_world;
	view.clip_from_world = view.previous_clip_from_world = setup.clip_from_world;
	view.world_from_clip = glm::inverse(setup.clip_from_world);
	view.camera_position = p_camera.transform.origin;
	view.camera_back = glm::normalize(p_camera.transform.basis[2]);
	view.orthogonal = p_camera.kind == Camera::Kind::ORTHOGONAL ? 1 : 0;
	setup.frame.size_pixels = { p_viewport.width, p_viewport.height };
	set_ambient(p_scene, *setup.environment, setup.frame);
	set_lights(p_scene, p_gpu_scene, setup);
	setup.sky = make_sky(p_scene, p_gpu_scene, *setup.environment, p_camera, setup.aspect);
	if (const Sky *sky = background_sky(p_scene, *setup.environment)) {
		setup.panorama = sky->panorama;
	}
	setup.tonemap = { uint32_t(setup.environment->tone_mapper), setup.environment->tonemap_exposure * p_camera.exposure_multiplier, std::max(setup.environment->tonemap_white, 1e-3f) };
	return setup;
}

} // namespace lucent
