// SPDX-License-Identifier: MIT
// Sealed rooms under a white sky: whatever light is in them came through a wall.
#include "tests/gpu/gi_test_scene.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/test_support.h"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

using namespace lucent;
using lucent::test::GpuFixture;

namespace {

constexpr float ANGLES_DEG[] = { 0.0f, 3.0f, 8.0f, 15.0f, 22.5f, 30.0f, 38.0f, 45.0f };
constexpr float WALLS_M[] = { 0.05f, 0.02f };
constexpr int OFFSETS = 64;
constexpr int ROOMS = 8; // of a scene
const Vector3 HALF_M = { 0.55f, 0.45f, 0.5f }; // inside
constexpr uint32_t PIXELS = 48; // a side of a picture of a room's side
// Of a picture's sides to the room's, so that the outermost pixels' centres are 0.01 mm from the edges.
constexpr float REACH = float(PIXELS) / float(PIXELS - 1) * (1.0f - 2e-5f);

SdfgiSettings leak_settings(uint32_t p_cascades, uint32_t p_grid_cells, SdfgiYScale p_scale) {
	SdfgiSettings settings;
	settings.enabled = true;
	settings.cascades = p_cascades;
	settings.grid_size_cells = p_grid_cells;
	settings.min_cell_size_m = 0.1f;
	settings.y_scale = p_scale;
	settings.frames_to_converge = 4;
	return settings;
}

// Each stands on its own place between the cells, 7 to 182 mm along the diagonal and a little beside it.
Projection frame_of(int p_offset, float p_angle_deg) {
	const int i = p_offset % ROOMS;
	const float off_m = 0.007f + 0.175f * float(p_offset) / float(OFFSETS - 1);
	const Vector3 corner = Vector3(float(i & 1), float((i >> 1) & 1), float(i >> 2)) * 1.8f - 0.9f;
	const Vector3 center = corner + Vector3(off_m, 0.61f * off_m, 1.37f * off_m);
	return glm::rotate(glm::translate(Projection(1.0f), center), glm::radians(p_angle_deg), Vector3(0.0f, 1.0f, 0.0f));
}

// Floor and ceiling reach under and over the walls, two walls past the ends of the others.
void add_room(GiTestScene &r_scene, uint32_t p_material, const Vector3 &p_half_m, float p_wall_m) {
	const Vector3 in = p_half_m;
	const Vector3 out = p_half_m + p_wall_m;
	r_scene.add_box({ -out.x, -out.y, -out.z }, { out.x, -in.y, out.z }, p_material);
	r_scene.add_box({ -out.x, in.y, -out.z }, { out.x, out.y, out.z }, p_material);
	r_scene.add_box({ -out.x, -in.y, -out.z }, { out.x, in.y, -in.z }, p_material);
	r_scene.add_box({ -out.x, -in.y, in.z }, { out.x, in.y, out.z }, p_material);
	r_scene.add_box({ -out.x, -in.y, -in.z }, { -in.x, in.y, in.z }, p_material);
	r_scene.add_box({ in.x, -in.y, -in.z }, { out.x, in.y, in.z }, p_material);
}

struct Leak {
	int pixels = 0;
	float largest = 0.0f;
};

// All over the six sides of a room, up to a hundredth of a millimetre from the edges. Seen from the middle and from a corner.
Leak leak_of(RenderingDevice &p_device, Sdfgi &r_sdfgi, const Projection &p_frame, const Vector3 &p_half_m) {
	Leak leak;
	for (int side = 0; side < 12; side++) {
		const int axis = side % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
		const float to = (side / 3) % 2 ? 1.0f : -1.0f;
		Vector3 center(0.0f), along_u(0.0f), along_v(0.0f), normal(0.0f);
		center[axis] = to * p_half_m[axis];
		along_u[u] = 2.0f * p_half_m[u] * REACH;
		along_v[v] = 2.0f * p_half_m[v] * REACH;
		normal[axis] = -to;
		const Vector3 eye = side < 6 ? Vector3(0.0f) : Vector3(-0.9f, 0.85f, 0.9f) * p_half_m;
		const auto turned = [&](const Vector3 &p_vector, float p_w) { return Vector3(p_frame * Vector4(p_vector, p_w)); };
		const GiTestPatch patch = { .center_m = turned(center, 1.0f), .u_m = turned(along_u, 0.0f), .v_m = turned(along_v, 0.0f), .normal = turned(normal, 0.0f), .eye_m = turned(eye, 1.0f), .width = PIXELS, .height = PIXELS };
		for (const Vector3 &light : gather_patch(p_device, r_sdfgi, patch)) {
			leak.pixels += light != Vector3(0.0f);
			leak.largest = std::max({ leak.largest, light.x, light.y, light.z });
		}
	}
	return leak;
}

} // namespace

