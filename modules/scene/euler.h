// SPDX-License-Identifier: MIT
#pragma once
// Euler angles as Godot has them: for YXZ, rotation = Ry * Rx * Rz, angles in radians beside their axes.

#include "servers/core/math_types.h"

namespace lucent::scene {

enum class EulerOrder : uint8_t {
	XYZ,
	XZY,
	YXZ,
	YZX,
	ZXY,
	ZYX
};

Basis basis_from_euler(const Vector3 &p_euler, EulerOrder p_order);
// p_rotation is orthonormal, determinant 1. At the poles the last axis's angle is 0.
Vector3 euler_from_basis(const Basis &p_rotation, EulerOrder p_order);

// basis = rotation * scale along the local axes. A mirrored basis has a negative scale on all three.
struct RotationScale {
	Basis rotation = Basis(1.0f);
	Vector3 scale{ 1.0f };
};
RotationScale decompose_basis(const Basis &p_basis);
Basis compose_basis(const Basis &p_rotation, const Vector3 &p_scale);

} // namespace lucent::scene
