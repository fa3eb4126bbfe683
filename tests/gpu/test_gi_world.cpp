// SPDX-License-Identifier: MIT
// The voxelised world against brute force: coverage against triangle-box overlap, the distance field against all pairs.
#include "servers/rendering/gi/world/gi_world.h"
#include "tests/gpu/gi_test_scene.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/gpu/shaders/test_io.h"

#include <doctest/doctest.h>

#include <random>

using namespace lucent;
using lucent::test::GpuFixture;

namespace {

constexpr uint32_t GRID = 64;

// Separating axes (Akenine-Möller, "Fast 3D Triangle-Box Overlap Testing", 2001): three box axes, the plane, nine edge products.
bool triangle_overlaps_box(const glm::dvec3 p_v[3], const glm::dvec3 &p_center, double p_half) {
	glm::dvec3 v[3], edges[3];
	for (int i = 0; i < 3; i++) {
		v[i] = p_v[i] - p_center;
	}
	for (int i = 0; i < 3; i++) {
		edges[i] = v[(i + 1) % 3] - v[i];
	}
	const auto separates = [&](const glm::dvec3 &p_axis) {
		const double a = glm::dot(v[0], p_axis), b = glm::dot(v[1], p_axis), c = glm::dot(v[2], p_axis);
		const double reach = p_half * (std::abs(p_axis.x) + std::abs(p_axis.y) + std::abs(p_axis.z));
		return std::min(a, std::min(b, c)) > reach || std::max(a, std::max(b, c)) < -reach;
	};
	for (int i = 0; i < 3; i++) {
		glm::dvec3 axis(0.0);
		axis[i] = 1.0;
		if (separates(axis)) {
			return false;
		}
		for (int k = 0; k < 3; k++) {
			if (separates(glm::cross(axis, edges[k]))) {
				return false;
			}
		}
	}
	return !separates(glm::cross(edges[0], edges[1]));
}

uint32_t brick_index(const glm::uvec3 &p_storage) {
	const uint32_t axis = GRID / 4;
	return ((p_storage.z / 4) * axis + p_storage.y / 4) * axis + p_storage.x / 4;
}
uint32_t bit_index(const glm::uvec3 &p_storage) {
	return p_storage.x % 4 + 4 * (p_storage.y % 4) + 16 * (p_storage.z % 4);
}

struct ReadWorld {
	std::vector<uint64_t> occupancy;
	std::vector<uint32_t> cell_base;
	std::vector<shader::WorldCell> cells;
	std::vector<uint8_t> sdf;
	Vector3i origin{ 0 };

