// SPDX-License-Identifier: MIT
#include "modules/scene/light_3d.h"

#include "servers/core/class_builder.h"

namespace lucent::scene {

OmniLight3D::OmniLight3D() :
		Light3D(LightType::OMNI) {
	parameters.specular = 0.5f;
	parameters.shadow_normal_bias = 1.0f;
}

SpotLight3D::SpotLight3D() :
		Light3D(LightType::SPOT) {
	parameters.specular = 0.5f;
	parameters.shadow_bias = 0.03f;
	parameters.shadow_normal_bias = 1.0f;
}

void Light3D::set_color(const Color &p_srgb) {
	color = p_srgb;
	state_changed();
}

void Light3D::set_editor_only(bool p_editor_only) {
	editor_only = p_editor_only;
	update_visibility();
}

void Light3D::set_parameters(const lucent::Light &p_parameters) {
	const LightType type = parameters.type;
	parameters = p_parameters;
	parameters.type = type;
	state_changed();
}

void Light3D::state_changed() {
	if (get_context()) {
		lucent::Light sent = parameters;
		sent.color = srgb_to_linear(color);
		get_context()->server().light_set(light, sent);
	}
}

void Light3D::send_instance(RenderingServer &p_server) {
	switch (parameters.type) {
		case LightType::DIRECTIONAL:
			light = p_server.directional_light_create();
			break;
		case LightType::OMNI:
			light = p_server.omni_light_create();
			break;
		case LightType::SPOT:
			light = p_server.spot_light_create();
			break;
	}
	state_changed();
	p_server.instance_set_base(get_instance(), light);
}

void Light3D::free_base(RenderingServer &p_server) {
	p_server.free(light);
	light = {};
}

void Light3D::bind(ClassBuilder<Light3D> &r_class) {
	constexpr auto P = &Light3D::parameters;
	using Light = lucent::Light;
	r_class.doc("Base of all lights; they shine along their -z.");
	r_class.enumeration("BakeMode", { { "BAKE_DISABLED", LightBakeMode::DISABLED }, { "BAKE_STATIC", LightBakeMode::STATIC }, { "BAKE_DYNAMIC", LightBakeMode::DYNAMIC } });
	r_class.property("light_color", &Light3D::set_color, &Light3D::get_color).doc("The colour, sRGB-encoded.");
	r_class.field("light_energy", P, &Light::energy).range(0, 16, 0.001).or_greater().doc("Multiplies the light; 1 makes a white surface that faces it white.");
	r_class.field("light_indirect_energy", P, &Light::indirect_energy).range(0, 16, 0.001).or_greater().doc("Multiplies the light's part in global illumination.");
	r_class.field("light_angular_distance", P, &Light::angular_size_degrees).range(0, 90, 0.01).enforced().doc("How wide a sun looks, in degrees; its shadows soften with it.");
	r_class.field("light_size", P, &Light::size_m).range(0, 1, 0.001).or_greater().doc("Radius of a lamp, in metres; its shadows soften with it.");
	r_class.field("light_negative", P, &Light::negative).doc("Takes light away, no more than there is.");
	r_class.field("light_specular", P, &Light::specular).range(0, 16, 0.001).or_greater().doc("Multiplies the light's highlights; omni and spot lights have them in full at 0.5.");
	r_class.field("light_bake_mode", P, &Light::bake_mode).enum_of("BakeMode").doc("A disabled light has no part in global illumination.");
	r_class.field("shadow_enabled", P, &Light::shadow_enabled).doc("Whether the light that falls on what is seen casts shadows; in global illumination every light does.");
	r_class.field("shadow_bias", P, &Light::shadow_bias).range(0, 10, 0.001).doc("Moves shadows away from their casters, against acne.");
	r_class.field("shadow_normal_bias", P, &Light::shadow_normal_bias).range(0, 10, 0.001).doc("Moves look-ups along the normal, in texels of the shadow map.");
	r_class.field("shadow_opacity", P, &Light::shadow_opacity).range(0, 1, 0.01).enforced().doc("How dark shadows are.");
	r_class.property("editor_only", &Light3D::set_editor_only, &Light3D::is_editor_only).doc("Keeps the light out of pictures.");
}

void DirectionalLight3D::bind(ClassBuilder<DirectionalLight3D> &r_class) {
	r_class.doc("A sun: parallel rays from far away.");
	r_class.enumeration("SkyMode", { { "SKY_MODE_LIGHT_AND_SKY", SkyMode::LIGHT_AND_SKY }, { "SKY_MODE_LIGHT_ONLY", SkyMode::LIGHT_ONLY }, { "SKY_MODE_SKY_ONLY", SkyMode::SKY_ONLY } });
	r_class.field("directional_shadow_max_distance", &DirectionalLight3D::parameters, &lucent::Light::shadow_max_distance_m).range(0, 8192, 0.1).or_greater().doc("How far from the camera shadows are drawn, in metres.");
	r_class.field("sky_mode", &DirectionalLight3D::parameters, &lucent::Light::sky_mode).enum_of("SkyMode").doc("Whether the sun lights the scene, shows in the sky, or both.");
}

void OmniLight3D::bind(ClassBuilder<OmniLight3D> &r_class) {
	r_class.doc("A lamp that shines to all sides.");
	r_class.field("omni_range", &OmniLight3D::parameters, &lucent::Light::range_m).range(0, 4096, 0.001).or_greater().doc("Where the light ends, in metres.");
	r_class.field("omni_attenuation", &OmniLight3D::parameters, &lucent::Light::attenuation).range(-10, 10, 0.001).doc("The exponent of the falloff with distance; 2 is physical.");
}

void SpotLight3D::bind(ClassBuilder<SpotLight3D> &r_class) {
	r_class.doc("A lamp that shines in a cone around its -z.");
	r_class.field("spot_range", &SpotLight3D::parameters, &lucent::Light::range_m).range(0, 4096, 0.001).or_greater().doc("Where the light ends, in metres.");
	r_class.field("spot_attenuation", &SpotLight3D::parameters, &lucent::Light::attenuation).range(-10, 10, 0.001).doc("The exponent of the falloff with distance; 2 is physical.");
	r_class.field("spot_angle", &SpotLight3D::parameters, &lucent::Light::spot_angle_degrees).range(0, 180, 0.01).enforced().doc("Half of the cone's opening, in degrees.");
	r_class.field("spot_angle_attenuation", &SpotLight3D::parameters, &lucent::Light::spot_attenuation).range(0, 10, 0.001).or_greater().doc("How the light fades towards the cone's edge.");
}

} // namespace lucent::scene
