// SPDX-License-Identifier: MIT
#include "modules/scene/primitive_meshes.h"
#include "modules/scene/register_scene_types.h"

#include <doctest/doctest.h>

#include <glm/gtc/constants.hpp>

#include <map>
#include <tuple>

using namespace lucent;

namespace {

struct Measures {
	bool closed = true; // every edge is met once from each side
	double area = 0.0;
	double volume = 0.0; // positive: triangles face outwards
	double worst_normal = 1.0; // least cosine between a triangle and its vertices' normals
	double worst_tangent = 1.0; // least cosine between a vertex's bitangent and -dP/dv
};

using Key = std::tuple<int64_t, int64_t, int64_t>;

Key weld(const Vector3 &p_position) {
	const auto quantize = [](float p_value) { return int64_t(std::llround(double(p_value) * 1e5)); };
	return { quantize(p_position.x), quantize(p_position.y), quantize(p_position.z) };
}

void measure_tangents(const MeshSurface &p_surface, size_t p_index, Measures &r_measures) {
	const uint32_t *t = &p_surface.indices[p_index];
	const Vector3 e1 = p_surface.positions[t[1]] - p_surface.positions[t[0]];
	const Vector3 e2 = p_surface.positions[t[2]] - p_surface.positions[t[0]];
	const Vector2 u1 = p_surface.uvs[t[1]] - p_surface.uvs[t[0]];
	const Vector2 u2 = p_surface.uvs[t[2]] - p_surface.uvs[t[0]];
	const float determinant = u1.x * u2.y - u2.x * u1.y;
	REQUIRE(std::abs(determinant) > 1e-12f); // no area of texture is used twice or not at all
	const Vector3 along_v = (e2 * u1.x - e1 * u2.x) / determinant;
	for (int i = 0; i < 3; i++) {
		const Vector3 bitangent = glm::cross(p_surface.normals[t[i]], Vector3(p_surface.tangents[t[i]])) * p_surface.tangents[t[i]].w;
		r_measures.worst_tangent = std::min(r_measures.worst_tangent, double(glm::dot(glm::normalize(-along_v), glm::normalize(bitangent))));
	}
}

Measures measure(const scene::Mesh &p_mesh, bool p_tangents = true) {
	Measures measures;
	std::map<std::pair<Key, Key>, int> edges;
	const std::shared_ptr<const MeshSurface> surface = p_mesh.surface_get_arrays(0);
	REQUIRE(surface);
	REQUIRE(!surface->indices.empty());
	REQUIRE(surface->normals.size() == surface->positions.size());
	REQUIRE(surface->tangents.size() == surface->positions.size());
	REQUIRE(surface->uvs.size() == surface->positions.size());
	for (size_t i = 0; i < surface->indices.size(); i += 3) {
		Vector3 p[3];
		for (int k = 0; k < 3; k++) {
			p[k] = surface->positions[surface->indices[i + size_t(k)]];
			edges[{ weld(surface->positions[surface->indices[i + size_t(k)]]), weld(surface->positions[surface->indices[i + size_t((k + 1) % 3)]]) }]++;
		}
		const Vector3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
		measures.area += 0.5 * double(glm::length(cross));
		measures.volume += double(glm::dot(p[0], cross)) / 6.0;
		for (int k = 0; k < 3; k++) {
			const Vector3 normal = surface->normals[surface->indices[i + size_t(k)]];
			CHECK(glm::length(normal) == doctest::Approx(1.0).epsilon(1e-4));
			measures.worst_normal = std::min(measures.worst_normal, double(glm::dot(glm::normalize(cross), normal)));
		}
		if (p_tangents) {
			measure_tangents(*surface, i, measures);
		}
	}
	for (const auto &[edge, count] : edges) {
		const auto other = edges.find({ edge.second, edge.first });
		measures.closed = measures.closed && count == 1 && other != edges.end() && other->second == 1;
	}
	return measures;
}

constexpr double PI = glm::pi<double>();

} // namespace

TEST_CASE("box") {
	scene::BoxMesh box;
	box.state.size = Vector3(1, 2, 3);
	box.state.subdivide_width = 2;
	box.state.subdivide_height = 1;
	box.state.subdivide_depth = 3;
	const Measures measures = measure(box);
	CHECK(measures.closed);
	CHECK(measures.area == doctest::Approx(22.0));
	CHECK(measures.volume == doctest::Approx(6.0));
	CHECK(measures.worst_normal > 0.9999);
	CHECK(measures.worst_tangent > 0.9999);
	CHECK(box.get_aabb() == AABB{ Vector3(-0.5f, -1, -1.5f), Vector3(0.5f, 1, 1.5f) });
}

TEST_CASE("sphere, ellipsoid and hemisphere") {
	scene::SphereMesh sphere;
	Measures measures = measure(sphere);
	CHECK(measures.closed);
	CHECK(measures.area == doctest::Approx(PI).epsilon(0.01));
	CHECK(measures.volume == doctest::Approx(PI / 6.0).epsilon(0.01));
	CHECK(measures.worst_normal > 0.99);
	scene::SphereMesh egg;
	egg.state.height = 3.0f;
	measures = measure(egg);
	CHECK(measures.closed);
	CHECK(measures.volume == doctest::Approx(PI / 2.0).epsilon(0.01));
	CHECK(measures.worst_normal > 0.95);
	scene::SphereMesh dome;
	dome.state.is_hemisphere = true;
	dome.state.rings = 32;
	measures = measure(dome, false);
	CHECK(measures.closed);
	// Height 1 with radius 0.5: half of an egg of height 2.
	CHECK(measures.volume == doctest::Approx(PI / 6.0).epsilon(0.08)); // the last ring is cut off at y = 0
	CHECK(dome.get_aabb().min.y == 0.0f);
}

