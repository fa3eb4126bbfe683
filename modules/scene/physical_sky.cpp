// SPDX-License-Identifier: MIT
#include "modules/scene/sky.h"
#include "servers/core/class_builder.h"

#include <algorithm>
#include <cstring>
#include <numbers>

namespace lucent::scene {

namespace {

constexpr float PI = std::numbers::pi_v<float>;
constexpr uint32_t WIDTH = 512; // texels of 0.7 degrees
constexpr uint32_t HEIGHT = 256;
constexpr float RAYLEIGH_HEIGHT_M = 8.4e3f; // optical depth of the air straight up
constexpr float MIE_HEIGHT_M = 1.25e3f; // and of the haze

float smooth_step(float p_from, float p_to, float p_value) {
	const float t = glm::clamp((p_value - p_from) / (p_to - p_from), 0.0f, 1.0f);
	return t * t * (3.0f - 2.0f * t);
}

// Henyey and Greenstein 1941.
float mie_phase(float p_cosine, float p_g) {
	return (1.0f - p_g * p_g) / (4.0f * PI * std::pow(std::max(1.0f + p_g * p_g - 2.0f * p_g * p_cosine, 1e-6f), 1.5f));
}

} // namespace

Vector3 PhysicalSkyMaterial::radiance(const Vector3 &p_direction, const Sun &p_sun) const {
	if (p_sun.direction == Vector3(0.0f)) {
		return Vector3(0.0f);
	}
	const float sun_height = glm::clamp(p_sun.direction.y, -1.0f, 1.0f); // cosine to the zenith
	const float sun_energy = std::max(0.0f, 0.757f * sun_height) * p_sun.energy;
	const float sun_fade = 1.0f - glm::clamp(1.0f - std::exp(sun_height), 0.0f, 1.0f);
	const Vector3 rayleigh = std::max(state.rayleigh_coefficient - (1.0f - sun_fade), 0.0f) * srgb_to_linear(state.rayleigh_color) * 1e-4f; // a metre
	const Vector3 mie = state.turbidity * state.mie_coefficient * srgb_to_linear(state.mie_color) * 4.34e-4f;
	// Kasten's relative air mass, with a line through its angle.
	const float height = std::max(p_direction.y, 0.0f);
	const float air_mass = 1.0f / (height + 0.15f * std::pow(3.885f + 54.5f * height, -1.253f));
	const Vector3 extinction = glm::exp(-(rayleigh * RAYLEIGH_HEIGHT_M + mie * MIE_HEIGHT_M) * air_mass);
	const float cosine = glm::dot(p_direction, p_sun.direction);
	const float towards = cosine * 0.5f + 0.5f;
	const Vector3 scattered = rayleigh * (3.0f / (16.0f * PI)) * (1.0f + towards * towards) + mie * mie_phase(cosine, state.mie_eccentricity);
	const Vector3 ratio = sun_energy * scattered / glm::max(rayleigh + mie, Vector3(1e-12f));
	Vector3 light = glm::pow(ratio * (1.0f - extinction), Vector3(1.5f));
	const float low_sun = glm::clamp(std::pow(1.0f - sun_height, 5.0f), 0.0f, 1.0f);
	light *= glm::mix(Vector3(1.0f), glm::sqrt(ratio * extinction), low_sun);
	light *= glm::mix(srgb_to_linear(state.ground_color), Vector3(1.0f), smooth_step(-0.1f, 0.1f, p_direction.y));
	return glm::pow(light, Vector3(1.0f / (1.2f + 1.2f * sun_fade))) * state.energy_multiplier;
}

PhysicalSkyMaterial::Sun PhysicalSkyMaterial::find_sun(SceneContext &p_context) {
	const RenderScene &scene = p_context.server().scenario_snapshot();
	Sun sun;
	scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
		const lucent::Light *light = scene.lights.get(p_instance.light);
		if (light != nullptr && sun.direction == Vector3(0.0f) && p_instance.visible && light->type == LightType::DIRECTIONAL && light->sky_mode != SkyMode::LIGHT_ONLY) {
			const Vector3 back = p_instance.transform.basis[2];
			sun = { glm::length(back) > 0.0f ? glm::normalize(back) : Vector3(0, 0, 1), light->energy };
		}
	});
	return sun;
}

void PhysicalSkyMaterial::fill_sky(SceneContext &p_context, lucent::Sky &r_sky) const {
	drawn_sun = find_sun(p_context);
	auto image = std::make_shared<Image>(Image{ ImageFormat::RGBA32F, WIDTH, HEIGHT, std::vector<std::byte>(size_t(WIDTH) * HEIGHT * 16) });
	for (uint32_t y = 0; y < HEIGHT; y++) {
		for (uint32_t x = 0; x < WIDTH; x++) {
			const float longitude = 2.0f * PI * (float(x) + 0.5f) / float(WIDTH); // from -z towards +x
			const float polar = PI * (float(y) + 0.5f) / float(HEIGHT);
			const Vector4 texel(radiance({ std::sin(longitude) * std::sin(polar), std::cos(polar), -std::cos(longitude) * std::sin(polar) }, drawn_sun), 1.0f);
			std::memcpy(image->texels.data() + (size_t(y) * WIDTH + x) * 16, &texel, 16);
		}
	}
	panorama->set_image(std::move(image));
	const bool is_night = drawn_sun.direction == Vector3(0.0f) && state.night_sky;
	r_sky.kind = SkyKind::PANORAMA;
	r_sky.energy_multiplier = is_night ? state.energy_multiplier : 1.0f;
	r_sky.panorama = is_night ? state.night_sky->get_rid(p_context, true) : panorama->get_rid(p_context, false);
}

void PhysicalSkyMaterial::bind(ClassBuilder<PhysicalSkyMaterial> &r_class) {
	constexpr auto S = &PhysicalSkyMaterial::state;
	r_class.doc("A sky as air and haze scatter it from the first sun. Without a sun it is night. Colours are sRGB-encoded.");
	r_class.field("rayleigh_coefficient", S, &State::rayleigh_coefficient).range(0, 64, 0.01).doc("How much the air scatters: the blue of the sky.");
	r_class.field("rayleigh_color", S, &State::rayleigh_color).doc("The colour that the air scatters.");
	r_class.field("mie_coefficient", S, &State::mie_coefficient).range(0, 1, 0.001).doc("How much the haze scatters: the white around the sun and at the horizon.");
	r_class.field("mie_eccentricity", S, &State::mie_eccentricity).range(-1, 1, 0.01).doc("Where the haze scatters to: 1 is on, 0 everywhere, -1 back.");
	r_class.field("mie_color", S, &State::mie_color).doc("The colour that the haze scatters.");
	r_class.field("turbidity", S, &State::turbidity).range(0, 1000, 0.01).doc("How thick the haze is.");
	r_class.field("sun_disk_scale", S, &State::sun_disk_scale).range(0, 360, 0.01).doc("Size of the sun's disc, which is not drawn here.");
	r_class.field("ground_color", S, &State::ground_color).doc("Multiplies the light below the horizon.");
	r_class.field("energy_multiplier", S, &State::energy_multiplier).range(0, 128, 0.01).doc("Multiplies the light of the whole sky.");
	r_class.field("use_debanding", S, &State::use_debanding).doc("Without effect here: the sky has no bands to hide.");
	r_class.field("night_sky", S, &State::night_sky).doc("A panorama that shows where there is no sun.");
}

} // namespace lucent::scene
