// SPDX-License-Identifier: MIT
#include "modules/reference/light_sampler.h"

#include "modules/reference/brdf_sampling.h"
#include "servers/rendering/shaders/light_falloff.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr float PI = 3.14159265358979f;

float mean(const Vector3 &p_value) {
	return (p_value.x + p_value.y + p_value.z) / 3.0f;
}

Basis basis_around(const Vector3 &p_axis) {
	Basis basis;
	brdf::make_tangents(p_axis, basis[0], basis[1]);
	basis[2] = p_axis;
	return basis;
}

// Mean emission over 16 points of the triangle and the largest of them.
void estimate_emission(const TraceScene &p_trace, uint32_t p_surface, uint32_t p_primitive, float &r_mean, float &r_max) {
	constexpr uint32_t STEPS = 4;
	r_mean = r_max = 0;
	for (uint32_t i = 0; i < STEPS * STEPS; i++) {
		float u = (float(i % STEPS) + 0.5f) / STEPS;
		float v = (float(i / STEPS) + 0.5f) / STEPS;
		if (u + v > 1.0f) {
			u = 1.0f - u;
			v = 1.0f - v;
		}
		const float value = std::max(0.0f, mean(p_trace.emission(p_surface, p_primitive, u, v)) * p_trace.alpha(p_surface, p_primitive, u, v));
		r_mean += value / (STEPS * STEPS);
		r_max = std::max(r_max, value);
	}
}

} // namespace

LightSampler::LightSampler(const RenderScene &p_scene, ScenarioRid p_scenario, const RenderOrigin &p_origin, TraceScene &r_trace) {
	std::vector<double> weights;
	for (uint32_t i = 0; i < r_trace.surfaces.size(); i++) {
		if (r_trace.material_of(i).emissive) {
			add_emitters(r_trace, i, weights);
		}
	}
	double total = 0;
	for (double weight : weights) {
		total += weight;
	}
	for (size_t i = 0; i < emitters.size(); i++) {
		emitters[i].area_pdf = float(weights[i] / total / emitters[i].area_pdf); // held the area until now
		area_pdfs[r_trace.surfaces[emitters[i].surface].first_emitter + emitters[i].primitive] = emitters[i].area_pdf;
	}
	build_alias_table(weights, total);
	p_scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
		const Light *light = p_scene.lights.get(p_instance.light);
		if (light && p_instance.scenario == p_scenario && p_instance.visible) {
			add_lamp(*light, p_origin.render_from_world(p_instance.transform));
		}
	});
}

void LightSampler::add_emitters(TraceScene &r_trace, uint32_t p_surface, std::vector<double> &r_weights) {
	TraceSurface &surface = r_trace.surfaces[p_surface];
	const uint32_t *indices = surface.mesh->indices.data();
	const uint32_t triangle_count = uint32_t(surface.mesh->indices.size() / 3);
	surface.first_emitter = uint32_t(area_pdfs.size());
	area_pdfs.resize(area_pdfs.size() + triangle_count, 0.0f);
	for (uint32_t i = 0; i < triangle_count; i++) {
		Emitter emitter = {};
		emitter.surface = p_surface;
		emitter.primitive = i;
		emitter.corner = surface.vertices[indices[3 * i]].position;
		emitter.edge1 = surface.vertices[indices[3 * i + 1]].position - emitter.corner;
		emitter.edge2 = surface.vertices[indices[3 * i + 2]].position - emitter.corner;
		const Vector3 cross = glm::cross(emitter.edge1, emitter.edge2);
		emitter.area_pdf = 0.5f * glm::length(cross);
		emitter.normal = cross * (0.5f * surface.orientation / emitter.area_pdf);
		emitter.offset_m = 1e-6f + 4e-6f * (glm::length(emitter.corner) + glm::length(emitter.edge1) + glm::length(emitter.edge2));
		float average, brightest;
		estimate_emission(r_trace, p_surface, i, average, brightest);
		// A floor of 1e-3 of the parameter's own brightness: a texture may shine between the 16 points.
		const float floor_value = 1e-3f * std::max(mean(r_trace.material_of(p_surface).parameters.emission), brightest);
		const TraceMaterial &material = r_trace.material_of(p_surface);
		emitter.constant = !material.has_texture(TextureSlot::EMISSION) && material.parameters.transparency == TransparencyMode::OPAQUE;
		emitter.radiance = material.parameters.emission * surface.opacity;
		emitter.shines[0] = material.visible_from(false);
		emitter.shines[1] = material.visible_from(true);
		const double weight = double(emitter.area_pdf) * std::max(average, floor_value);
		if (weight > 0 && std::isfinite(weight)) {
			emitters.push_back(emitter);
			r_weights.push_back(weight);
		}
	}
}

