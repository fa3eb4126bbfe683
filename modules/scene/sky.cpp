// SPDX-License-Identifier: MIT
#include "modules/scene/sky.h"

#include "servers/core/class_builder.h"

namespace lucent::scene {

void ProceduralSkyMaterial::fill_sky(SceneContext &, lucent::Sky &r_sky) const {
	r_sky = curves;
	r_sky.kind = SkyKind::PROCEDURAL;
	r_sky.sky_top_color = srgb_to_linear(state.sky_top_color);
	r_sky.sky_horizon_color = srgb_to_linear(state.sky_horizon_color);
	r_sky.ground_bottom_color = srgb_to_linear(state.ground_bottom_color);
	r_sky.ground_horizon_color = srgb_to_linear(state.ground_horizon_color);
}

void PanoramaSkyMaterial::fill_sky(SceneContext &p_context, lucent::Sky &r_sky) const {
	r_sky.kind = SkyKind::PANORAMA;
	r_sky.energy_multiplier = state.energy_multiplier;
	r_sky.panorama = state.panorama ? state.panorama->get_rid(p_context, true) : TextureRid();
}

Sky::~Sky() {
	leave_context();
	if (material) {
		material->disconnect(material_connection);
	}
}

void Sky::set_material(const Ref<Material> &p_material) {
	if (material) {
		material->disconnect(material_connection);
	}
	material = p_material;
	if (material) {
		material_connection = material->connect(
				"changed", [this](const Array &) { state_changed(); }, this);
	}
	state_changed();
}

SkyRid Sky::get_rid(SceneContext &p_context) {
	return attach(p_context) ? rid : SkyRid();
}

void Sky::send(SceneContext &p_context) {
	if (!rid.is_valid()) {
		rid = p_context.server().sky_create();
	}
	lucent::Sky sky;
	if (const SkyMaterial *sky_material = dynamic_cast<const SkyMaterial *>(material.get())) {
		sky_material->fill_sky(p_context, sky);
	} else {
		sky.energy_multiplier = 0.0f;
	}
	p_context.server().sky_set(rid, sky);
}

void Sky::free_server_objects(RenderingServer &p_server) {
	p_server.free(rid);
	rid = {};
}

bool Sky::is_stale(SceneContext &p_context) const {
	const SkyMaterial *sky_material = dynamic_cast<const SkyMaterial *>(material.get());
	return sky_material && sky_material->is_stale(p_context);
}

void ProceduralSkyMaterial::bind(ClassBuilder<ProceduralSkyMaterial> &r_class) {
	constexpr auto S = &ProceduralSkyMaterial::state;
	r_class.doc("A gradient from the horizon to the zenith, another below, and a disc for each sun. Colours are sRGB-encoded.");
	r_class.field("sky_top_color", S, &State::sky_top_color).doc("Colour at the zenith.");
	r_class.field("sky_horizon_color", S, &State::sky_horizon_color).doc("Colour of the sky at the horizon.");
	r_class.field("ground_bottom_color", S, &State::ground_bottom_color).doc("Colour straight down.");
	r_class.field("ground_horizon_color", S, &State::ground_horizon_color).doc("Colour of the ground at the horizon.");
	constexpr auto C = &ProceduralSkyMaterial::curves;
	r_class.field("sky_curve", C, &lucent::Sky::sky_curve).range(0, 1, 0.001).doc("How fast the horizon's colour turns into the zenith's.");
	r_class.field("sky_energy_multiplier", C, &lucent::Sky::sky_energy).range(0, 64, 0.01).or_greater().doc("Multiplies the light of the upper half.");
	r_class.field("ground_curve", C, &lucent::Sky::ground_curve).range(0, 1, 0.001).doc("How fast the horizon's colour turns into the bottom's.");
	r_class.field("ground_energy_multiplier", C, &lucent::Sky::ground_energy).range(0, 64, 0.01).or_greater().doc("Multiplies the light of the lower half.");
	r_class.field("sun_angle_max", C, &lucent::Sky::sun_angle_max_degrees).range(0, 360, 0.01).doc("Where the glow around a sun ends, in degrees from its middle.");
	r_class.field("sun_curve", C, &lucent::Sky::sun_curve).range(0, 1, 0.001).doc("How fast the glow around a sun fades.");
	r_class.field("energy_multiplier", C, &lucent::Sky::energy_multiplier).range(0, 128, 0.01).or_greater().doc("Multiplies the light of the whole sky.");
}

void PanoramaSkyMaterial::bind(ClassBuilder<PanoramaSkyMaterial> &r_class) {
	r_class.doc("An equirectangular picture around the scene, as .hdr and .exr files have it.");
	r_class.field("panorama", &PanoramaSkyMaterial::state, &State::panorama).doc("The picture; twice as wide as high.");
	r_class.field("energy_multiplier", &PanoramaSkyMaterial::state, &State::energy_multiplier).range(0, 128, 0.01).or_greater().doc("Multiplies the light of the picture.");
}

void Sky::bind(ClassBuilder<Sky> &r_class) {
	r_class.doc("What is infinitely far away, and lights the scene.");
	r_class.property("sky_material", &Sky::set_material, &Sky::get_material).doc("ProceduralSkyMaterial or PanoramaSkyMaterial.");
}

} // namespace lucent::scene
