// SPDX-License-Identifier: MIT
#include "modules/scene/mesh.h"
#include "modules/scene/register_scene_types.h"
#include "modules/tscn/text_loader.h"

#include <doctest/doctest.h>

#include <fmt/ranges.h>

#include <cstring>

using namespace lucent;

namespace {

template <typename T>
void put(std::vector<uint8_t> &r_bytes, std::initializer_list<T> p_values) {
	for (const T value : p_values) {
		const size_t at = r_bytes.size();
		r_bytes.resize(at + sizeof(T));
		std::memcpy(&r_bytes[at], &value, sizeof(T));
	}
}

// A surface as Godot writes it; the fields are what a test changes.
struct SurfaceText {
	uint64_t format = 0;
	int vertex_count = 3;
	int index_count = 3;
	int primitive = 3;
	std::vector<uint8_t> vertices, attributes, indices;
	std::string more;

	std::string text() const {
		return fmt::format("{{\n\"aabb\": AABB(-1, 2, -3, 2, 0, 4),\n\"attribute_data\": PackedByteArray({}),\n\"format\": {},\n\"index_count\": {},\n"
						   "\"index_data\": PackedByteArray({}),\n\"name\": \"side\",\n\"primitive\": {},\n\"vertex_count\": {},\n\"vertex_data\": PackedByteArray({}){}\n}}",
				fmt::join(attributes, ", "), format, index_count, fmt::join(indices, ", "), primitive, vertex_count, fmt::join(vertices, ", "), more);
	}
};

constexpr uint64_t VERSION_4_2 = uint64_t(1) << 35;
constexpr uint64_t COMPRESSED = uint64_t(1) << 29;
constexpr uint64_t INDEXED = uint64_t(1) << 12;

// (-1, 2, 1), (1, 2, 1), (-1, 2, -3), seen from above clockwise; normals +y, tangents +x.
SurfaceText plain() {
	SurfaceText surface;
	surface.format = VERSION_4_2 | INDEXED | 1 | 2 | 4 | 8 | 16;
	put<float>(surface.vertices, { -1, 2, 1, 1, 2, 1, -1, 2, -3 });
	for (int i = 0; i < 3; i++) {
		put<uint16_t>(surface.vertices, { 32768, 65535, 65535, uint16_t(i == 2 ? 16383 : 49151) }); // the last bitangent is turned round
		put<uint8_t>(surface.attributes, { 255, 0, 51, 255 });
		put<float>(surface.attributes, { float(i), -2.5f });
	}
	put<uint16_t>(surface.indices, { 0, 2, 1 });
	return surface;
}

SurfaceText compressed() {
	SurfaceText surface;
	surface.format = VERSION_4_2 | COMPRESSED | INDEXED | 1 | 2 | 4 | 16 | 64 | (uint64_t(3) << 13); // with 8 bytes of CUSTOM0
	// A quarter turn about +x takes (+x, +z) to (+x, +y).
	put<uint16_t>(surface.vertices, { 0, 0, 65535, 49151, 65535, 0, 65535, 49151, 0, 0, 0, 16383 });
	put<uint16_t>(surface.vertices, { 65535, 32768, 65535, 32768, 65535, 32768 });
	for (const uint16_t u : { uint16_t(32768), uint16_t(49151), uint16_t(65535) }) {
		put<uint16_t>(surface.attributes, { u, 0, 9, 9, 9, 9 });
	}
	put<uint16_t>(surface.indices, { 0, 2, 1 });
	surface.more = ",\n\"uv_scale\": Vector4(4, 5, 0, 0)";
	return surface;
}

Ref<scene::ArrayMesh> load(const std::string &p_surfaces) {
	scene::register_scene_classes();
	const std::string text = "[gd_resource type=\"ArrayMesh\" format=4]\n\n[sub_resource type=\"StandardMaterial3D\" id=\"m\"]\n\n[resource]\n_surfaces = [" + p_surfaces + "]\n";
	Result<Ref<Resource>> resource = load_text_resource(text, "mesh.tres");
	REQUIRE_MESSAGE(resource.ok(), resource.error().message);
	return std::dynamic_pointer_cast<scene::ArrayMesh>(resource.take());
}

bool near(const Vector4 &p_a, const Vector4 &p_b, float p_error = 1e-3f) {
	return glm::length(p_a - p_b) < p_error;
}

void check_triangle(const MeshSurface &p_surface) {
	REQUIRE(p_surface.positions.size() == 3);
	CHECK(p_surface.positions == std::vector<Vector3>{ Vector3(-1, 2, 1), Vector3(1, 2, 1), Vector3(-1, 2, -3) });
	CHECK(p_surface.indices == std::vector<uint32_t>{ 0, 1, 2 }); // counter-clockwise
	REQUIRE(p_surface.normals.size() == 3);
	REQUIRE(p_surface.tangents.size() == 3);
	for (size_t i = 0; i < 3; i++) {
		CHECK(near(Vector4(p_surface.normals[i], 0), Vector4(0, 1, 0, 0)));
		CHECK(near(p_surface.tangents[i], Vector4(1, 0, 0, i == 2 ? -1 : 1)));
	}
}

} // namespace

