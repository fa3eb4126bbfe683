// SPDX-License-Identifier: MIT
#include "servers/rendering/brdf_table.h"

#include "servers/rendering/shaders/brdf.h"

#include <algorithm>
#include <cmath>

namespace lucent {

namespace {
// Half-way vectors by D n.h (Karis 2013): each weighs V 4 n.l v.h / n.h. The lobe is symmetric, so half a turn is enough.
Vector2 integrate(float p_n_dot_v, float p_roughness) {
	constexpr uint32_t HEIGHTS = 48;
	constexpr uint32_t TURNS = 16;
	const float alpha = p_roughness * p_roughness;
	const Vector3 view(std::sqrt(1.0f - p_n_dot_v * p_n_dot_v), 0.0f, p_n_dot_v);
	Vector2 sum(0.0f);
	for (uint32_t i = 0; i < HEIGHTS; i++) {
		const float u = (float(i) + 0.5f) / HEIGHTS;
		const float cosine = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u));
		const float sine = std::sqrt(std::max(1.0f - cosine * cosine, 0.0f));
		for (uint32_t k = 0; k < TURNS; k++) {
			const float phi = BRDF_PI * (float(k) + 0.5f) / TURNS;
			const Vector3 halfway(sine * std::cos(phi), sine * std::sin(phi), cosine);
			const float v_dot_h = glm::dot(view, halfway);
			const float n_dot_l = 2.0f * v_dot_h * cosine - p_n_dot_v;
			if (v_dot_h > 0.0f && n_dot_l > 0.0f) {
				const float weight = brdf::brdf_visibility_smith(n_dot_l, p_n_dot_v, alpha) * 4.0f * n_dot_l * v_dot_h / cosine;
				const float edge = brdf::brdf_fresnel_schlick(Vector3(0.0f), 1.0f, v_dot_h).x;
				sum += Vector2(1.0f - edge, edge) * weight;
			}
		}
	}
	return sum / float(HEIGHTS * TURNS);
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
