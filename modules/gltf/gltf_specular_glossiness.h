// SPDX-License-Identifier: MIT
#pragma once
// KHR_materials_pbrSpecularGlossiness as metallic-roughness, after the conversion in the extension's appendix (Khronos).

#include "servers/core/image.h"
#include "servers/core/math_types.h"

#include <memory>

namespace lucent {

struct SpecularGlossiness { // factors, linear
	Vector4 diffuse{ 1.0f };
	Vector3 specular{ 1.0f };
	float glossiness = 1.0f;
};

struct MetallicRoughness {
	Vector3 base_color{ 1.0f };
	float metallic = 0.0f;
	float roughness = 1.0f;
};

// Of one point, factors already multiplied in.
MetallicRoughness to_metallic_roughness(const Vector4 &p_diffuse, const Vector3 &p_specular, float p_glossiness);

struct MetallicRoughnessImages {
	Image base_color; // sRGB and alpha
	Image metallic_roughness; // roughness in G, metallic in B
};
// RGBA8 images, the diffuse one may be null. Both results have the greater width and height of the two. p_specular_glossiness: sRGB specular colour, glossiness in A.
MetallicRoughnessImages to_metallic_roughness_images(const SpecularGlossiness &p_factors, const std::shared_ptr<const Image> &p_diffuse, const Image &p_specular_glossiness);

} // namespace lucent
