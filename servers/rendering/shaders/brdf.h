// SPDX-License-Identifier: MIT
#pragma once
// The shaders' BRDF, compiled as C++: for the path tracer, for what GI makes of a material (gi_reflectance.h) and for brdf_table.h.

#include "servers/core/math_types.h"

namespace lucent::brdf {
// GLSL's vocabulary for the included text.
using glm::clamp;
using glm::dot;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::vec2;
using glm::vec3;
using std::sqrt;

#define SHADER_FUNC inline
#include "servers/rendering/shaders/brdf_inc.glsl"
#undef SHADER_FUNC
} // namespace lucent::brdf
