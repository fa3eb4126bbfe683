// SPDX-License-Identifier: MIT
#include "modules/reference/trace_sky.h"

#include "modules/reference/texture_sampling.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr float PI = 3.14159265358979f;
// Project setting rendering/environment/defaults/default_clear_color: 0.3 in sRGB.
constexpr float CLEAR_COLOR = 0.073239f;

float mean(const Vector3 &p_value) {
	return (p_value.x + p_value.y + p_value.z) / 3.0f;
}

// Turns weights into their running share; returns their sum. All zero: uniform.
double make_cdf(const double *p_weights, size_t p_count, float *r_cdf) {
	double total = 0;
	for (size_t i = 0; i < p_count; i++) {
		total += p_weights[i];
	}
	double running = 0;
	for (size_t i = 0; i < p_count; i++) {
		r_cdf[i] = total > 0 ? float(running / total) : float(i) / float(p_count);
		running += p_weights[i];
	}
	r_cdf[p_count] = 1.0f;
	return total;
}

// The interval of r_cdf that p_random falls in; p_random becomes the position within it, 0 to 1.
size_t find_interval(const float *p_cdf, size_t p_count, float &r_random) {
	const size_t i = std::clamp<ptrdiff_t>(std::upper_bound(p_cdf, p_cdf + p_count + 1, r_random) - p_cdf - 1, 0, ptrdiff_t(p_count) - 1);
	const float size = p_cdf[i + 1] - p_cdf[i];
	r_random = size > 0.0f ? (r_random - p_cdf[i]) / size : 0.5f;
	return i;
}

} // namespace

TraceSky::TraceSky(const RenderScene &p_scene, ScenarioRid p_scenario, const Camera &p_camera) {
	const Scenario *scenario = p_scene.scenarios.get(p_scenario);
	const Environment *environment = scenario ? p_scene.find_environment(*scenario, p_camera) : nullptr;
	if (!environment || environment->background == BackgroundMode::CLEAR_COLOR) {
		color = Vector3(CLEAR_COLOR) * (environment ? environment->background_energy : 1.0f);
		return;
	}
	const Sky *found = p_scene.skies.get(environment->sky);
	if (environment->background != BackgroundMode::SKY || !found) {
		color = environment->background == BackgroundMode::COLOR ? environment->background_color * environment->background_energy : Vector3(0.0f);
		return;
	}
	has_sky = true;
	sky = *found;
	energy = sky.energy_multiplier * environment->background_energy;
	world_from_sky = environment->sky_rotation;
	sky_from_world = glm::inverse(world_from_sky);
	if (sky.kind == SkyKind::PANORAMA) {
		if (const SceneTexture *texture = p_scene.textures.get(sky.panorama); texture && texture->image && !texture->image->is_empty()) {
			panorama = *texture;
			build_panorama();
		}
		return;
	}
	p_scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
		const Light *light = p_scene.lights.get(p_instance.light);
		if (light && light->type == LightType::DIRECTIONAL && p_instance.scenario == p_scenario && p_instance.visible && light->sky_mode != SkyMode::LIGHT_ONLY) {
			suns.push_back({ glm::normalize(p_instance.transform.basis[2]), light->color * light->energy, 0.5f * glm::radians(light->angular_size_degrees) });
		}
	});
}

// A texel's weight is its square's mean radiance, bilinear reading included, times the row's solid angle, with a floor so that no
// direction that shines is impossible.
void TraceSky::build_panorama() {
	panorama_ref.wrap_v = TextureWrap::CLAMP;
	width = panorama.image->width;
	height = panorama.image->height;
	row_cdf.resize(height + 1);
	texel_cdf.resize(size_t(height) * (width + 1));
	std::vector<float> values(size_t(width) * height);
	float brightest = 0;
	for (uint32_t i = 0; i < values.size(); i++) {
		values[i] = std::max(mean(Vector3(read_texel(panorama, i % width, i / width))), 0.0f);
		brightest = std::max(brightest, values[i]);
	}
	// The mean of linear interpolation over a texel: 1, 6, 1 eighths.
	const auto row_mean = [&](uint32_t p_x, uint32_t p_y) {
		const float *row = values.data() + size_t(p_y) * width;
		return 0.125f * (row[(p_x + width - 1) % width] + 6.0f * row[p_x] + row[(p_x + 1) % width]);
	};
	std::vector<double> weights(width);
	std::vector<double> rows(height);
	for (uint32_t y = 0; y < height; y++) {
		const double sine = std::sin(double(PI) * (y + 0.5) / height);
		for (uint32_t x = 0; x < width; x++) {
			const float value = 0.125f * (row_mean(x, y > 0 ? y - 1 : 0) + 6.0f * row_mean(x, y) + row_mean(x, std::min(y + 1, height - 1)));
			weights[x] = (value + 1e-6 * brightest) * sine;
		}
		rows[y] = make_cdf(weights.data(), width, texel_cdf.data() + size_t(y) * (width + 1));
	}
	if (make_cdf(rows.data(), height, row_cdf.data()) <= 0) {
		row_cdf.clear(); // a black panorama
	}
}

