// SPDX-License-Identifier: MIT
#include "servers/rendering/gi_reflectance.h"

#include "servers/rendering/brdf_table.h"
#include "servers/rendering/shaders/brdf.h"

#include <algorithm>

namespace lucent {

GiReflectance gi_reflectance(const Material &p_material, float p_metallic, float p_roughness) {
	const float metallic = std::clamp(p_metallic, 0.0f, 1.0f);
	const Vector2 lobe = BrdfTable::get().mean(p_roughness);
	// f90 of a black surface: the albedo would raise it only where a surface is partly metallic and its specular next to 0.
	const brdf::BrdfLobes black = brdf::brdf_lobes(Vector3(0.0f), metallic, p_roughness, p_material.specular, p_material.specular_tint);
	return { (1.0f - metallic) + metallic * lobe.x, brdf::brdf_environment(black, lobe) };
}

} // namespace lucent