TEST_SUITE("gpu") {
	// 64 offsets x 8 angles x 2 thicknesses with --whole, else a scene of each thickness.
	TEST_CASE("sealed rooms under a white sky stay exactly black") {
		GpuFixture fixture;
		const SdfgiSettings settings = leak_settings(1, 64, SdfgiYScale::SCALE_75_PERCENT);
		int rooms = 0, leaking = 0;
		for (const float wall_m : WALLS_M) {
			for (const float angle_deg : ANGLES_DEG) {
				for (int first = 0; first < OFFSETS; first += ROOMS) {
					if (!test::options().whole && (angle_deg != 15.0f || first != (wall_m < 0.04f ? 16 : 40))) {
						continue;
					}
					GiTestScene scene(fixture.device());
					const uint32_t white = scene.add_material(Vector3(0.8f));
					scene.set_sky(Vector3(1.0f), Vector3(1.0f));
					for (int i = 0; i < ROOMS; i++) {
						scene.set_frame(frame_of(first + i, angle_deg));
						add_room(scene, white, HALF_M, wall_m);
					}
					Sdfgi sdfgi(fixture.device());
					run_sdfgi(fixture.device(), sdfgi, settings, scene.upload(), Vector3(0.0f), 6);
					for (int i = 0; i < ROOMS; i++) {
						const Leak leak = leak_of(fixture.device(), sdfgi, frame_of(first + i, angle_deg), HALF_M);
						CHECK_MESSAGE(leak.pixels == 0, "walls of " << wall_m << " m, " << angle_deg << " degrees, offset " << first + i << ": " << leak.pixels << " pixels, largest " << leak.largest);
						rooms++;
						leaking += leak.pixels > 0;
					}
					// Outside there is light.
					const Projection frame = frame_of(first, angle_deg);
					const Vector3 top = Vector3(frame * Vector4(0.0f, HALF_M.y + wall_m, 0.0f, 1.0f));
					CHECK(gather_at(fixture.device(), sdfgi, { top }, { { 0, 1, 0 } })[0].x > 0.3f);
				}
			}
		}
		MESSAGE("rooms: " << rooms << ", of which leak: " << leaking);
	}

	// Walls a few cells past the edge of the finest cascade, whose distance field doesn't know them: rays must not step over them.
	TEST_CASE("a sealed room that reaches past a cascade's edge stays exactly black") {
		GpuFixture fixture;
		const SdfgiSettings settings = leak_settings(2, 32, SdfgiYScale::SCALE_100_PERCENT);
		for (const float past_m : { 0.13f, 0.42f }) {
			INFO(past_m);
			GiTestScene scene(fixture.device());
			const uint32_t white = scene.add_material(Vector3(0.8f));
			scene.set_sky(Vector3(1.0f), Vector3(1.0f));
			const Vector3 half_m(1.6f + past_m, 1.3f, 1.6f + past_m);
			add_room(scene, white, half_m, 0.05f);
			Sdfgi sdfgi(fixture.device());
			run_sdfgi(fixture.device(), sdfgi, settings, scene.upload(), Vector3(0.0f), 6);
			const Leak leak = leak_of(fixture.device(), sdfgi, Projection(1.0f), half_m);
			CHECK_MESSAGE(leak.pixels == 0, leak.pixels << " pixels, largest " << leak.largest);
		}
	}
}
