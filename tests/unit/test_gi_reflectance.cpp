// SPDX-License-Identifier: MIT
#include "servers/rendering/gi_reflectance.h"
#include "servers/rendering/shaders/brdf.h"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace lucent;

namespace {

// What the lobe sends on of light from all around, by quadrature over view and light.
float lobe_reflectance(const brdf::BrdfLobes &p_lobes) {
	constexpr int VIEWS = 32, HEIGHTS = 256, TURNS = 128;
	const Vector3 normal(0.0f, 0.0f, 1.0f);
	double sum = 0.0;
	for (int i = 0; i < VIEWS; i++) {
		const float v = std::sqrt((float(i) + 0.5f) / VIEWS); // by cosine
		const Vector3 view(std::sqrt(1.0f - v * v), 0.0f, v);
		for (int j = 0; j < HEIGHTS; j++) {
			const float l = std::sqrt((float(j) + 0.5f) / HEIGHTS);
			for (int k = 0; k < TURNS; k++) {
				const float phi = 2.0f * BRDF_PI * (float(k) + 0.5f) / TURNS;
				const float r = std::sqrt(1.0f - l * l);
				sum += double(brdf::brdf_specular(p_lobes, normal, view, Vector3(r * std::cos(phi), r * std::sin(phi), l)).x) * BRDF_PI;
			}
		}
	}
	return float(sum / (VIEWS * HEIGHTS * TURNS));
}

} // namespace

TEST_CASE("GI's share of a specular lobe is what the BRDF reflects") {
	for (const float roughness : { 0.3f, 0.5f, 0.8f, 1.0f }) {
		Material material;
		material.specular = 0.5f;
		const brdf::BrdfLobes dielectric = brdf::brdf_lobes(Vector3(0.0f), 0.0f, roughness, material.specular, material.specular_tint);
		CHECK(gi_reflectance(material, 0.0f, roughness).added.x == doctest::Approx(lobe_reflectance(dielectric)).epsilon(0.08));
		const brdf::BrdfLobes metal = brdf::brdf_lobes(Vector3(1.0f), 1.0f, roughness, material.specular, material.specular_tint);
		const GiReflectance of_metal = gi_reflectance(material, 1.0f, roughness);
		CHECK(of_metal.of_albedo + of_metal.added.x == doctest::Approx(lobe_reflectance(metal)).epsilon(0.03));
	}
}

TEST_CASE("without a specular lobe GI reflects the albedo") {
	Material material;
	material.specular = 0.0f;
	const GiReflectance reflectance = gi_reflectance(material, 0.0f, 0.5f);
	CHECK(reflectance.of_albedo == 1.0f);
	CHECK(reflectance.added == Vector3(0.0f));
}
