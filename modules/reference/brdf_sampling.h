// SPDX-License-Identifier: MIT
#pragma once
// Directions for the shared BRDF: cosine-weighted for the diffuse lobe, visible normals for the specular one (Heitz, JCGT 7(4) 2018).

#include "modules/reference/random.h"
#include "servers/rendering/shaders/brdf.h"

#include <algorithm>

namespace lucent::brdf {

struct Evaluation {
	Vector3 value_cos; // BRDF times cosine
	float pdf; // of sample(), per steradian
};

inline float luminance(const Vector3 &p_value) {
	return glm::dot(p_value, Vector3(0.2126f, 0.7152f, 0.0722f));
}

// The share of samples that the specular lobe gets: its share of what is reflected, at least a tenth where both lobes exist.
inline float specular_share(const BrdfLobes &p_lobes, const Vector3 &p_normal, const Vector3 &p_view) {
	if (p_lobes.f90 <= 0.0f) {
		return 0.0f;
	}
	const float specular = luminance(brdf_fresnel_schlick(p_lobes.f0, p_lobes.f90, std::max(glm::dot(p_normal, p_view), 0.0f)));
	const float diffuse = luminance(p_lobes.diffuse);
	return diffuse > 0.0f ? std::clamp(specular / (specular + diffuse), 0.1f, 0.9f) : 1.0f;
}

inline Evaluation evaluate(const BrdfLobes &p_lobes, float p_specular_share, const Vector3 &p_normal, const Vector3 &p_view, const Vector3 &p_light) {
	const float n_dot_l = glm::dot(p_normal, p_light);
	if (n_dot_l <= 0.0f) {
		return { Vector3(0.0f), 0.0f };
	}
	Evaluation result = { brdf_diffuse(p_lobes) * n_dot_l, n_dot_l / BRDF_PI };
	if (p_specular_share > 0.0f) {
		result.value_cos += brdf_specular(p_lobes, p_normal, p_view, p_light) * n_dot_l;
		const float n_dot_v = std::max(glm::dot(p_normal, p_view), 1e-4f);
		const float n_dot_h = glm::clamp(glm::dot(p_normal, glm::normalize(p_view + p_light)), 0.0f, 1.0f);
		const float a2 = p_lobes.alpha * p_lobes.alpha;
		// Visible normals: G1(v) D max(v.h, 0) / n.v, over the 4 v.h of reflection.
		const float specular_pdf = brdf_distribution_ggx(n_dot_h, p_lobes.alpha) / (2.0f * (n_dot_v + std::sqrt(n_dot_v * n_dot_v * (1.0f - a2) + a2)));
		result.pdf = glm::mix(result.pdf, specular_pdf, p_specular_share);
	}
	return result;
}

// (Duff et al., JCGT 6(1) 2017)
inline void make_tangents(const Vector3 &p_normal, Vector3 &r_x, Vector3 &r_y) {
	const float sign = p_normal.z >= 0.0f ? 1.0f : -1.0f;
	const float a = -1.0f / (sign + p_normal.z);
	const float b = p_normal.x * p_normal.y * a;
	r_x = Vector3(1.0f + sign * p_normal.x * p_normal.x * a, sign * b, -sign * p_normal.x);
	r_y = Vector3(b, sign + p_normal.y * p_normal.y * a, -p_normal.y);
}

// Cosine and sine of p_turns full turns, 0 to 1, within 1e-6: Taylor's series over the eighth of a turn around each axis. The library's
// functions reduce any argument and are calls.
inline Vector2 circle(float p_turns) {
	const float quarters = 4.0f * p_turns;
	const int quadrant = int(quarters + 0.5f);
	const float x = (quarters - float(quadrant)) * (0.5f * BRDF_PI);
	const float x2 = x * x;
	const float s = x * (1.0f + x2 * (-1.0f / 6.0f + x2 * (1.0f / 120.0f - x2 * (1.0f / 5040.0f))));
	const float c = 1.0f + x2 * (-0.5f + x2 * (1.0f / 24.0f + x2 * (-1.0f / 720.0f + x2 * (1.0f / 40320.0f))));
	const float values[2] = { c, s };
	const float cosine = values[quadrant & 1] * (((quadrant + 1) & 2) ? -1.0f : 1.0f);
	const float sine = values[~quadrant & 1] * ((quadrant & 2) ? -1.0f : 1.0f);
	return Vector2(cosine, sine);
}

// A microfacet normal in the basis x, y, normal, for a view in that basis.
inline Vector3 sample_visible_normal(const Vector3 &p_view, float p_alpha, float p_random_u, float p_random_v) {
	const Vector3 stretched = glm::normalize(Vector3(p_alpha * p_view.x, p_alpha * p_view.y, std::max(p_view.z, 1e-4f)));
	const float square = stretched.x * stretched.x + stretched.y * stretched.y;
	const Vector3 t1 = square > 1e-12f ? Vector3(-stretched.y, stretched.x, 0.0f) / std::sqrt(square) : Vector3(1.0f, 0.0f, 0.0f);
	const Vector3 t2 = glm::cross(stretched, t1);
	const float radius = std::sqrt(p_random_u);
	const Vector2 disc = circle(p_random_v) * radius;
	const float p1 = disc.x;
	const float s = 0.5f * (1.0f + stretched.z);
	const float p2 = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - p1 * p1)) + s * disc.y;
	const Vector3 facet = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::max(0.0f, 1.0f - p1 * p1 - p2 * p2));
	return glm::normalize(Vector3(p_alpha * facet.x, p_alpha * facet.y, std::max(facet.z, 1e-6f)));
}

// A unit direction; may lie below the horizon, where evaluate() is 0.
inline Vector3 sample(const BrdfLobes &p_lobes, float p_specular_share, const Vector3 &p_normal, const Vector3 &p_view, Random &r_random) {
	Vector3 x, y;
	make_tangents(p_normal, x, y);
	const bool specular = p_specular_share > 0.0f && r_random.next() < p_specular_share;
	const float u = r_random.next();
	const float v = r_random.next();
	if (specular) {
		const Vector3 local_view(glm::dot(x, p_view), glm::dot(y, p_view), glm::dot(p_normal, p_view));
		const Vector3 local = sample_visible_normal(local_view, p_lobes.alpha, u, v);
		const Vector3 facet = x * local.x + y * local.y + p_normal * local.z;
		return glm::normalize(facet * (2.0f * glm::dot(p_view, facet)) - p_view);
	}
	const Vector2 disc = circle(v) * std::sqrt(u);
	return x * disc.x + y * disc.y + p_normal * std::sqrt(std::max(0.0f, 1.0f - u));
}

} // namespace lucent::brdf