TEST_CASE("mesh data: plain vertices, of 4.2 and of before") {
	SurfaceText text = plain();
	text.more = ",\n\"material\": SubResource(\"m\")";
	const Ref<scene::ArrayMesh> mesh = load(text.text());
	REQUIRE(mesh->get_surface_count() == 1);
	CHECK(mesh->surface_get_material(0) != nullptr);
	CHECK(mesh->surface_get_name(0) == "side");
	const MeshSurface &surface = *mesh->surface_get_arrays(0);
	check_triangle(surface);
	CHECK(near(surface.colors[1], Vector4(1, 0, 0.2f, 1)));
	CHECK(surface.uvs == std::vector<Vector2>{ Vector2(0, -2.5f), Vector2(1, -2.5f), Vector2(2, -2.5f) });
	CHECK(surface.uv2s.empty());

	std::vector<uint8_t> interleaved;
	for (int i = 0; i < 3; i++) {
		interleaved.insert(interleaved.end(), text.vertices.begin() + 12 * i, text.vertices.begin() + 12 * (i + 1));
		interleaved.insert(interleaved.end(), text.vertices.begin() + 36 + 8 * i, text.vertices.begin() + 36 + 8 * (i + 1));
	}
	text.vertices = interleaved;
	text.format -= VERSION_4_2;
	check_triangle(*load(text.text())->surface_get_arrays(0));
}

TEST_CASE("mesh data: compressed vertices") {
	const Ref<scene::ArrayMesh> mesh = load(compressed().text());
	REQUIRE(mesh->get_surface_count() == 1);
	const MeshSurface &surface = *mesh->surface_get_arrays(0);
	check_triangle(surface);
	CHECK(near(Vector4(surface.uvs[0], surface.uvs[1]), Vector4(0, -2.5f, 1, -2.5f)));
	CHECK(surface.uvs[2] == Vector2(2, -2.5f));
}

TEST_CASE("mesh data: base64, strips, no indices") {
	SurfaceText text;
	text.format = VERSION_4_2 | 1;
	text.index_count = 0;
	text.primitive = 4;
	text.vertex_count = 4;
	put<float>(text.vertices, { 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1 });
	CHECK(load(text.text())->surface_get_arrays(0)->indices == std::vector<uint32_t>{ 0, 2, 1, 1, 2, 3 });
	// Twelve floats: three corners of 1, 2, 3.
	const std::string corner = "AACAPwAAAEAAAEBA";
	const std::string base64 = fmt::format("{{\"format\": {}, \"primitive\": 3, \"vertex_count\": 3, \"vertex_data\": PackedByteArray(\"{}{}{}\")}}", VERSION_4_2 | 1, corner, corner, corner);
	CHECK(load(base64)->surface_get_arrays(0)->positions == std::vector<Vector3>(3, Vector3(1, 2, 3)));
	CHECK(load(base64 + ", " + base64)->get_surface_count() == 2);
}

TEST_CASE("mesh data: bad surfaces are left out with a warning each") {
	std::vector<std::string> messages;
	const LogHandler before = set_log_handler([&](LogLevel, std::string_view p_message) { messages.emplace_back(p_message); });
	const auto refused = [&](const SurfaceText &p_text, const std::string &p_reason) {
		messages.clear();
		CHECK_MESSAGE(load(p_text.text())->get_surface_count() == 0, p_reason);
		REQUIRE_MESSAGE(messages.size() == 1, p_reason);
		CHECK_MESSAGE(messages[0].find("mesh.tres:6: surface 0") != std::string::npos, messages[0]);
		CHECK_MESSAGE(messages[0].find(p_reason) != std::string::npos, messages[0]);
	};
	for (const SurfaceText &good : { plain(), compressed() }) {
		SurfaceText text = good;
		text.vertices.pop_back();
		refused(text, "vertex_data");
		text = good;
		text.attributes.push_back(0);
		refused(text, "attribute_data");
		text = good;
		text.vertex_count = 2'000'000'000;
		refused(text, "vertex_data");
		text.vertex_count = -1;
		refused(text, "vertex_count is -1");
		text = good;
		text.indices[0] = 3;
		refused(text, "index 3 is out of range");
		text.indices.pop_back();
		refused(text, "index_data");
		text = good;
		text.primitive = 1;
		refused(text, "primitive 1");
		text = good;
		text.format |= uint64_t(1) << 25;
		refused(text, "format");
		text.format = 0;
		refused(text, "format");
	}
	SurfaceText text = plain();
	put<float>(text.vertices, { NAN });
	std::copy(text.vertices.end() - 4, text.vertices.end(), text.vertices.begin() + 16);
	text.vertices.resize(text.vertices.size() - 4);
	refused(text, "position 1 is not finite");
	messages.clear();
	CHECK(load("7, null, {}")->get_surface_count() == 0);
	CHECK(messages.size() == 3);
	set_log_handler(before);
}