TEST_CASE("plane and quad face their axis") {
	for (int axis = 0; axis < 3; axis++) {
		scene::PlaneMesh plane;
		plane.state.orientation = scene::PlaneMesh::Orientation(axis);
		plane.state.size = Vector2(2, 3);
		plane.state.subdivide_width = 1;
		plane.state.center_offset = Vector3(1, 1, 1);
		const Measures measures = measure(plane);
		CHECK(measures.area == doctest::Approx(6.0));
		CHECK(measures.worst_normal > 0.9999);
		CHECK(measures.worst_tangent > 0.9999);
		CHECK(plane.surface_get_arrays(0)->normals[0][axis] == 1.0f);
		CHECK(plane.get_aabb().center() == Vector3(1, 1, 1));
	}
	const scene::QuadMesh quad;
	CHECK(quad.surface_get_arrays(0)->normals[0] == Vector3(0, 0, 1));
	// The texture's upper left corner is at the quad's, seen from the front.
	CHECK(quad.surface_get_arrays(0)->positions[0] == Vector3(-0.5f, 0.5f, 0));
	CHECK(quad.surface_get_arrays(0)->uvs[0] == Vector2(0, 0));
}

TEST_CASE("cylinder, cone and tube") {
	scene::CylinderMesh cylinder;
	Measures measures = measure(cylinder);
	CHECK(measures.closed);
	CHECK(measures.volume == doctest::Approx(PI * 0.25 * 2.0).epsilon(0.01));
	CHECK(measures.area == doctest::Approx(2.0 * PI + 0.5 * PI).epsilon(0.01));
	CHECK(measures.worst_normal > 0.99);
	scene::CylinderMesh cone;
	cone.state.top_radius = 0.0f;
	measures = measure(cone, false);
	CHECK(measures.closed);
	CHECK(measures.volume == doctest::Approx(PI * 0.25 * 2.0 / 3.0).epsilon(0.01));
	CHECK(measures.worst_normal > 0.99);
	scene::CylinderMesh tube;
	tube.state.cap_top = false;
	tube.state.cap_bottom = false;
	measures = measure(tube);
	CHECK_FALSE(measures.closed);
	CHECK(measures.area == doctest::Approx(2.0 * PI).epsilon(0.01));
}

TEST_CASE("capsule and its linked sizes") {
	scene::register_scene_classes();
	scene::CapsuleMesh capsule;
	const Measures measures = measure(capsule);
	CHECK(measures.closed);
	CHECK(measures.volume == doctest::Approx(PI * 0.25 * 1.0 + PI / 6.0).epsilon(0.01));
	CHECK(measures.worst_normal > 0.99);
	CHECK(capsule.get_aabb().max.y == doctest::Approx(1.0));
	CHECK(capsule.set("radius", 2.0));
	CHECK(capsule.get_height() == 4.0f);
	CHECK(capsule.set("height", 1.0));
	CHECK(capsule.get_radius() == 0.5f);
	CHECK(measure(capsule).volume == doctest::Approx(PI / 6.0).epsilon(0.02)); // a ball
}

TEST_CASE("prism") {
	for (const float ridge : { 0.0f, 0.25f, 0.5f, 1.0f, 1.5f }) {
		scene::PrismMesh prism;
		prism.state.left_to_right = ridge;
		prism.state.size = Vector3(2, 3, 4);
		prism.state.subdivide_height = 2;
		prism.state.subdivide_width = 1;
		prism.state.subdivide_depth = 1;
		const Measures measures = measure(prism, false);
		INFO(ridge);
		CHECK(measures.closed);
		CHECK(measures.volume == doctest::Approx(12.0));
		CHECK(measures.worst_normal > 0.9999);
	}
}

TEST_CASE("torus") {
	scene::TorusMesh torus;
	const Measures measures = measure(torus);
	CHECK(measures.closed);
	// Pappus: 2 pi R times the section's circumference or area, R = 0.75, r = 0.25.
	CHECK(measures.area == doctest::Approx(4.0 * PI * PI * 0.75 * 0.25).epsilon(0.01));
	CHECK(measures.volume == doctest::Approx(2.0 * PI * PI * 0.75 * 0.0625).epsilon(0.02));
	CHECK(measures.worst_normal > 0.98);
	CHECK(measures.worst_tangent > 0.98);
}

TEST_CASE("flipped faces, degenerate sizes and limits") {
	scene::register_scene_classes();
	scene::BoxMesh box;
	CHECK(box.set("flip_faces", true));
	CHECK(measure(box, false).volume == doctest::Approx(-1.0));
	CHECK(measure(box, false).worst_normal > 0.9999);
	CHECK(box.set("size", Vector3(0, 0, 0)));
	CHECK(box.surface_get_arrays(0)->indices.empty());
	CHECK_FALSE(box.set("subdivide_width", 1000000));
	scene::SphereMesh sphere;
	CHECK_FALSE(sphere.set("radial_segments", 0));
	CHECK_FALSE(sphere.set("radius", -1));
}
