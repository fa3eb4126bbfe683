// SPDX-License-Identifier: MIT
#pragma once
// What the specular lobe of brdf_inc.glsl reflects of light that is the same from all directions, by view and roughness.

#include "servers/core/math_types.h"

#include <vector>

namespace lucent {

// The lobe's directional albedo is x f0 + y f90 (brdf_environment); both from 0 to 1. Entry (column c, row r) is exact for the cosine
// c / (SIZE - 1) between view and normal and the roughness r / (SIZE - 1), no less than BRDF_MIN_ROUGHNESS; bilinear between. Read so, it is
// within 0.003 of the integral where the cosine is above 0.1.
class BrdfTable {
public:
	static constexpr uint32_t SIZE = 32;

	// Made once, in about 30 ms.
	static const BrdfTable &get();

	const std::vector<Vector2> &values() const { return table; } // row by row
	// Arguments are clamped to 0 to 1.
	Vector2 lookup(float p_n_dot_v, float p_roughness) const;
	// The mean of lookup over all view directions by cosine: what is reflected of light from everywhere, into all directions.
	Vector2 mean(float p_roughness) const;

private:
	BrdfTable();

	std::vector<Vector2> table;
};

} // namespace lucent
