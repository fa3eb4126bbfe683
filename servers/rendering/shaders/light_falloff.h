// SPDX-License-Identifier: MIT
#pragma once
// The shaders' falloff of lamps, compiled as C++.

#include "servers/core/math_types.h"

#include <cmath>

namespace lucent::light_falloff {
// GLSL's vocabulary for the included text.
using glm::max;
using std::pow;

#define SHADER_FUNC inline
#include "servers/rendering/shaders/light_falloff_inc.glsl"
#undef SHADER_FUNC
} // namespace lucent::light_falloff