void LightSampler::build_alias_table(const std::vector<double> &p_weights, double p_total) {
	std::vector<double> share; // of an even part; 1 on average
	std::vector<uint32_t> small, large;
	for (uint32_t i = 0; i < p_weights.size(); i++) {
		share.push_back(p_weights[i] / p_total * double(p_weights.size()));
		(share[i] < 1.0 ? small : large).push_back(i);
		emitters[i].keep = UINT32_MAX;
		emitters[i].alias = i;
	}
	while (!small.empty() && !large.empty()) {
		const uint32_t less = small.back();
		const uint32_t more = large.back();
		small.pop_back();
		emitters[less].keep = uint32_t(share[less] * 0x1p32);
		emitters[less].alias = more;
		share[more] -= 1.0 - share[less];
		if (share[more] < 1.0) {
			large.pop_back();
			small.push_back(more);
		}
	}
}

const LightSampler::Emitter &LightSampler::choose_emitter(Random &r_random) const {
	const uint64_t scaled = uint64_t(r_random.next_uint()) * emitters.size();
	const uint32_t index = uint32_t(scaled >> 32);
	const uint32_t others[2] = { index, emitters[index].alias };
	return emitters[others[uint32_t(scaled) > emitters[index].keep]]; // an index, not a branch: nobody could predict it
}

void LightSampler::add_lamp(const Light &p_light, const Transform3D &p_transform) {
	if (p_light.type == LightType::DIRECTIONAL && p_light.sky_mode == SkyMode::SKY_ONLY) {
		return;
	}
	Lamp lamp;
	lamp.parameters = p_light;
	lamp.position = p_transform.origin;
	lamp.direction = -glm::normalize(p_transform.basis[2]);
	lamp.color = p_light.color * (p_light.negative ? -p_light.energy : p_light.energy);
	lamp.weight = std::abs(mean(lamp.color));
	lamp.spot_cos = std::cos(glm::radians(p_light.spot_angle_degrees));
	lamp.sun_cos = std::cos(0.5f * glm::radians(p_light.angular_size_degrees));
	if (lamp.weight > 0.0f) {
		negative = negative || p_light.negative;
		lamps.push_back(lamp);
	}
}

EmitterSample LightSampler::sample_emitter(const TraceScene &p_trace, const Vector3 &p_position, const Vector3 &p_horizon, Random &r_random) const {
	EmitterSample sample;
	const Emitter &emitter = choose_emitter(r_random);
	// Sorted, two random numbers cut 1 into three parts that are uniform over the triangle.
	const float r1 = r_random.next();
	const float r2 = r_random.next();
	const float u = std::min(r1, r2);
	const float v = 1.0f - std::max(r1, r2);
	const Vector3 position = emitter.corner + emitter.edge1 * u + emitter.edge2 * v;
	const Vector3 to_emitter = position - p_position;
	const float facing = -glm::dot(emitter.normal, to_emitter); // > 0: its front is seen
	const bool front = facing > 0.0f;
	if (!emitter.shines[front] || !(glm::dot(p_horizon, to_emitter) > 0.0f)) {
		return sample;
	}
	const float square = glm::dot(to_emitter, to_emitter);
	const float inverse_distance = 1.0f / std::sqrt(square);
	sample.direction = to_emitter * inverse_distance;
	const float cosine = std::abs(facing) * inverse_distance;
	if (!(cosine > 1e-6f)) {
		return sample;
	}
	sample.position = position + emitter.normal * (front ? emitter.offset_m : -emitter.offset_m);
	sample.radiance = emitter.constant ? emitter.radiance : p_trace.emission(emitter.surface, emitter.primitive, u, v) * p_trace.alpha(emitter.surface, emitter.primitive, u, v);
	sample.pdf = emitter.area_pdf * square / cosine;
	return sample;
}

float LightSampler::attenuation(const Lamp &p_lamp, const Vector3 &p_to_lamp, float p_distance) const {
	const Light &light = p_lamp.parameters;
	float value = light_falloff::light_distance_falloff(p_distance, std::max(light.range_m, 1e-3f), light.attenuation);
	if (light.type == LightType::SPOT && value > 0.0f) {
		const float cosine = -glm::dot(p_to_lamp, p_lamp.direction) / std::max(p_distance, LIGHT_MIN_DISTANCE_M);
		value *= light_falloff::light_cone_falloff(cosine, p_lamp.spot_cos, light.spot_exponent());
	}
	return value;
}

