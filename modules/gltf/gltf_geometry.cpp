// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_geometry.h"

#include <algorithm>

namespace lucent {

namespace {

bool normalize_safe(Vector3 &r_vector) {
	// Scaled first: the square of a large or tiny component would leave float's range.
	const float largest = std::max({ std::abs(r_vector.x), std::abs(r_vector.y), std::abs(r_vector.z) });
	if (!(largest > 0.0f) || !std::isfinite(largest)) {
		return false;
	}
	r_vector = glm::normalize(r_vector / largest);
	return true;
}

Vector3 any_perpendicular(const Vector3 &p_normal) {
	Vector3 result = glm::cross(std::abs(p_normal.x) < 0.9f ? Vector3(1.0f, 0.0f, 0.0f) : Vector3(0.0f, 1.0f, 0.0f), p_normal);
	return normalize_safe(result) ? result : Vector3(1.0f, 0.0f, 0.0f);
}

template <typename V>
void repeat_elements(std::vector<V> &r_values, const std::vector<uint32_t> &p_sources) {
	if (!r_values.empty()) {
		r_values.reserve(r_values.size() + p_sources.size());
		for (const uint32_t source : p_sources) {
			r_values.push_back(r_values[source]);
		}
	}
}

// One triangle's share of a tangent.
struct TriangleTangent {
	Vector3 tangent{ 0.0f };
	bool mirrored = false; // v runs along cross(normal, tangent)
	bool valid = false;
};

TriangleTangent triangle_tangent(const MeshSurface &p_surface, const std::vector<Vector2> &p_uvs, const uint32_t *p_corners) {
	const Vector3 edge1 = p_surface.positions[p_corners[1]] - p_surface.positions[p_corners[0]];
	const Vector3 edge2 = p_surface.positions[p_corners[2]] - p_surface.positions[p_corners[0]];
	const Vector2 uv1 = p_uvs[p_corners[1]] - p_uvs[p_corners[0]];
	const Vector2 uv2 = p_uvs[p_corners[2]] - p_uvs[p_corners[0]];
	const float determinant = uv1.x * uv2.y - uv2.x * uv1.y;
	TriangleTangent result;
	result.mirrored = determinant > 0.0f;
	result.tangent = (edge1 * uv2.y - edge2 * uv1.y) * (result.mirrored ? 1.0f : -1.0f);
	result.valid = determinant != 0.0f && normalize_safe(result.tangent);
	return result;
}

float corner_angle(const MeshSurface &p_surface, const uint32_t *p_corners, int p_corner) {
	const Vector3 &position = p_surface.positions[p_corners[p_corner]];
	Vector3 edge1 = p_surface.positions[p_corners[(p_corner + 1) % 3]] - position;
	Vector3 edge2 = p_surface.positions[p_corners[(p_corner + 2) % 3]] - position;
	if (!normalize_safe(edge1) || !normalize_safe(edge2)) {
		return 0.0f;
	}
	return std::acos(std::clamp(glm::dot(edge1, edge2), -1.0f, 1.0f));
}

} // namespace

void complete_normals(MeshSurface &r_surface) {
	r_surface.normals.resize(r_surface.positions.size(), Vector3(0.0f));
	std::vector<bool> missing(r_surface.normals.size(), false);
	bool any_missing = false;
	for (size_t i = 0; i < r_surface.normals.size(); i++) {
		missing[i] = !normalize_safe(r_surface.normals[i]);
		any_missing |= missing[i];
	}
	if (!any_missing) {
		return;
	}
	std::vector<Vector3> sums(r_surface.normals.size(), Vector3(0.0f));
	for (size_t i = 0; i + 2 < r_surface.indices.size(); i += 3) {
		const uint32_t *corners = &r_surface.indices[i];
		const Vector3 &origin = r_surface.positions[corners[0]];
		const Vector3 normal = glm::cross(r_surface.positions[corners[1]] - origin, r_surface.positions[corners[2]] - origin);
		for (int c = 0; c < 3; c++) {
			sums[corners[c]] += normal;
		}
	}
	for (size_t i = 0; i < sums.size(); i++) {
		if (missing[i]) {
			r_surface.normals[i] = normalize_safe(sums[i]) ? sums[i] : Vector3(0.0f, 1.0f, 0.0f);
		}
	}
}

void make_tangents(MeshSurface &r_surface, bool p_second_uv_set) {
	const std::vector<Vector2> &uvs = p_second_uv_set ? r_surface.uv2s : r_surface.uvs;
	const size_t vertex_count = r_surface.positions.size();
	// Two sums a vertex: of triangles whose texture is upright and of those where it is mirrored.
	std::vector<Vector3> sums(vertex_count * 2, Vector3(0.0f));
	std::vector<bool> mirrored(r_surface.indices.size() / 3, false);
	std::vector<uint8_t> sides(vertex_count, 0);
	for (size_t t = 0; t < mirrored.size(); t++) {
		const uint32_t *corners = &r_surface.indices[t * 3];
		const TriangleTangent triangle = triangle_tangent(r_surface, uvs, corners);
		mirrored[t] = triangle.mirrored;
		for (int c = 0; triangle.valid && c < 3; c++) {
			sums[corners[c] * size_t(2) + triangle.mirrored] += triangle.tangent * corner_angle(r_surface, corners, c);
			sides[corners[c]] |= uint8_t(1 << triangle.mirrored);
		}
	}
	std::vector<uint32_t> split_sources;
	std::vector<uint32_t> split_of(vertex_count, UINT32_MAX);
	for (uint32_t i = 0; i < vertex_count; i++) {
		if (sides[i] == 3) {
			split_of[i] = uint32_t(vertex_count + split_sources.size());
			split_sources.push_back(i);
		}
	}
	for (size_t i = 0; i < r_surface.indices.size(); i++) {
		uint32_t &index = r_surface.indices[i];
		index = mirrored[i / 3] && split_of[index] != UINT32_MAX ? split_of[index] : index;
	}
	repeat_elements(r_surface.positions, split_sources);
	repeat_elements(r_surface.normals, split_sources);
	repeat_elements(r_surface.uvs, split_sources);
	repeat_elements(r_surface.uv2s, split_sources);
	repeat_elements(r_surface.colors, split_sources);
	r_surface.tangents.resize(r_surface.positions.size());
	for (size_t i = 0; i < r_surface.tangents.size(); i++) {
		const size_t source = i < vertex_count ? i : split_sources[i - vertex_count];
		const bool is_mirrored = i >= vertex_count || sides[source] == 2;
		const Vector3 &normal = r_surface.normals[i];
		Vector3 tangent = sums[source * 2 + is_mirrored];
		tangent -= normal * glm::dot(normal, tangent);
		if (!normalize_safe(tangent)) {
			tangent = any_perpendicular(normal);
		}
		r_surface.tangents[i] = Vector4(tangent, is_mirrored ? -1.0f : 1.0f);
	}
}

} // namespace lucent