	glm::uvec3 storage(const Vector3i &p_cell) const { return glm::uvec3((p_cell + origin) & Vector3i(int(GRID) - 1)); }
	bool occupied(const Vector3i &p_cell) const {
		const glm::uvec3 s = storage(p_cell);
		return (occupancy[brick_index(s)] >> bit_index(s) & 1) != 0;
	}
	uint64_t bits(const Vector3i &p_cell) const {
		const glm::uvec3 s = storage(p_cell);
		const uint64_t below = occupancy[brick_index(s)] & ((uint64_t(1) << bit_index(s)) - 1);
		const shader::WorldCell &cell = cells[cell_base[brick_index(s)] + uint32_t(__builtin_popcountll(below))];
		return uint64_t(cell.bits.x) | uint64_t(cell.bits.y) << 32;
	}
};

ReadWorld build_and_read(RenderingDevice &p_device, GiWorld &r_world, const GiSceneView &p_view) {
	PassRecorder &recorder = p_device.begin_frame();
	r_world.upload_params(recorder);
	r_world.rebuild_cascade(recorder, p_view, 0);
	p_device.end_frame();
	ReadWorld result;
	result.occupancy = p_device.read_back_buffer<uint64_t>(r_world.occupancy_handle());
	result.cell_base = p_device.read_back_buffer<uint32_t>(r_world.brick_cell_base_handle());
	result.cells = p_device.read_back_buffer<shader::WorldCell>(r_world.cells_handle());
	result.sdf = p_device.read_back_buffer<uint8_t>(r_world.sdf_handle());
	result.origin = r_world.origin_cells(0);
	return result;
}

struct ExactHit {
	double t_m = -1.0; // -1: nothing
	uint32_t triangle = 0;
	uint32_t face = 0; // of the front
	bool from_front = false;
	bool doubtful = false; // the ray passes within a millimetre of an edge, or two surfaces are as near, or it starts or ends on one
};

ExactHit meet_exactly(const std::vector<Vector3> &p_corners, const shader::TestRay &p_ray) {
	ExactHit nearest;
	const glm::dvec3 o(p_ray.origin_m), d(p_ray.direction);
	for (size_t i = 0; i + 2 < p_corners.size(); i += 3) {
		const glm::dvec3 v[3] = { glm::dvec3(p_corners[i]), glm::dvec3(p_corners[i + 1]), glm::dvec3(p_corners[i + 2]) };
		const glm::dvec3 n = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
		const double along = glm::dot(n, d), t = glm::dot(n, v[0] - o) / along;
		double inside = 1e9;
		for (int k = 0; k < 3; k++) {
			inside = std::min(inside, glm::dot(glm::cross(glm::normalize(v[(k + 1) % 3] - v[k]), o + t * d - v[k]), n));
		}
		const bool near_plane = std::abs(along) < 0.02 && std::abs(glm::dot(n, v[0] - o)) < 0.1;
		if (t > -0.01 && inside > -0.001 && (inside < 0.001 || near_plane || t < 0.01 || std::abs(t - 0.5) < 0.01)) {
			nearest.doubtful = true;
		}
		if (t < 0.0 || inside < 0.0) {
			continue;
		}
		nearest.doubtful = nearest.doubtful || (nearest.t_m >= 0.0 && std::abs(t - nearest.t_m) < 0.002);
		if (nearest.t_m < 0.0 || t < nearest.t_m) {
			const glm::dvec3 a = glm::abs(n);
			const uint32_t axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
			nearest.doubtful = nearest.doubtful || std::abs(a[axis] - a[(axis + 1) % 3]) < 1e-4 || std::abs(a[axis] - a[(axis + 2) % 3]) < 1e-4;
			nearest.t_m = t;
			nearest.triangle = uint32_t(i / 3);
			nearest.face = axis * 2 + (n[int(axis)] < 0.0 ? 1 : 0);
			nearest.from_front = along < 0.0;
		}
	}
	return nearest;
}

std::vector<shader::TestHit> trace_rays(RenderingDevice &p_device, GiWorld &r_world, const GiSceneView &p_view, const std::vector<shader::TestRay> &p_rays) {
	const OwnedBuffer rays = p_device.create_buffer({ .size_bytes = p_rays.size() * sizeof(shader::TestRay), .name = "rays" });
	const OwnedBuffer hits = p_device.create_buffer({ .size_bytes = p_rays.size() * sizeof(shader::TestHit), .name = "hits" });
	p_device.upload_buffer(rays, p_rays);
	PassRecorder &recorder = p_device.begin_frame();
	r_world.upload_params(recorder);
	r_world.store_triangles(recorder, p_view);
	r_world.rebuild_cascade(recorder, p_view, 0);
	ComputePass pass = recorder.compute("trace_rays", Shader::TEST_RAYS);
	r_world.bind_light(pass, p_view.sky_octahedral);
	pass.read(TEST_RAY_SOURCE, rays).write(TEST_RAY_HITS, hits).constants(shader::TestConstants{ .count = uint32_t(p_rays.size()), .value = 0 });
	pass.dispatch_threads(uint32_t(p_rays.size()));
	p_device.end_frame();
	return p_device.read_back_buffer<shader::TestHit>(hits);
}

template <typename F>
void for_each_cell(F &&p_visit) {
	for (int z = 0; z < int(GRID); z++) {
		for (int y = 0; y < int(GRID); y++) {
			for (int x = 0; x < int(GRID); x++) {
				p_visit(Vector3i(x, y, z));
			}
		}
	}
}

} // namespace

