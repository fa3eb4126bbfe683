// SPDX-License-Identifier: MIT
#include "servers/rendering/rendering_server_impl.h"

namespace lucent {

SkyRid RenderingServer::sky_create() {
	Sky sky;
	sky.version = impl->next_version();
	return impl->scene.skies.make(sky);
}

void RenderingServer::sky_set(SkyRid p_sky, const Sky &p_parameters) {
	Sky *sky = impl->scene.skies.get(p_sky);
	ERR_FAIL_COND_MSG(sky == nullptr, "no such sky");
	*sky = p_parameters;
	sky->version = impl->next_version();
	impl->mark_sky_users(p_sky);
}

EnvironmentRid RenderingServer::environment_create() {
	Environment environment;
	environment.version = impl->next_version();
	return impl->scene.environments.make(environment);
}

template <typename F>
void RenderingServer::Impl::edit_environment(EnvironmentRid p_rid, F &&p_edit) {
	Environment *environment = scene.environments.get(p_rid);
	ERR_FAIL_COND_MSG(environment == nullptr, "no such environment");
	p_edit(*environment);
	environment->version = next_version();
	mark_environment_users(p_rid);
}

void RenderingServer::environment_set_background(EnvironmentRid p_environment, BackgroundMode p_mode) {
	impl->edit_environment(p_environment, [&](Environment &r_environment) { r_environment.background = p_mode; });
}

void RenderingServer::environment_set_bg_color(EnvironmentRid p_environment, const Vector3 &p_linear) {
	impl->edit_environment(p_environment, [&](Environment &r_environment) { r_environment.background_color = p_linear; });
}

void RenderingServer::environment_set_bg_energy(EnvironmentRid p_environment, float p_energy) {
	impl->edit_environment(p_environment, [&](Environment &r_environment) { r_environment.background_energy = p_energy; });
}

void RenderingServer::environment_set_sky(EnvironmentRid p_environment, SkyRid p_sky) {
	ERR_FAIL_COND_MSG(p_sky.is_valid() && impl->scene.skies.get(p_sky) == nullptr, "no such sky");
	impl->edit_environment(p_environment, [&](Environment &r_environment) { r_environment.sky = p_sky; });
}

void RenderingServer::environment_set_sky_custom_fov(EnvironmentRid p_environment, float p_fov_degrees) {
	ERR_FAIL_COND_MSG(!(p_fov_degrees >= 0.0f && p_fov_degrees <= 180.0f), "{} is no field of view from 0 to 180 degrees", p_fov_degrees);
	impl->edit_environment(p_environment, [&](Environment &r_environment) { r_environment.sky_custom_fov_degrees = p_fov_degrees; });
}

void RenderingServer::environment_set_sky_orientation(EnvironmentRid p_environment, const Basis &p_orientation) {
	impl->edit_environment(p_environment, [&](Environment &r_environment) { r_environment.sky_rotation = p_orientation; });
}

void RenderingServer::environment_set_ambient_light(EnvironmentRid p_environment, const Vector3 &p_linear, AmbientSource p_source, float p_energy, float p_sky_contribution) {
	impl->edit_environment(p_environment, [&](Environment &r_environment) {
		r_environment.ambient_color = p_linear;
		r_environment.ambient_source = p_source;
		r_environment.ambient_energy = p_energy;
		r_environment.ambient_sky_contribution = p_sky_contribution;
	});
}

void RenderingServer::environment_set_tonemap(EnvironmentRid p_environment, ToneMapper p_tone_mapper, float p_exposure, float p_white) {
	Environment *environment = impl->scene.environments.get(p_environment);
	ERR_FAIL_COND_MSG(environment == nullptr, "no such environment");
	environment->tone_mapper = p_tone_mapper;
	environment->tonemap_exposure = p_exposure;
	environment->tonemap_white = p_white;
}

void RenderingServer::environment_set_sdfgi(EnvironmentRid p_environment, const SdfgiSettings &p_settings) {
	const std::string wrong = sdfgi_settings_error(p_settings);
	ERR_FAIL_COND_MSG(!wrong.empty(), "{}", wrong);
	Environment *environment = impl->scene.environments.get(p_environment);
	ERR_FAIL_COND_MSG(environment == nullptr, "no such environment");
	// No light changes: SDFGI itself knows what a setting of its own starts anew.
	environment->sdfgi = p_settings;
	environment->version = impl->next_version();
	impl->scene.version++;
}

CameraRid RenderingServer::camera_create() {
	return impl->scene.cameras.make(Camera());
}

void RenderingServer::camera_set(CameraRid p_camera, const Camera &p_parameters) {
	Camera *camera = impl->scene.cameras.get(p_camera);
	ERR_FAIL_COND_MSG(camera == nullptr, "no such camera");
	*camera = p_parameters;
}

void RenderingServer::camera_set_transform(CameraRid p_camera, const Transform3D &p_transform) {
	Camera *camera = impl->scene.cameras.get(p_camera);
	ERR_FAIL_COND_MSG(camera == nullptr, "no such camera");
	camera->transform = p_transform;
}

} // namespace lucent
