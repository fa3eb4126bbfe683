// SPDX-License-Identifier: MIT
#include "modules/scene/environment.h"

#include "modules/scene/euler.h"
#include "servers/core/class_builder.h"

#include <algorithm>

namespace lucent::scene {

// Half of a cascade's 128 cells (Godot's SDFGI::CASCADE_SIZE / 2); the properties keep it whatever the real grid is.
static constexpr float HALF_GRID_CELLS = 64.0f;

void Environment::set_sdfgi_cascades(int p_cascades) {
	sdfgi.cascades = uint32_t(std::clamp(p_cascades, 1, 8));
	state_changed();
}

void Environment::set_sdfgi_min_cell_size(float p_size_m) {
	sdfgi.min_cell_size_m = std::clamp(p_size_m, 1e-6f, 1e6f);
	state_changed();
}

void Environment::set_sdfgi_cascade0_distance(float p_distance_m) {
	set_sdfgi_min_cell_size(p_distance_m / HALF_GRID_CELLS);
}

float Environment::get_sdfgi_cascade0_distance() const {
	return sdfgi.min_cell_size_m * HALF_GRID_CELLS;
}

void Environment::set_sdfgi_max_distance(float p_distance_m) {
	set_sdfgi_min_cell_size(std::ldexp(p_distance_m / HALF_GRID_CELLS, -int(sdfgi.cascades)));
}

float Environment::get_sdfgi_max_distance() const {
	return std::ldexp(sdfgi.min_cell_size_m * HALF_GRID_CELLS, int(sdfgi.cascades));
}

EnvironmentRid Environment::get_rid(SceneContext &p_context) {
	return attach(p_context) ? rid : EnvironmentRid();
}

lucent::Environment Environment::resolve(SceneContext &p_context) const {
	lucent::Environment resolved = parameters;
	resolved.background_color = srgb_to_linear(state.background_color);
	resolved.ambient_color = srgb_to_linear(state.ambient_light_color);
	resolved.sky = state.sky ? state.sky->get_rid(p_context) : SkyRid();
	resolved.sky_rotation = basis_from_euler(state.sky_rotation, EulerOrder::YXZ);
	resolved.sdfgi = sdfgi;
	return resolved;
}

void Environment::send(SceneContext &p_context) {
	RenderingServer &server = p_context.server();
	const lucent::Environment next = resolve(p_context);
	const bool is_new = !rid.is_valid();
	if (is_new) {
		rid = server.environment_create();
	}
	// Group by group: a new exposure must not look like a new sky.
	if (is_new || next.background != sent.background) {
		server.environment_set_background(rid, next.background);
	}
	if (is_new || next.background_color != sent.background_color) {
		server.environment_set_bg_color(rid, next.background_color);
	}
	if (is_new || next.background_energy != sent.background_energy) {
		server.environment_set_bg_energy(rid, next.background_energy);
	}
	if (is_new || next.sky != sent.sky) {
		server.environment_set_sky(rid, next.sky);
	}
	if (is_new || next.sky_custom_fov_degrees != sent.sky_custom_fov_degrees) {
		server.environment_set_sky_custom_fov(rid, next.sky_custom_fov_degrees);
	}
	if (is_new || next.sky_rotation != sent.sky_rotation) {
		server.environment_set_sky_orientation(rid, next.sky_rotation);
	}
	if (is_new || next.ambient_color != sent.ambient_color || next.ambient_source != sent.ambient_source || next.ambient_energy != sent.ambient_energy || next.ambient_sky_contribution != sent.ambient_sky_contribution) {
		server.environment_set_ambient_light(rid, next.ambient_color, next.ambient_source, next.ambient_energy, next.ambient_sky_contribution);
	}
	if (is_new || next.tone_mapper != sent.tone_mapper || next.tonemap_exposure != sent.tonemap_exposure || next.tonemap_white != sent.tonemap_white) {
		server.environment_set_tonemap(rid, next.tone_mapper, next.tonemap_exposure, next.tonemap_white);
	}
	if (is_new || next.sdfgi != sent.sdfgi) {
		server.environment_set_sdfgi(rid, next.sdfgi);
	}
	sent = next;
}

void Environment::free_server_objects(RenderingServer &p_server) {
	p_server.free(rid);
	rid = {};
}

static void bind_enums(ClassBuilder<Environment> &r_class) {
	r_class.enumeration("BGMode", { { "BG_CLEAR_COLOR", BackgroundMode::CLEAR_COLOR }, { "BG_COLOR", BackgroundMode::COLOR }, { "BG_SKY", BackgroundMode::SKY }, { "BG_CANVAS", BackgroundMode::CANVAS }, { "BG_KEEP", BackgroundMode::KEEP }, { "BG_CAMERA_FEED", BackgroundMode::CAMERA_FEED } });
	r_class.enumeration("AmbientSource", { { "AMBIENT_SOURCE_BG", AmbientSource::BACKGROUND }, { "AMBIENT_SOURCE_DISABLED", AmbientSource::DISABLED }, { "AMBIENT_SOURCE_COLOR", AmbientSource::COLOR }, { "AMBIENT_SOURCE_SKY", AmbientSource::SKY } });
	r_class.enumeration("ToneMapper", { { "TONE_MAPPER_LINEAR", ToneMapper::LINEAR }, { "TONE_MAPPER_REINHARDT", ToneMapper::REINHARD }, { "TONE_MAPPER_FILMIC", ToneMapper::FILMIC }, { "TONE_MAPPER_ACES", ToneMapper::ACES }, { "TONE_MAPPER_AGX", ToneMapper::AGX } });
	r_class.enumeration("SDFGIYScale", { { "SDFGI_Y_SCALE_50_PERCENT", SdfgiYScale::SCALE_50_PERCENT }, { "SDFGI_Y_SCALE_75_PERCENT", SdfgiYScale::SCALE_75_PERCENT }, { "SDFGI_Y_SCALE_100_PERCENT", SdfgiYScale::SCALE_100_PERCENT } });
}

static void bind_sdfgi(ClassBuilder<Environment> &r_class) {
	constexpr auto G = &Environment::sdfgi;
	r_class.field("sdfgi_enabled", G, &SdfgiSettings::enabled).doc("Whether signed distance field global illumination runs.");
	r_class.field("sdfgi_use_occlusion", G, &SdfgiSettings::use_occlusion).doc("Weighs probes by what they see of a point, so that light does not leak through walls; on by default, unlike in Godot.");
	r_class.field("sdfgi_read_sky_light", G, &SdfgiSettings::read_sky_light).doc("Whether rays that leave the scene see the sky.");
	r_class.field("sdfgi_bounce_feedback", G, &SdfgiSettings::bounce_feedback).range(0, 1.99, 0.01).enforced().doc("How much of the light of one bounce feeds the next; 1 is physical and the default, unlike Godot's 0.5.");
	r_class.property("sdfgi_cascades", &Environment::set_sdfgi_cascades, &Environment::get_sdfgi_cascades).range(1, 8, 1).enforced().doc("How many cascades there are, each twice as wide as the one before.");
	r_class.property("sdfgi_min_cell_size", &Environment::set_sdfgi_min_cell_size, &Environment::get_sdfgi_min_cell_size).range(1e-6, 1e6, 1e-6).enforced().doc("Edge of a cell of the finest cascade, in metres.");
	r_class.property("sdfgi_cascade0_distance", &Environment::set_sdfgi_cascade0_distance, &Environment::get_sdfgi_cascade0_distance).range(1e-4, 16384, 1e-4).or_greater().enforced().doc("Reach of the finest cascade: 64 cells, in metres; moves with sdfgi_min_cell_size.");
	r_class.property("sdfgi_max_distance", &Environment::set_sdfgi_max_distance, &Environment::get_sdfgi_max_distance).range(1e-4, 16384, 1e-4).or_greater().enforced().doc("Reach of all cascades, in metres; moves with sdfgi_min_cell_size.");
	r_class.field("sdfgi_y_scale", G, &SdfgiSettings::y_scale).enum_of("SDFGIYScale").doc("Height of a cell in relation to its width.");
	r_class.field("sdfgi_energy", G, &SdfgiSettings::energy).range(0, 16, 0.01).or_greater().doc("Multiplies the indirect light that surfaces show.");
	r_class.field("sdfgi_normal_bias", G, &SdfgiSettings::normal_bias).range(0, 16, 0.01).or_greater().doc("How far look-ups start from the surface, in quarter cells.");
	r_class.field("sdfgi_probe_bias", G, &SdfgiSettings::probe_bias).range(0, 16, 0.01).or_greater().doc("How far a probe's rays start from it, in quarter cells.");
}

void Environment::bind(ClassBuilder<Environment> &r_class) {
	constexpr auto P = &Environment::parameters;
	using Parameters = lucent::Environment;
	r_class.doc("Background, ambient light, tone mapping and global illumination of a scene. Colours are sRGB-encoded.");
	bind_enums(r_class);
	r_class.field("background_mode", P, &Parameters::background).enum_of("BGMode").doc("What is drawn where nothing is.");
	r_class.field("background_color", &Environment::state, &State::background_color).doc("The colour of BG_COLOR.");
	r_class.field("background_energy_multiplier", P, &Parameters::background_energy).range(0, 16, 0.01).or_greater().doc("Multiplies the light of the background, the sky included.");
	r_class.field("sky", &Environment::state, &State::sky).doc("The sky of BG_SKY, and of ambient light from the sky.");
	r_class.field("sky_custom_fov", P, &Parameters::sky_custom_fov_degrees).range(0, 180, 0.1).enforced().doc("Field of view that the sky is drawn with, in degrees; 0 is the camera's.");
	r_class.field("sky_rotation", &Environment::state, &State::sky_rotation).doc("Turns the sky: Euler angles in radians.");
	r_class.field("ambient_light_source", P, &Parameters::ambient_source).enum_of("AmbientSource").doc("Where ambient light comes from.");
	r_class.field("ambient_light_color", &Environment::state, &State::ambient_light_color).doc("The colour of ambient light that is not the sky's.");
	r_class.field("ambient_light_sky_contribution", P, &Parameters::ambient_sky_contribution).range(0, 1, 0.01).doc("The sky's part in ambient light; the rest is ambient_light_color.");
	r_class.field("ambient_light_energy", P, &Parameters::ambient_energy).range(0, 16, 0.01).or_greater().doc("Multiplies ambient light.");
	r_class.field("tonemap_mode", P, &Parameters::tone_mapper).enum_of("ToneMapper").doc("The curve from scene light to the display.");
	r_class.field("tonemap_exposure", P, &Parameters::tonemap_exposure).range(0, 16, 0.01).or_greater().doc("Multiplies the picture before the curve.");
	r_class.field("tonemap_white", P, &Parameters::tonemap_white).range(0, 16, 0.01).or_greater().doc("What the curve takes to white; linear and AgX do not use it.");
	bind_sdfgi(r_class);
}

} // namespace lucent::scene