TEST_SUITE("gpu") {
	TEST_CASE("floors over a whole cascade are solid in every cell") {
		GpuFixture fixture;
		RenderingDevice &device = fixture.device();
		GiTestScene scene(device);
		const uint32_t material = scene.add_material(Vector3(0.5f));
		// Twelve triangles, one work group's, of 4096 columns of cells each.
		for (int layer = -3; layer < 3; layer++) {
			const float y = float(layer) * 0.8f + 0.07f;
			scene.add_quad(Vector3(-9.0f, y, 9.0f), Vector3(9.0f, y, 9.0f), Vector3(9.0f, y, -9.0f), Vector3(-9.0f, y, -9.0f), material);
		}
		GiWorld world(device, { .cascades = 1, .grid_size = GRID, .min_cell_m = 0.2f, .y_multiplier = 1.0f });
		world.set_origin_cells(0, Vector3i(-32));
		const ReadWorld read = build_and_read(device, world, scene.upload());
		uint32_t wrong = 0;
		for_each_cell([&](const Vector3i &p_cell) {
			const int y = p_cell.y - 32;
			const bool floor_cell = y >= -12 && y < 12 && (y + 12) % 4 == 0;
			// 0.07 m into a cell of 0.2 m: the second layer of sub-voxels.
			wrong += read.occupied(p_cell) != floor_cell || (floor_cell && read.bits(p_cell) != 0x00F000F000F000F0u) ? 1 : 0;
		});
		CHECK(wrong == 0);
	}

	TEST_CASE("every sub-voxel that a triangle touches is solid, and no other beyond the touch distance") {
		GpuFixture fixture;
		RenderingDevice &device = fixture.device();
		GiTestScene scene(device);
		const uint32_t material = scene.add_material(Vector3(0.5f));
		std::mt19937 random(7);
		std::uniform_real_distribution<float> place(-5.0f, 5.0f);
		std::uniform_real_distribution<float> spread(-1.5f, 1.5f);
		for (int i = 0; i < 12; i++) {
			const Vector3 a(place(random), place(random) * 0.6f, place(random));
			const auto corner = [&]() { return a + Vector3(spread(random), spread(random), spread(random)); };
			const Vector3 b = corner(), c = corner();
			scene.add_triangle(a, b, c, material);
		}
		scene.add_box(Vector3(-2.0f, -1.0f, -2.0f), Vector3(2.0f, 1.0f, 2.0f), material); // on cell borders
		GiWorld world(device, { .cascades = 1, .grid_size = GRID, .min_cell_m = 0.2f, .y_multiplier = 1.5f });
		world.set_origin_cells(0, Vector3i(-32, -40, -24));
		const ReadWorld read = build_and_read(device, world, scene.upload());

		const std::vector<Vector3> &corners = scene.triangle_corners();
		const Vector3 cell_m = world.cell_m(0);
		uint32_t missing = 0, surplus = 0, solid = 0;
		std::vector<glm::dvec3> local;
		for (const Vector3 &corner : corners) {
			local.push_back(glm::dvec3(corner) / glm::dvec3(cell_m) - glm::dvec3(read.origin));
		}
		for_each_cell([&](const Vector3i &p_cell) {
			uint64_t inner = 0, outer = 0;
			for (size_t t = 0; t < local.size(); t += 3) {
				if (!triangle_overlaps_box(&local[t], glm::dvec3(p_cell) + 0.5, 0.51)) {
					continue;
				}
				for (uint32_t i = 0; i < 64; i++) {
					const glm::dvec3 center = glm::dvec3(p_cell) + (glm::dvec3(i % 4, i / 4 % 4, i / 16) + 0.5) / 4.0;
					inner |= uint64_t(triangle_overlaps_box(&local[t], center, 0.125)) << i;
					outer |= uint64_t(triangle_overlaps_box(&local[t], center, 0.125 + 2.5 * WORLD_TOUCH_SUB_VOXELS / 4.0)) << i;
				}
			}
			const uint64_t bits = read.occupied(p_cell) ? read.bits(p_cell) : 0;
			missing += uint32_t(__builtin_popcountll(inner & ~bits));
			surplus += uint32_t(__builtin_popcountll(bits & ~outer));
			solid += uint32_t(__builtin_popcountll(bits));
		});
		CHECK(solid > 10000);
		CHECK(missing == 0);
		CHECK(surplus == 0);
	}

	// Cells list their triangles, so rays must meet what double precision meets, whatever the bits around it.
	TEST_CASE("rays and short ways meet the triangles themselves, front and back, and nothing else") {
		GpuFixture fixture;
		RenderingDevice &device = fixture.device();
		GiTestScene scene(device);
		const uint32_t one_sided = scene.add_material(Vector3(0.5f));
		const uint32_t double_sided = scene.add_material(Vector3(0.5f), Vector3(0.0f), true);
		constexpr uint32_t TRIANGLES = 160, RAYS = 8192;
		std::mt19937 random(11);
		std::uniform_real_distribution<float> place(-3.0f, 3.0f);
		std::normal_distribution<float> spread(0.0f, 0.5f);
		for (uint32_t i = 0; i < TRIANGLES; i++) { // the scene keeps them by material: in this order
			const Vector3 a(place(random), place(random), place(random));
			const auto corner = [&]() { return a + Vector3(spread(random), spread(random), spread(random)); };
			const Vector3 b = corner(), c = corner();
			scene.add_triangle(a, b, c, i < TRIANGLES / 2 ? one_sided : double_sided);
		}
		std::vector<shader::TestRay> rays(RAYS);
		for (shader::TestRay &ray : rays) {
			ray.origin_m = Vector3(place(random), place(random), place(random));
			ray.direction = glm::normalize(Vector3(spread(random), spread(random), spread(random)));
		}
		GiWorld world(device, { .cascades = 1, .grid_size = GRID, .min_cell_m = 0.2f, .y_multiplier = 1.5f });
		world.set_origin_cells(0, Vector3i(-32, -32, -32));
		const std::vector<shader::TestHit> hits = trace_rays(device, world, scene.upload(), rays);
		uint32_t judged = 0, met = 0, wrong_way = 0, wrong_face = 0, wrong_free = 0;
		for (uint32_t i = 0; i < RAYS; i++) {
			const ExactHit exact = meet_exactly(scene.triangle_corners(), rays[i]);
			if (exact.doubtful) {
				continue;
			}
			judged++;
			met += exact.t_m >= 0.0 ? 1 : 0;
			wrong_way += std::abs(exact.t_m - double(hits[i].t_m)) > 1e-3 ? 1 : 0;
			const uint32_t front = exact.face, face = exact.from_front ? front : (exact.triangle < TRIANGLES / 2 ? 6u : front ^ 1u);
			wrong_face += exact.t_m >= 0.0 && hits[i].face != face ? 1 : 0;
			wrong_free += (hits[i].free_way != 0) != (exact.t_m < 0.0 || exact.t_m > 0.5) ? 1 : 0;
		}
		CHECK(judged > RAYS * 9 / 10);
		CHECK(met > judged / 8); // the scene is no empty one
		CHECK(wrong_way == 0);
		CHECK(wrong_face == 0);
		CHECK(wrong_free == 0);
	}

	TEST_CASE("the distance field is the distance to the nearest stored cell, rounded down to a sixteenth, up to 15 cells") {
		GpuFixture fixture;
		RenderingDevice &device = fixture.device();
		GiTestScene scene(device);
		const uint32_t material = scene.add_material(Vector3(0.5f));
		std::mt19937 random(3);
		std::uniform_real_distribution<float> place(-6.0f, 6.0f);
		for (int i = 0; i < 9; i++) {
			const Vector3 a(place(random), place(random), place(random));
			scene.add_triangle(a, a + Vector3(0.1f, 0.0f, 0.0f), a + Vector3(0.0f, 0.1f, 0.05f), material);
		}
		GiWorld world(device, { .cascades = 1, .grid_size = GRID, .min_cell_m = 0.2f, .y_multiplier = 1.0f });
		world.set_origin_cells(0, Vector3i(-40, -32, -28));
		const ReadWorld read = build_and_read(device, world, scene.upload());
		std::vector<Vector3i> occupied;
		for_each_cell([&](const Vector3i &p_cell) {
			if (read.occupied(p_cell)) {
				occupied.push_back(p_cell);
			}
		});
		REQUIRE(occupied.size() >= 9);
		uint32_t wrong = 0;
		for_each_cell([&](const Vector3i &p_cell) {
			int best = INT32_MAX;
			for (const Vector3i &other : occupied) {
				const Vector3i d = other - p_cell;
				best = std::min(best, d.x * d.x + d.y * d.y + d.z * d.z);
			}
			const uint32_t expected = std::min(255u, uint32_t(std::floor(std::sqrt(float(best)) * 16.0f)));
			const glm::uvec3 s = read.storage(p_cell);
			wrong += read.sdf[brick_index(s) * 64 + bit_index(s)] != expected;
		});
		CHECK(wrong == 0);
	}
}
