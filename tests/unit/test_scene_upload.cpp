// SPDX-License-Identifier: MIT
// What happens to meshes, textures and draws before they reach the device.
#include "servers/rendering/frame_setup.h"
#include "servers/rendering/mesh_attributes.h"
#include "servers/rendering/range_allocator.h"
#include "servers/rendering/scene_cull.h"
#include "servers/rendering/texture_mips.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace lucent;

TEST_CASE("range allocator: freed neighbours join, growth extends the last gap") {
	RangeAllocator ranges;
	CHECK(ranges.allocate(1) == UINT64_MAX);
	ranges.grow(10);
	CHECK(ranges.allocate(4) == 0);
	CHECK(ranges.allocate(4) == 4);
	CHECK(ranges.allocate(4) == UINT64_MAX);
	ranges.grow(12);
	CHECK(ranges.allocate(4) == 8);
	ranges.free(0, 4);
	ranges.free(8, 4);
	CHECK(ranges.allocate(8) == UINT64_MAX);
	ranges.free(4, 4);
	CHECK(ranges.allocate(12) == 0);
}

TEST_CASE("texture mips: sRGB is averaged in linear light, data as it is") {
	Image image{ ImageFormat::RGBA8, 2, 2, std::vector<std::byte>(16, std::byte(0)) };
	for (int i = 0; i < 8; i++) {
		image.texels[i] = std::byte(255); // the upper row is white and solid
	}
	const auto srgb = make_mip_chain(image, true);
	REQUIRE(srgb.size() == 2);
	CHECK(srgb[1][0] == std::byte(188)); // linear 0.5
	CHECK(srgb[1][3] == std::byte(128));
	CHECK(make_mip_chain(image, false)[1][0] == std::byte(128));
	const std::vector<std::byte> square = make_square_copy(image, true, 1);
	CHECK(square[0] == std::byte(188));
	const std::vector<std::byte> larger = make_square_copy(image, true, 4);
	CHECK(larger[0] == std::byte(255));
	CHECK(larger[60] == std::byte(0));
}

TEST_CASE("texture mips: odd and thin images end at one texel, floats become halves") {
	Image image{ ImageFormat::RGBA32F, 5, 1, std::vector<std::byte>(5 * 16) };
	const std::vector<float> values(20, 1e6f);
	std::memcpy(image.texels.data(), values.data(), image.texels.size());
	const auto levels = make_mip_chain(image, false);
	REQUIRE(levels.size() == 3);
	CHECK(levels[0].size() == 40);
	CHECK(levels[2].size() == 8);
	uint16_t half;
	std::memcpy(&half, levels[2].data(), 2);
	CHECK(half == 0x7BFF); // clamped to the largest finite half
}

TEST_CASE("mesh attributes: missing normals and tangents are made") {
	MeshSurface surface;
	surface.positions = { Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(1, 1, 0), Vector3(0, 1, 0) };
	surface.uvs = { Vector2(0, 1), Vector2(1, 1), Vector2(1, 0), Vector2(0, 0) }; // v down, as images
	surface.indices = { 0, 1, 2, 0, 2, 3 };
	const auto attributes = make_vertex_attributes(surface);
	for (const shader::VertexAttributes &vertex : attributes) {
		CHECK(glm::distance(vertex.normal, Vector3(0, 0, 1)) < 1e-6f);
		CHECK(glm::distance(Vector3(vertex.tangent), Vector3(1, 0, 0)) < 1e-6f);
		CHECK(vertex.tangent.w == 1.0f); // cross(normal, tangent) is up in the image
		CHECK(vertex.color == 0xFFFFFFFFu);
	}
	surface.uvs.clear();
	CHECK(std::abs(glm::length(Vector3(make_vertex_attributes(surface)[0].tangent)) - 1.0f) < 1e-6f);
	surface.positions.assign(4, Vector3(0.0f));
	CHECK(glm::length(make_vertex_attributes(surface)[0].normal) == 1.0f);
}

TEST_CASE("scene cull: boxes in, across and out of a camera's frustum") {
	Camera camera;
	camera.fov_degrees = 90.0f;
	camera.far_m = 50.0f;
	const Frustum frustum(camera_projection(camera, 1.0f));
	const auto box = [](const Vector3 &p_center) { return AABB{ p_center - 0.5f, p_center + 0.5f }; };
	CHECK(frustum.intersects(box(Vector3(0, 0, -10))));
	CHECK(frustum.intersects(box(Vector3(10.2f, 0, -10))));
	CHECK(frustum.intersects(box(Vector3(0, -10.2f, -10))));
	CHECK_FALSE(frustum.intersects(box(Vector3(12, 0, -10))));
	CHECK_FALSE(frustum.intersects(box(Vector3(0, 12, -10))));
	CHECK_FALSE(frustum.intersects(box(Vector3(0, 0, 10))));
	CHECK_FALSE(frustum.intersects(box(Vector3(0, 0, -60))));
}

TEST_CASE("scene cull: neighbours of one mesh and material become one draw") {
	SceneDraw draw;
	std::vector<uint32_t> instances;
	DrawListBuilder builder(instances);
	for (uint32_t i = 0; i < 3; i++) {
		draw.instance = i;
		builder.add(draw);
	}
	SceneDraw other = draw;
	other.material = 1;
	builder.add(other);
	SceneDraw mirrored = other; // batches keep pointers to what they draw
	mirrored.mirrored = true;
	builder.add(mirrored);
	REQUIRE(builder.batches.size() == 3);
	CHECK(builder.batches[0].instance_count == 3);
	CHECK(builder.batches[1].first_instance == 3);
	CHECK(instances.size() == 5);
}
