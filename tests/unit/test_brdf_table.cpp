// SPDX-License-Identifier: MIT
#include "modules/reference/brdf_sampling.h"
#include "servers/rendering/brdf_table.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace lucent;

namespace {

// What the lobe reflects of light of 1 from everywhere, by the path tracer's own samples of it, stratified.
double directional_albedo(const brdf::BrdfLobes &p_lobes, float p_n_dot_v) {
	constexpr int RADII = 192, TURNS = 96;
	const Vector3 normal(0.0f, 0.0f, 1.0f);
	const Vector3 view(std::sqrt(1.0f - p_n_dot_v * p_n_dot_v), 0.0f, p_n_dot_v);
	double sum = 0.0;
	for (int i = 0; i < RADII; i++) {
		for (int k = 0; k < TURNS; k++) {
			const Vector3 facet = brdf::sample_visible_normal(view, p_lobes.alpha, (float(i) + 0.5f) / RADII, (float(k) + 0.5f) / TURNS);
			const Vector3 light = facet * (2.0f * glm::dot(view, facet)) - view;
			const brdf::Evaluation found = brdf::evaluate(p_lobes, 1.0f, normal, view, glm::normalize(light));
			sum += found.pdf > 0.0f ? double(found.value_cos.x) / found.pdf : 0.0;
		}
	}
	return sum / (RADII * TURNS);
}

} // namespace

TEST_CASE("the BRDF's table is the integral of the BRDF") {
	double worst_dielectric = 0.0;
	double worst_metal = 0.0;
	for (const float roughness : { 0.05f, 0.1f, 0.23f, 0.37f, 0.5f, 0.71f, 0.9f, 1.0f }) {
		for (const float n_dot_v : { 0.1f, 0.21f, 0.37f, 0.55f, 0.83f, 1.0f }) {
			CAPTURE(roughness);
			CAPTURE(n_dot_v);
			const Vector2 entry = BrdfTable::get().lookup(n_dot_v, roughness);
			const brdf::BrdfLobes dielectric = brdf::brdf_lobes(Vector3(0.0f), 0.0f, roughness, 0.5f, Vector3(1.0f));
			const brdf::BrdfLobes metal = brdf::brdf_lobes(Vector3(0.8f), 1.0f, roughness, 0.5f, Vector3(1.0f));
			const double of_dielectric = directional_albedo(dielectric, n_dot_v);
			const double of_metal = directional_albedo(metal, n_dot_v);
			worst_dielectric = std::max(worst_dielectric, std::abs(brdf::brdf_environment(dielectric, entry).x - of_dielectric));
			worst_metal = std::max(worst_metal, std::abs(brdf::brdf_environment(metal, entry).x - of_metal));
		}
	}
	MESSAGE("worst: dielectric " << worst_dielectric << ", metal " << worst_metal);
	CHECK(worst_dielectric < 0.003);
	CHECK(worst_metal < 0.003);
}
