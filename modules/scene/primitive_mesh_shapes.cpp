// SPDX-License-Identifier: MIT
// The vertices of the shapes. Everything is made of grids: u runs to the right and v down as seen from the front, so that the
// bitangent cross(normal, tangent) points against v, as normal maps with y up want it.
#include "modules/scene/primitive_meshes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>

namespace lucent::scene {

namespace {

struct Vertex {
	Vector3 position;
	Vector3 normal;
	Vector3 tangent;
	Vector2 uv;
};

void add_vertex(MeshSurface &r_surface, const Vertex &p_vertex) {
	r_surface.positions.push_back(p_vertex.position);
	r_surface.normals.push_back(p_vertex.normal);
	r_surface.tangents.push_back(Vector4(p_vertex.tangent, 1.0f));
	r_surface.uvs.push_back(p_vertex.uv);
}

// Leaves out triangles without area: poles, apexes, sides of length 0.
void add_triangle(MeshSurface &r_surface, uint32_t p_a, uint32_t p_b, uint32_t p_c) {
	const Vector3 &a = r_surface.positions[p_a];
	const Vector3 &b = r_surface.positions[p_b];
	const Vector3 &c = r_surface.positions[p_c];
	if (a != b && b != c && c != a) {
		r_surface.indices.insert(r_surface.indices.end(), { p_a, p_b, p_c });
	}
}

// p_vertex(i, j) for i in 0..p_columns, j in 0..p_rows.
template <typename F>
void add_grid(MeshSurface &r_surface, int p_columns, int p_rows, F &&p_vertex) {
	const uint32_t first = uint32_t(r_surface.positions.size());
	const uint32_t pitch = uint32_t(p_columns) + 1;
	for (int j = 0; j <= p_rows; j++) {
		for (int i = 0; i <= p_columns; i++) {
			add_vertex(r_surface, p_vertex(i, j));
		}
	}
	for (uint32_t j = 0; j < uint32_t(p_rows); j++) {
		for (uint32_t i = 0; i < uint32_t(p_columns); i++) {
			const uint32_t corner = first + j * pitch + i;
			add_triangle(r_surface, corner, corner + pitch, corner + pitch + 1);
			add_triangle(r_surface, corner, corner + pitch + 1, corner + 1);
		}
	}
}

// sin and cos of i / count of a turn; the last equals the first exactly, so that seams close.
Vector2 turn(int p_index, int p_count) {
	const float angle = glm::two_pi<float>() * float(p_index % p_count) / float(p_count);
	return Vector2(std::sin(angle), std::cos(angle));
}

// A flat face: p_u and p_v are its edges, from the upper left corner.
void add_face(MeshSurface &r_surface, const Vector3 &p_corner, const Vector3 &p_u, const Vector3 &p_v, int p_columns, int p_rows, const Vector3 &p_normal, const Vector3 &p_tangent, const Vector4 &p_uv_rect) {
	add_grid(r_surface, p_columns, p_rows, [&](int p_i, int p_j) {
		const Vector2 t(float(p_i) / float(p_columns), float(p_j) / float(p_rows));
		return Vertex{ p_corner + p_u * t.x + p_v * t.y, p_normal, p_tangent, Vector2(p_uv_rect.x, p_uv_rect.y) + Vector2(p_uv_rect.z, p_uv_rect.w) * t };
	});
}

constexpr float THIRD = 1.0f / 3.0f;
const Vector3 X(1, 0, 0), Y(0, 1, 0), Z(0, 0, 1);

// A disc that faces up or down. Its texture is a circle in the lower half of the unit square: left for the top, right for the bottom.
void add_cap(MeshSurface &r_surface, float p_radius, float p_y, bool p_top, int p_segments) {
	const uint32_t center = uint32_t(r_surface.positions.size());
	const Vector3 normal = p_top ? Y : -Y;
	add_vertex(r_surface, { Vector3(0, p_y, 0), normal, X, Vector2(p_top ? 0.25f : 0.75f, 0.75f) });
	for (int i = 0; i <= p_segments; i++) {
		const Vector2 direction = turn(i, p_segments); // x and z
		const Vector2 uv = p_top ? Vector2((direction.x + 1.0f) * 0.25f, 0.5f + (direction.y + 1.0f) * 0.25f)
								 : Vector2(0.5f + (direction.x + 1.0f) * 0.25f, 1.0f - (direction.y + 1.0f) * 0.25f);
		add_vertex(r_surface, { Vector3(direction.x * p_radius, p_y, direction.y * p_radius), normal, X, uv });
		if (i > 0) {
			const uint32_t last = center + uint32_t(i);
			add_triangle(r_surface, center, p_top ? last : last + 1, p_top ? last + 1 : last);
		}
	}
}

} // namespace

MeshSurface BoxMesh::create_surface() const {
	MeshSurface s;
	const Vector3 h = 0.5f * state.size;
	const Vector3 sx = X * state.size.x, sy = Y * state.size.y, sz = Z * state.size.z;
	const int nx = state.subdivide_width + 1, ny = state.subdivide_height + 1, nz = state.subdivide_depth + 1;
	// Six tiles, three by two.
	add_face(s, Vector3(-h.x, h.y, h.z), sx, -sy, nx, ny, Z, X, { 0, 0, THIRD, 0.5f });
	add_face(s, Vector3(h.x, h.y, -h.z), -sx, -sy, nx, ny, -Z, -X, { 2 * THIRD, 0, THIRD, 0.5f });
	add_face(s, Vector3(h.x, h.y, h.z), -sz, -sy, nz, ny, X, -Z, { THIRD, 0, THIRD, 0.5f });
	add_face(s, Vector3(-h.x, h.y, -h.z), sz, -sy, nz, ny, -X, Z, { 0, 0.5f, THIRD, 0.5f });
	add_face(s, Vector3(-h.x, h.y, -h.z), sx, sz, nx, nz, Y, X, { THIRD, 0.5f, THIRD, 0.5f });
	add_face(s, Vector3(h.x, -h.y, -h.z), -sx, sz, nx, nz, -Y, -X, { 2 * THIRD, 0.5f, THIRD, 0.5f });
	return s;
}

MeshSurface SphereMesh::create_surface() const {
	MeshSurface s;
	const float radius = state.radius;
	const float half_height = state.is_hemisphere ? state.height : 0.5f * state.height;
	const int bands = state.rings + 1;
	add_grid(s, state.radial_segments, bands, [&](int p_i, int p_j) {
		const Vector2 around = turn(p_i, state.radial_segments);
		const float v = float(p_j) / float(bands);
		const float ring = p_j == 0 || p_j == bands ? 0.0f : std::sin(glm::pi<float>() * v);
		const float y = std::cos(glm::pi<float>() * v);
		const Vector3 tangent(around.y, 0, -around.x);
		const Vector2 uv(float(p_i) / float(state.radial_segments), v);
		if (state.is_hemisphere && y < 0.0f) {
			return Vertex{ Vector3(around.x * radius * ring, 0, around.y * radius * ring), -Y, tangent, uv };
		}
		// The gradient of (x/r)^2 + (y/h)^2 + (z/r)^2.
		const Vector3 normal = glm::normalize(Vector3(around.x * ring * half_height, y * radius, around.y * ring * half_height));
		return Vertex{ Vector3(around.x * radius * ring, y * half_height, around.y * radius * ring), normal, tangent, uv };
	});
	return s;
}

MeshSurface PlaneMesh::create_surface() const {
	MeshSurface s;
	const Vector2 size = state.size;
	// Right, down and front as seen from the front.
	const Vector3 right = state.orientation == Orientation::FACE_X ? -Z : X;
	const Vector3 down = state.orientation == Orientation::FACE_Y ? Z : -Y;
	const Vector3 normal = state.orientation == Orientation::FACE_X ? X : state.orientation == Orientation::FACE_Y ? Y
																												   : Z;
	const Vector3 corner = state.center_offset - 0.5f * (right * size.x + down * size.y);
	add_face(s, corner, right * size.x, down * size.y, state.subdivide_width + 1, state.subdivide_depth + 1, normal, right, { 0, 0, 1, 1 });
	return s;
}

MeshSurface CylinderMesh::create_surface() const {
	MeshSurface s;
	const int bands = state.rings + 1;
	const float slope = (state.bottom_radius - state.top_radius) / state.height;
	add_grid(s, state.radial_segments, bands, [&](int p_i, int p_j) {
		const Vector2 around = turn(p_i, state.radial_segments);
		const float v = float(p_j) / float(bands);
		const float radius = glm::mix(state.top_radius, state.bottom_radius, v);
		const Vector3 position(around.x * radius, state.height * (0.5f - v), around.y * radius);
		return Vertex{ position, glm::normalize(Vector3(around.x, slope, around.y)), Vector3(around.y, 0, -around.x), Vector2(float(p_i) / float(state.radial_segments), 0.5f * v) };
	});
	if (state.cap_top && state.top_radius > 0.0f) {
		add_cap(s, state.top_radius, 0.5f * state.height, true, state.radial_segments);
	}
	if (state.cap_bottom && state.bottom_radius > 0.0f) {
		add_cap(s, state.bottom_radius, -0.5f * state.height, false, state.radial_segments);
	}
	return s;
}

MeshSurface CapsuleMesh::create_surface() const {
	MeshSurface s;
	const int bands = state.rings + 1;
	const float middle = std::max(0.0f, 0.5f * state.height - state.radius); // half height of the straight part
	// The three parts' rows in one grid: each third of the texture is one part.
	add_grid(s, state.radial_segments, 3 * bands, [&](int p_i, int p_j) {
		const Vector2 around = turn(p_i, state.radial_segments);
		const float v = float(p_j) / float(3 * bands);
		const float part = 3.0f * v; // 0..1 top, 1..2 middle, 2..3 bottom
		const float angle = glm::half_pi<float>() * (part <= 1.0f ? part : part <= 2.0f ? 1.0f
																						: part - 1.0f);
		const bool pole = p_j == 0 || p_j == 3 * bands;
		const Vector2 profile(pole ? 0.0f : std::sin(angle), p_j > bands && p_j < 2 * bands ? 0.0f : std::cos(angle));
		const float center_y = middle * std::clamp(3.0f - 2.0f * part, -1.0f, 1.0f);
		const Vector3 normal(around.x * profile.x, profile.y, around.y * profile.x);
		return Vertex{ normal * state.radius + Y * center_y, glm::normalize(normal), Vector3(around.y, 0, -around.x), Vector2(float(p_i) / float(state.radial_segments), v) };
	});
	return s;
}

MeshSurface PrismMesh::create_surface() const {
	MeshSurface s;
	const Vector3 size = state.size;
	const Vector3 h = 0.5f * size;
	const float ridge = state.left_to_right;
	const int nx = state.subdivide_width + 1, ny = state.subdivide_height + 1, nz = state.subdivide_depth + 1;
	// Front and back: rows as wide as the triangle is there.
	for (const bool front : { true, false }) {
		const float sign = front ? 1.0f : -1.0f;
		const float apex = front ? ridge : 1.0f - ridge; // from the left as seen
		const float uv_left = front ? 0.0f : 2 * THIRD;
		add_grid(s, nx, ny, [&](int p_i, int p_j) {
			const float down = float(p_j) / float(ny);
			const float across = (1.0f - down) * apex + down * float(p_i) / float(nx);
			return Vertex{ Vector3(sign * (across - 0.5f) * size.x, h.y - down * size.y, sign * h.z), sign * Z, sign * X, Vector2(uv_left + across * THIRD, 0.5f * down) };
		});
	}
	const Vector3 apex((ridge - 0.5f) * size.x, h.y, 0);
	const Vector3 right_down = Vector3(h.x, -h.y, 0) - apex;
	const Vector3 left_down = Vector3(-h.x, -h.y, 0) - apex;
	const Vector3 right_normal = glm::normalize(Vector3(size.y, right_down.x, 0));
	const Vector3 left_normal = glm::normalize(Vector3(-size.y, -left_down.x, 0));
	add_face(s, apex + Z * h.z, -Z * size.z, right_down, nz, ny, right_normal, -Z, { THIRD, 0, THIRD, 0.5f });
	add_face(s, apex - Z * h.z, Z * size.z, left_down, nz, ny, left_normal, Z, { 0, 0.5f, THIRD, 0.5f });
	add_face(s, Vector3(h.x, -h.y, -h.z), -X * size.x, Z * size.z, nx, nz, -Y, -X, { 2 * THIRD, 0.5f, THIRD, 0.5f });
	return s;
}

MeshSurface TorusMesh::create_surface() const {
	MeshSurface s;
	const auto [inner, outer] = std::minmax(state.inner_radius, state.outer_radius);
	const float tube = 0.5f * (outer - inner);
	const float middle = inner + tube;
	add_grid(s, state.rings, state.ring_segments, [&](int p_i, int p_j) {
		const Vector2 axis = -turn(p_i, state.rings); // x and z, away from the axis
		const Vector2 section = turn(p_j, state.ring_segments); // starts inside, goes over the top
		const float outwards = -section.y;
		const Vector3 normal(axis.x * outwards, section.x, axis.y * outwards);
		const float distance = middle + tube * outwards;
		return Vertex{ Vector3(axis.x * distance, section.x * tube, axis.y * distance), normal, Vector3(axis.y, 0, -axis.x), Vector2(float(p_i) / float(state.rings), float(p_j) / float(state.ring_segments)) };
	});
	return s;
}

} // namespace lucent::scene
