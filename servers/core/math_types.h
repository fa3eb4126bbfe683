// SPDX-License-Identifier: MIT
#pragma once
// GLM under Godot's names. The only file that sets GLM_ macros.

#define GLM_FORCE_RADIANS
#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#define GLM_FORCE_EXPLICIT_CTOR
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <limits>

namespace lucent {

using Vector2 = glm::vec2;
using Vector3 = glm::vec3;
using Vector4 = glm::vec4;
using Vector2i = glm::ivec2;
using Vector3i = glm::ivec3;
using Quaternion = glm::quat;
using Basis = glm::mat3; // columns are the images of x, y and z
using Projection = glm::mat4;

// RGBA. Godot's colour properties are sRGB-encoded with linear alpha; `srgb_to_linear` decodes. Each use says which it holds.
struct Color {
	float r = 0, g = 0, b = 0, a = 1;
	bool operator==(const Color &) const = default;
};

inline float srgb_to_linear(float p_value) {
	return p_value <= 0.04045f ? p_value / 12.92f : std::pow((p_value + 0.055f) / 1.055f, 2.4f);
}
inline float linear_to_srgb(float p_value) {
	return p_value <= 0.0031308f ? p_value * 12.92f : 1.055f * std::pow(p_value, 1.0f / 2.4f) - 0.055f;
}
inline Vector3 srgb_to_linear(const Color &p_color) {
	return Vector3(srgb_to_linear(p_color.r), srgb_to_linear(p_color.g), srgb_to_linear(p_color.b));
}

// Affine transform: world = basis * local + origin.
struct Transform3D {
	Basis basis = Basis(1.0f);
	Vector3 origin = Vector3(0.0f);

	Vector3 xform(const Vector3 &p_point) const { return basis * p_point + origin; }
	Transform3D operator*(const Transform3D &p_child) const { return { basis * p_child.basis, xform(p_child.origin) }; }
	Transform3D affine_inverse() const {
		const Basis inverse = glm::inverse(basis);
		return { inverse, -(inverse * origin) };
	}
	Projection to_matrix() const {
		Projection m(basis);
		m[3] = Vector4(origin, 1.0f);
		return m;
	}
	bool operator==(const Transform3D &) const = default;
};

// Axis-aligned box by its corners. Default-constructed: empty (min > max).
struct AABB {
	Vector3 min = Vector3(std::numeric_limits<float>::max());
	Vector3 max = Vector3(std::numeric_limits<float>::lowest());

	bool is_empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
	void expand_to(const Vector3 &p_point) {
		min = glm::min(min, p_point);
		max = glm::max(max, p_point);
	}
	void merge_with(const AABB &p_other) {
		min = glm::min(min, p_other.min);
		max = glm::max(max, p_other.max);
	}
	bool intersects(const AABB &p_other) const {
		return glm::all(glm::lessThanEqual(min, p_other.max)) && glm::all(glm::greaterThanEqual(max, p_other.min));
	}
	Vector3 center() const { return 0.5f * (min + max); }
	Vector3 size() const { return max - min; }
	// The box around this box's image under p_transform (Arvo, Graphics Gems 1990).
	AABB xform(const Transform3D &p_transform) const {
		if (is_empty()) {
			return *this;
		}
		const Vector3 half = 0.5f * size();
		const Vector3 new_center = p_transform.xform(center());
		const Vector3 new_half = glm::abs(p_transform.basis[0]) * half.x + glm::abs(p_transform.basis[1]) * half.y + glm::abs(p_transform.basis[2]) * half.z;
		return { new_center - new_half, new_center + new_half };
	}
	bool operator==(const AABB &) const = default;
};

} // namespace lucent
