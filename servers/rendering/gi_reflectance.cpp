// SPDX-License-Identifier: MIT
#include "servers/rendering/gi_reflectance.h"

#include <algorithm>

namespace lucent {

Vector2 specular_reflectance(float p_roughness) {
	const float r = std::clamp(p_roughness, 0.05f, 1.0f); // the BRDF knows none much smoother
	const float of_f0 = ((0.4443f * r - 1.4526f) * r + 0.4874f) * r + 0.9183f;
	const float of_f90 = ((0.0870f * r - 0.0984f) * r - 0.0361f) * r + 0.0518f;
	return { std::min(of_f0, 1.0f), std::max(of_f90, 0.0f) };
}

GiReflectance gi_reflectance(const Material &p_material, float p_metallic, float p_roughness) {
	const float metallic = std::clamp(p_metallic, 0.0f, 1.0f);
	const Vector2 lobe = specular_reflectance(p_roughness);
	const Vector3 f0 = p_material.specular_tint * (0.16f * p_material.specular * p_material.specular);
	const float f90 = std::clamp(16.5f * (f0.x + f0.y + f0.z), metallic, 1.0f);
	return { (1.0f - metallic) + metallic * lobe.x, (1.0f - metallic) * lobe.x * f0 + Vector3(f90 * lobe.y) };
}

} // namespace lucent
