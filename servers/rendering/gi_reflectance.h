// SPDX-License-Identifier: MIT
#pragma once
// What GI's bounces make of a material: they are diffuse, so the specular lobe counts by the light that it sends on in all directions.

#include "servers/rendering/render_scene.h"

namespace lucent {

// Reflectance = albedo * of_albedo + added, all 0 to 1.
struct GiReflectance {
	float of_albedo = 1.0f;
	Vector3 added{ 0.0f };
};

// p_metallic, p_roughness: means over the surface, 0 to 1.
GiReflectance gi_reflectance(const Material &p_material, float p_metallic, float p_roughness);

} // namespace lucent