// Unshadowed strength at the point, up to a common factor. Lamps below its horizon weigh nothing unless they have a size.
float LightSampler::lamp_weight(const Lamp &p_lamp, const Vector3 &p_position, const Vector3 &p_normal, bool p_indirect) const {
	const Light &light = p_lamp.parameters;
	float weight = p_lamp.weight;
	if (p_indirect) {
		weight = light.bake_mode == LightBakeMode::DISABLED ? 0.0f : weight * light.indirect_energy;
	}
	if (light.type == LightType::DIRECTIONAL) {
		return p_lamp.sun_cos < 1.0f || glm::dot(p_normal, p_lamp.direction) < 0.0f ? weight : 0.0f;
	}
	const Vector3 to_lamp = p_lamp.position - p_position;
	if (light.size_m <= 0.0f && glm::dot(p_normal, to_lamp) <= 0.0f) {
		return 0.0f;
	}
	// A sized lamp is sampled at another point than its centre: widen range and cone so that no lit point has weight 0.
	const float distance = std::max(glm::length(to_lamp) - light.size_m, 1e-4f);
	const bool wide = light.size_m > 0.0f;
	return wide ? weight * std::pow(distance, -light.attenuation) * (distance < light.range_m ? 1.0f : 0.0f) : weight * attenuation(p_lamp, to_lamp, distance);
}

uint32_t LightSampler::choose_lamp(const Vector3 &p_position, const Vector3 &p_normal, bool p_indirect, Random &r_random, float &r_probability) const {
	// Weighted reservoir of one: a single pass, no memory.
	uint32_t chosen = UINT32_MAX;
	float chosen_weight = 0, total = 0;
	float random = r_random.next();
	for (uint32_t i = 0; i < lamps.size(); i++) {
		const float weight = lamp_weight(lamps[i], p_position, p_normal, p_indirect);
		if (!(weight > 0.0f)) {
			continue;
		}
		total += weight;
		const float share = weight / total;
		const bool take = random < share;
		random = take ? random / share : (random - share) / (1.0f - share);
		if (take) {
			chosen = i;
			chosen_weight = weight;
		}
	}
	r_probability = chosen_weight / std::max(total, std::numeric_limits<float>::min());
	return chosen;
}

LampSample LightSampler::sample_lamp(uint32_t p_lamp, const Vector3 &p_position, bool p_indirect, Random &r_random) const {
	const Lamp &lamp = lamps[p_lamp];
	const Light &light = lamp.parameters;
	LampSample sample;
	sample.specular = light.specular_scale();
	// shadow_enabled and shadow_opacity are about shadow maps; light that bounces is stopped by whatever is in its way, as in GI.
	const float opacity = light.shadow_enabled ? light.shadow_opacity : 0.0f;
	sample.shadow_opacity = p_indirect ? 1.0f : opacity;
	float strength = 1.0f;
	if (p_indirect) {
		strength = light.bake_mode == LightBakeMode::DISABLED ? 0.0f : light.indirect_energy;
	}
	const bool point = light.type == LightType::DIRECTIONAL ? lamp.sun_cos == 1.0f : light.size_m <= 0.0f;
	const float u = point ? 0.0f : 2.0f * PI * r_random.next();
	const float v = point ? 0.0f : r_random.next();
	if (light.type == LightType::DIRECTIONAL) {
		const float cosine = 1.0f - v * (1.0f - lamp.sun_cos);
		const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
		sample.direction = point ? -lamp.direction : basis_around(-lamp.direction) * Vector3(std::cos(u) * sine, std::sin(u) * sine, cosine);
		sample.distance_m = std::numeric_limits<float>::infinity();
	} else {
		Vector3 to_lamp = lamp.position - p_position;
		if (!point) {
			// A disc of that radius that faces the point.
			const Basis disc = basis_around(glm::normalize(to_lamp));
			to_lamp += (disc[0] * std::cos(u) + disc[1] * std::sin(u)) * (light.size_m * std::sqrt(v));
		}
		sample.distance_m = glm::length(to_lamp);
		sample.direction = to_lamp / std::max(sample.distance_m, 1e-9f);
		strength *= attenuation(lamp, to_lamp, sample.distance_m);
	}
	sample.power = lamp.color * strength;
	return sample;
}

} // namespace lucent
