// SPDX-License-Identifier: MIT
#include "servers/rendering/brdf_table.h"

#include "servers/rendering/shaders/brdf.h"

#include <algorithm>
#include <cmath>

namespace lucent {

namespace {
// Over visible normals (Heitz, JCGT 7(4) 2018), each of which weighs G2 / G1 = 2 V n.l (n.v + root). Half of them: the lobe is symmetric.
Vector2 integrate(float p_n_dot_v, float p_roughness) {
	constexpr uint32_t SAMPLES = 512;
	const float alpha = p_roughness * p_roughness;
	const Vector3 view(std::sqrt(1.0f - p_n_dot_v * p_n_dot_v), 0.0f, p_n_dot_v);
	const Vector3 stretched = glm::normalize(Vector3(alpha * view.x, 0.0f, view.z));
	const Vector3 across(-stretched.z, 0.0f, stretched.x);
	const float middle = 0.5f * (1.0f + stretched.z);
	const float root = std::sqrt(p_n_dot_v * p_n_dot_v * (1.0f - alpha * alpha) + alpha * alpha);
	Vector2 sum(0.0f);
	for (uint32_t i = 0; i < SAMPLES; i++) {
		// Each has a radius of its own: what the lobe's tail sends below the horizon is within the last few of them.
		const float radius = std::sqrt((float(i) + 0.5f) / SAMPLES);
		const float phi = BRDF_PI * (glm::fract(float(i) * 0.61803399f) - 0.5f);
		const float side = radius * std::cos(phi);
		const float up = (1.0f - middle) * std::sqrt(1.0f - side * side) + middle * radius * std::sin(phi);
		const Vector3 facet = Vector3(0.0f, side, 0.0f) + across * up + stretched * std::sqrt(std::max(1.0f - side * side - up * up, 0.0f));
		const Vector3 halfway = glm::normalize(Vector3(alpha * facet.x, alpha * facet.y, std::max(facet.z, 1e-6f)));
		const float v_dot_h = glm::dot(view, halfway);
		const float n_dot_l = 2.0f * v_dot_h * halfway.z - p_n_dot_v;
		if (n_dot_l > 0.0f) {
			const float weight = 2.0f * brdf::brdf_visibility_smith(n_dot_l, p_n_dot_v, alpha) * n_dot_l * (p_n_dot_v + root);
			const float edge = brdf::brdf_fresnel_schlick(Vector3(0.0f), 1.0f, v_dot_h).x;
			sum += Vector2(1.0f - edge, edge) * weight;
		}
	}
	return sum / float(SAMPLES);
}
} // namespace

const BrdfTable &BrdfTable::get() {
	static const BrdfTable table;
	return table;
}

BrdfTable::BrdfTable() {
	for (uint32_t row = 0; row < SIZE; row++) {
		for (uint32_t column = 0; column < SIZE; column++) {
			const float n_dot_v = std::max(float(column) / float(SIZE - 1), 1e-3f);
			table.push_back(integrate(n_dot_v, std::max(float(row) / float(SIZE - 1), BRDF_MIN_ROUGHNESS)));
		}
	}
}

Vector2 BrdfTable::lookup(float p_n_dot_v, float p_roughness) const {
	const Vector2 place = glm::clamp(Vector2(p_n_dot_v, p_roughness), Vector2(0.0f), Vector2(1.0f)) * float(SIZE - 1);
	const uint32_t column = std::min(uint32_t(place.x), SIZE - 2);
	const uint32_t row = std::min(uint32_t(place.y), SIZE - 2);
	const Vector2 *low = &table[row * SIZE + column];
	const float u = place.x - float(column);
	return glm::mix(glm::mix(low[0], low[1], u), glm::mix(low[SIZE], low[SIZE + 1], u), place.y - float(row));
}

Vector2 BrdfTable::mean(float p_roughness) const {
	constexpr uint32_t STEPS = 64;
	Vector2 sum(0.0f);
	for (uint32_t i = 0; i < STEPS; i++) {
		const float n_dot_v = (float(i) + 0.5f) / STEPS;
		sum += lookup(n_dot_v, p_roughness) * (2.0f * n_dot_v / STEPS);
	}
	return sum;
}

} // namespace lucent