// u = 0 at -z and grows towards +x, v = 0 at the zenith: Godot's panorama.
Vector2 TraceSky::panorama_uv(const Vector3 &p_direction) const {
	const Vector3 direction = sky_from_world * p_direction;
	const float u = std::atan2(direction.x, -direction.z) / (2.0f * PI);
	return Vector2(u < 0.0f ? u + 1.0f : u, std::acos(glm::clamp(direction.y, -1.0f, 1.0f)) / PI);
}

Vector3 TraceSky::radiance(const Vector3 &p_direction, bool p_camera_ray) const {
	if (!has_sky) {
		return color;
	}
	if (sky.kind == SkyKind::PANORAMA) {
		return panorama.image ? Vector3(sample_texture(panorama, panorama_ref, panorama_uv(p_direction))) * energy : Vector3(0.0f);
	}
	return procedural(glm::normalize(sky_from_world * p_direction), p_camera_ray) * energy;
}

// ProceduralSkyMaterial: colours blend from the horizon by 1 - (1 - elevation / 90 degrees)^(1 / curve).
Vector3 TraceSky::procedural(const Vector3 &p_direction, bool p_camera_ray) const {
	const float elevation = 1.0f - std::acos(glm::clamp(p_direction.y, -1.0f, 1.0f)) / (0.5f * PI); // -1 to 1
	const auto blend = [](float p_from_horizon, float p_curve) {
		return glm::clamp(1.0f - std::pow(std::max(1.0f - p_from_horizon, 0.0f), 1.0f / p_curve), 0.0f, 1.0f);
	};
	if (elevation < 0.0f) {
		return glm::mix(sky.ground_horizon_color, sky.ground_bottom_color, blend(-elevation, sky.ground_curve)) * sky.ground_energy;
	}
	Vector3 value = glm::mix(sky.sky_horizon_color, sky.sky_top_color, blend(elevation, sky.sky_curve)) * sky.sky_energy;
	if (!p_camera_ray) {
		return value;
	}
	const float glow_end = glm::radians(sky.sun_angle_max_degrees);
	for (const Sun &sun : suns) {
		const float angle = std::acos(glm::clamp(glm::dot(sky_from_world * sun.direction, p_direction), -1.0f, 1.0f));
		if (angle < sun.angular_radius) {
			value = sun.radiance;
		} else if (angle < glow_end) {
			value = glm::mix(sun.radiance, value, blend((angle - sun.angular_radius) / (glow_end - sun.angular_radius), sky.sun_curve));
		}
	}
	return value;
}

DirectionSample TraceSky::sample(float p_random_u, float p_random_v) const {
	const size_t y = find_interval(row_cdf.data(), height, p_random_v);
	const size_t x = find_interval(texel_cdf.data() + y * (width + 1), width, p_random_u);
	const float theta = PI * (float(y) + p_random_v) / float(height);
	const float phi = 2.0f * PI * (float(x) + p_random_u) / float(width);
	DirectionSample result;
	result.direction = glm::normalize(world_from_sky * Vector3(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)));
	result.radiance = radiance(result.direction, false);
	result.pdf = pdf(result.direction);
	return result;
}

float TraceSky::pdf(const Vector3 &p_direction) const {
	const Vector2 uv = panorama_uv(p_direction);
	const size_t x = std::min(size_t(uv.x * float(width)), size_t(width) - 1);
	const size_t y = std::min(size_t(uv.y * float(height)), size_t(height) - 1);
	const float *texels = texel_cdf.data() + y * (width + 1);
	const float sine = std::sin(PI * uv.y);
	const float density = (row_cdf[y + 1] - row_cdf[y]) * float(height) * (texels[x + 1] - texels[x]) * float(width);
	return sine > 1e-6f ? density / (2.0f * PI * PI * sine) : 0.0f;
}

} // namespace lucent
