// SPDX-License-Identifier: MIT
#include "modules/scene/euler.h"

#include <glm/gtc/matrix_transform.hpp>

namespace lucent::scene {

namespace {

struct Axes {
	int i, j, k; // rotation = R_i * R_j * R_k
	float sign; // +1: an even permutation of x y z
};

Axes axes_of(EulerOrder p_order) {
	static constexpr Axes ORDERS[] = { { 0, 1, 2, 1 }, { 0, 2, 1, -1 }, { 1, 0, 2, -1 }, { 1, 2, 0, 1 }, { 2, 0, 1, 1 }, { 2, 1, 0, -1 } };
	return ORDERS[size_t(p_order)];
}

Basis rotation_about(int p_axis, float p_angle) {
	Vector3 axis(0.0f);
	axis[p_axis] = 1.0f;
	return Basis(glm::rotate(Projection(1.0f), p_angle, axis));
}

} // namespace

Basis basis_from_euler(const Vector3 &p_euler, EulerOrder p_order) {
	const Axes axes = axes_of(p_order);
	return rotation_about(axes.i, p_euler[axes.i]) * rotation_about(axes.j, p_euler[axes.j]) * rotation_about(axes.k, p_euler[axes.k]);
}

Vector3 euler_from_basis(const Basis &p_rotation, EulerOrder p_order) {
	const Axes axes = axes_of(p_order);
	const auto element = [&](int p_row, int p_column) { return p_rotation[p_column][p_row]; };
	const float sine = glm::clamp(axes.sign * element(axes.i, axes.k), -1.0f, 1.0f);
	Vector3 euler(0.0f);
	euler[axes.j] = std::asin(sine);
	// 1e-6 below 1 the middle axis is within 0.1 degrees of the pole and the other two turn about the same line.
	if (std::abs(sine) < 1.0f - 1e-6f) {
		euler[axes.i] = std::atan2(-axes.sign * element(axes.j, axes.k), element(axes.k, axes.k));
		euler[axes.k] = std::atan2(-axes.sign * element(axes.i, axes.j), element(axes.i, axes.i));
	} else {
		euler[axes.i] = std::atan2(axes.sign * element(axes.k, axes.j), element(axes.j, axes.j));
	}
	return euler;
}

RotationScale decompose_basis(const Basis &p_basis) {
	RotationScale result;
	const float sign = glm::determinant(p_basis) < 0.0f ? -1.0f : 1.0f;
	// Gram-Schmidt: a sheared basis loses its shear.
	Vector3 columns[3];
	for (int i = 0; i < 3; i++) {
		result.scale[i] = sign * glm::length(p_basis[i]);
		columns[i] = sign * p_basis[i];
		for (int j = 0; j < i; j++) {
			columns[i] -= columns[j] * glm::dot(columns[j], columns[i]);
		}
		const float length = glm::length(columns[i]);
		if (!(length > 0.0f)) {
			return { Basis(1.0f), result.scale }; // flat: no rotation to speak of
		}
		columns[i] /= length;
	}
	result.rotation = Basis(columns[0], columns[1], columns[2]);
	return result;
}

Basis compose_basis(const Basis &p_rotation, const Vector3 &p_scale) {
	return Basis(p_rotation[0] * p_scale.x, p_rotation[1] * p_scale.y, p_rotation[2] * p_scale.z);
}

} // namespace lucent::scene
