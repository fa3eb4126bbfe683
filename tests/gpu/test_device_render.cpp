// SPDX-License-Identifier: MIT
#include "tests/gpu/gpu_fixture.h"
#include "tests/gpu/shaders/test_io.h"

#include <doctest/doctest.h>

namespace lucent {
namespace {

using shader::TestVertex;
using test::GpuFixture;

constexpr uint32_t SIZE = 8;
constexpr uint32_t RED = 0xff0000ffu, GREEN = 0xff00ff00u, BLUE = 0xffff0000u, BLACK = 0xff000000u;

// Two triangles over the whole target, counter-clockwise as seen on the screen.
std::vector<TestVertex> full_screen(float p_depth, Vector4 p_color) {
	const Vector2 corners[] = { { -1, 1 }, { 1, 1 }, { 1, -1 }, { -1, 1 }, { 1, -1 }, { -1, -1 } }; // y down
	std::vector<TestVertex> vertices;
	for (const Vector2 &corner : corners) {
		vertices.push_back({ Vector4(corner, p_depth, 1.0f), p_color });
	}
	return vertices;
}

std::vector<TestVertex> operator+(std::vector<TestVertex> p_first, const std::vector<TestVertex> &p_second) {
	p_first.insert(p_first.end(), p_second.begin(), p_second.end());
	return p_first;
}

DrawCommand triangles(uint32_t p_first, uint32_t p_count) {
	DrawCommand command;
	command.state.vertex_shader = Shader::TEST_TRIANGLE_VERT;
	command.state.fragment_shader = Shader::TEST_TRIANGLE_FRAG;
	command.first_index = p_first;
	command.index_count = p_count;
	return command;
}

TEST_SUITE_BEGIN("gpu");

TEST_CASE_FIXTURE(GpuFixture, "render: depth is tested reversed, and nearer triangles win in any order") {
	const OwnedTexture color = texture("color", Format::RGBA8_UNORM, SIZE, SIZE, TEXTURE_COLOR_TARGET);
	const OwnedTexture depth = texture("depth", Format::D32_FLOAT, SIZE, SIZE, TEXTURE_DEPTH_TARGET | TEXTURE_SAMPLED);
	const OwnedBuffer vertices = buffer("vertices", full_screen(0.5f, { 1, 0, 0, 1 }) + full_screen(0.75f, { 0, 1, 0, 1 }) + full_screen(0.25f, { 0, 0, 1, 1 }));
	const DrawCommand draws[] = { triangles(0, 6), triangles(6, 6), triangles(12, 6) };
	frame([&](PassRecorder &r_recorder) {
		r_recorder.render("draw").color(0, { color }, LoadOp::CLEAR).depth({ depth }, LoadOp::CLEAR).read(TEST_SOURCE, vertices).draw(draws);
	});
	CHECK(texels<uint32_t>(color) == std::vector<uint32_t>(SIZE * SIZE, GREEN));
	CHECK(texels<float>(depth) == std::vector<float>(SIZE * SIZE, 0.75f));
}

TEST_CASE_FIXTURE(GpuFixture, "render: front faces are counter-clockwise on the screen") {
	const OwnedTexture color = texture("color", Format::RGBA8_UNORM, SIZE, SIZE, TEXTURE_COLOR_TARGET);
	const OwnedBuffer vertices = buffer("vertices", full_screen(0.5f, { 1, 0, 0, 1 }));
	const struct {
		CullMode cull;
		bool clockwise;
		bool visible;
	} cases[] = { { CullMode::NONE, false, true }, { CullMode::BACK, false, true }, { CullMode::FRONT, false, false }, { CullMode::BACK, true, false }, { CullMode::FRONT, true, true } };
	for (const auto &c : cases) {
		DrawCommand draw = triangles(0, 6);
		draw.state.cull = c.cull;
		draw.state.front_face_clockwise = c.clockwise;
		frame([&](PassRecorder &r_recorder) {
			r_recorder.render("draw").color(0, { color }, LoadOp::CLEAR, Vector4(0, 0, 0, 1)).read(TEST_SOURCE, vertices).draw({ &draw, 1 });
		});
		CHECK(texels<uint32_t>(color)[0] == (c.visible ? RED : BLACK));
	}
}

TEST_CASE_FIXTURE(GpuFixture, "render: viewport, indices, blending and read-only depth") {
	const OwnedTexture color = texture("color", Format::RGBA8_UNORM, SIZE, SIZE, TEXTURE_COLOR_TARGET);
	const OwnedTexture depth = texture("depth", Format::D32_FLOAT, SIZE, SIZE, TEXTURE_DEPTH_TARGET);
	const OwnedBuffer vertices = buffer("vertices", full_screen(0.5f, { 1, 0, 0, 1 }) + full_screen(0.75f, { 0, 1, 0, 0.5f }));
	const OwnedBuffer indices = buffer("indices", std::vector<uint32_t>{ 9, 0, 1, 2, 3, 4, 5 }, BUFFER_INDEX);
	const DrawCommand opaque = triangles(1, 6);
	DrawCommand blended = triangles(1, 6);
	blended.vertex_offset = 6;
	blended.state.blend = BlendMode::MIX;
	blended.state.depth_write = false;
	frame([&](PassRecorder &r_recorder) {
		r_recorder.render("opaque").color(0, { color }, LoadOp::CLEAR, Vector4(0, 0, 0, 1)).depth({ depth }, LoadOp::CLEAR).read(TEST_SOURCE, vertices).indices(indices).draw({ &opaque, 1 });
		r_recorder.render("blended").color(0, { color }, LoadOp::LOAD).depth_read_only({ depth }).read(TEST_SOURCE, vertices).indices(indices).viewport(2, 0, SIZE - 2, SIZE).draw({ &blended, 1 });
	});
	const std::vector<uint32_t> image = texels<uint32_t>(color);
	CHECK(image[1] == RED);
	CHECK((image[2] & 0xffu) == doctest::Approx(128).epsilon(0.01));
	CHECK((image[2] >> 8 & 0xffu) == doctest::Approx(128).epsilon(0.01));
	CHECK(texels<float>(depth)[5] == 0.5f);
}

TEST_CASE_FIXTURE(GpuFixture, "render: layers of an atlas are targets one after another, then one array") {
	TextureDesc desc;
	desc.type = TextureType::TEXTURE_2D_ARRAY;
	desc.width = desc.height = SIZE;
	desc.layers = 3;
	desc.usage = TEXTURE_COLOR_TARGET | TEXTURE_SAMPLED;
	const OwnedTexture atlas = device().create_texture(desc);
	const OwnedBuffer vertices = buffer("vertices", full_screen(0.5f, { 1, 0, 0, 1 }));
	const OwnedBuffer result = buffer("result", 48);
	const DrawCommand draw = triangles(0, 6);
	for (int repeat = 0; repeat < 2; repeat++) {
		frame([&](PassRecorder &r_recorder) {
			r_recorder.render("layer 0").color(0, { atlas, 0, 0 }, LoadOp::CLEAR, Vector4(0, 0, 1, 1)).draw({});
			r_recorder.render("layer 2").color(0, { atlas, 0, 2 }, LoadOp::LOAD).read(TEST_SOURCE, vertices).draw({ &draw, 1 });
			r_recorder.compute("sample", Shader::TEST_SAMPLE_ARRAY).read(TEST_SOURCE, atlas).sampler(TEST_SAMPLER, device().sampler({})).write(TEST_TARGET, result).dispatch_threads(3);
		});
	}
	CHECK(texels<uint32_t>(atlas, 0, 0) == std::vector<uint32_t>(SIZE * SIZE, BLUE));
	const std::vector<Vector4> sampled = device().read_back_buffer<Vector4>(result);
	CHECK(sampled[0] == Vector4(0, 0, 1, 1));
	CHECK(sampled[1] == Vector4(0, 0, 0, 0));
	CHECK(sampled[2] == Vector4(1, 0, 0, 1));
}

TEST_CASE_FIXTURE(GpuFixture, "render: draws with binding sets and constants, over a texture that a pass has just made") {
	const OwnedTexture color = texture("color", Format::RGBA16_FLOAT, SIZE, SIZE, TEXTURE_COLOR_TARGET);
	const OwnedTexture made = texture("made", Format::RGBA32_FLOAT, 1, 1, TEXTURE_COLOR_TARGET | TEXTURE_SAMPLED);
	const OwnedTexture white = texture("white", Format::RGBA8_SRGB, 1, 1, TEXTURE_SAMPLED);
	device().upload_texture(white, 0, 0, std::as_bytes(std::span(&RED, 1)));
	const OwnedBuffer tints[2] = { buffer("tint", std::vector<float>{ 1, 1, 1, 1 }), buffer("tint", std::vector<float>{ 2, 1, 1, 1 }) };
	const OwnedBuffer vertices = buffer("vertices", full_screen(0.5f, Vector4(1.0f)));
	std::vector<OwnedBindingSet> sets;
	std::vector<DrawCommand> draws;
	for (uint32_t i = 0; i < 2; i++) {
		const SetBinding bindings[] = { { .binding = 1, .buffer = tints[i] }, { .binding = 0, .texture = white, .sampler = device().sampler({}) } };
		sets.push_back(device().create_binding_set(bindings, "material"));
		DrawCommand draw = triangles(0, 6);
		draw.state.fragment_shader = Shader::TEST_MATERIAL_FRAG;
		draw.state.blend = BlendMode::ADD;
		draw.material = sets.back();
		draw.set_constants(shader::TestConstants{ .count = 0, .value = i + 1 });
		draws.push_back(draw);
	}
	frame([&](PassRecorder &r_recorder) {
		r_recorder.render("make").color(0, { made }, LoadOp::CLEAR, Vector4(0.25f, 1, 1, 1)).draw({});
		r_recorder.render("materials").color(0, { color }, LoadOp::CLEAR).read(TEST_SOURCE, vertices).read(TEST_TARGET, made).draw(draws);
	});
	CHECK(texels<uint16_t>(color)[0] == 0x4080); // red times alpha: 1/4 * 1 + (2 * 2 * 1/4) * 2 = 2.25
	CHECK(texels<uint16_t>(color)[1] == 0);
}

TEST_SUITE_END();

} // namespace
} // namespace lucent
