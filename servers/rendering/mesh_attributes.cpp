// SPDX-License-Identifier: MIT
#include "servers/rendering/mesh_attributes.h"

#include <glm/gtc/packing.hpp>

namespace lucent {

namespace {
std::vector<Vector3> generate_normals(const MeshSurface &p_surface) {
	std::vector<Vector3> normals(p_surface.positions.size(), Vector3(0.0f));
	for (size_t i = 0; i + 2 < p_surface.indices.size(); i += 3) {
		const uint32_t *corner = &p_surface.indices[i];
		const Vector3 &a = p_surface.positions[corner[0]];
		const Vector3 area = glm::cross(p_surface.positions[corner[1]] - a, p_surface.positions[corner[2]] - a);
		for (int k = 0; k < 3; k++) {
			normals[corner[k]] += area;
		}
	}
	for (Vector3 &normal : normals) {
		const float length = glm::length(normal);
		normal = length > 0.0f ? normal / length : Vector3(0, 1, 0);
	}
	return normals;
}

Vector3 any_perpendicular(const Vector3 &p_normal) {
	const Vector3 axis = std::abs(p_normal.x) < 0.7f ? Vector3(1, 0, 0) : Vector3(0, 1, 0);
	return glm::normalize(glm::cross(axis, p_normal));
}

std::vector<Vector4> generate_tangents(const MeshSurface &p_surface, const std::vector<Vector3> &p_normals) {
	std::vector<Vector3> along_u(p_normals.size(), Vector3(0.0f));
	std::vector<Vector3> along_v(p_normals.size(), Vector3(0.0f));
	for (size_t i = 0; i + 2 < p_surface.indices.size() && !p_surface.uvs.empty(); i += 3) {
		const uint32_t *corner = &p_surface.indices[i];
		const Vector3 edge1 = p_surface.positions[corner[1]] - p_surface.positions[corner[0]];
		const Vector3 edge2 = p_surface.positions[corner[2]] - p_surface.positions[corner[0]];
		const Vector2 uv1 = p_surface.uvs[corner[1]] - p_surface.uvs[corner[0]];
		const Vector2 uv2 = p_surface.uvs[corner[2]] - p_surface.uvs[corner[0]];
		const float sign = uv1.x * uv2.y - uv2.x * uv1.y < 0.0f ? -1.0f : 1.0f;
		const Vector3 u = sign * (edge1 * uv2.y - edge2 * uv1.y);
		const Vector3 v = sign * (edge2 * uv1.x - edge1 * uv2.x);
		for (int k = 0; k < 3; k++) {
			along_u[corner[k]] += u;
			along_v[corner[k]] += v;
		}
	}
	std::vector<Vector4> tangents(p_normals.size());
	for (size_t i = 0; i < tangents.size(); i++) {
		const Vector3 &normal = p_normals[i];
		const Vector3 flat = along_u[i] - normal * glm::dot(normal, along_u[i]);
		const float length = glm::length(flat);
		const Vector3 tangent = length > 0.0f ? flat / length : any_perpendicular(normal);
		// Normal maps' y points up in the image, where v shrinks: w is 1 where that is cross(normal, tangent).
		const float handedness = glm::dot(glm::cross(normal, tangent), along_v[i]) > 0.0f ? -1.0f : 1.0f;
		tangents[i] = Vector4(tangent, handedness);
	}
	return tangents;
}
} // namespace

std::vector<shader::VertexAttributes> make_vertex_attributes(const MeshSurface &p_surface) {
	const std::vector<Vector3> normals = p_surface.normals.empty() ? generate_normals(p_surface) : p_surface.normals;
	const std::vector<Vector4> tangents = p_surface.tangents.empty() ? generate_tangents(p_surface, normals) : p_surface.tangents;
	std::vector<shader::VertexAttributes> attributes(p_surface.positions.size());
	for (size_t i = 0; i < attributes.size(); i++) {
		shader::VertexAttributes &vertex = attributes[i];
		vertex.normal = normals[i];
		vertex.tangent = tangents[i];
		vertex.uv = p_surface.uvs.empty() ? Vector2(0.0f) : p_surface.uvs[i];
		vertex.uv2 = p_surface.uv2s.empty() ? vertex.uv : p_surface.uv2s[i];
		vertex.color = p_surface.colors.empty() ? 0xFFFFFFFFu : glm::packUnorm4x8(p_surface.colors[i]);
	}
	return attributes;
}

} // namespace lucent
