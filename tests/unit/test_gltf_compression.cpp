// SPDX-License-Identifier: MIT
#include "tests/unit/gltf_builder.h"

#include <doctest/doctest.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

using namespace lucent;
using lucent::test::GltfBuilder;
using lucent::test::one_primitive;

namespace {

const std::vector<float> SQUARE = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
const std::vector<uint16_t> SQUARE_INDICES = { 0, 1, 2, 0, 2, 3 };

// The square with its corners as positions and 8-bit colours that are red at x = 1.
std::vector<char> draco_square() {
	draco::TriangleSoupMeshBuilder builder;
	builder.Start(2);
	const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
	const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
	for (int face = 0; face < 2; face++) {
		const float *corner[3];
		uint8_t colors[3][4] = {};
		for (int c = 0; c < 3; c++) {
			corner[c] = &SQUARE[size_t(SQUARE_INDICES[size_t(face * 3 + c)]) * 3];
			colors[c][0] = corner[c][0] > 0.5f ? 255 : 0;
			colors[c][3] = 255;
		}
		builder.SetAttributeValuesForFace(position, draco::FaceIndex(uint32_t(face)), corner[0], corner[1], corner[2]);
		builder.SetAttributeValuesForFace(color, draco::FaceIndex(uint32_t(face)), colors[0], colors[1], colors[2]);
	}
	const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
	mesh->attribute(position)->set_unique_id(7);
	mesh->attribute(color)->set_unique_id(9);
	draco::Encoder encoder;
	encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
	draco::EncoderBuffer buffer;
	REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
	return *buffer.buffer();
}

} // namespace

TEST_CASE("glTF: KHR_draco_mesh_compression gives the mesh that was compressed") {
	std::vector<char> data = draco_square();
	const size_t size = data.size();
	data.resize((size + 3) / 4 * 4);
	GltfBuilder builder;
	const int view = builder.add_view(data);
	builder.add(SQUARE, "VEC3", 5126, 4);
	builder.add(std::vector<uint8_t>(16), "VEC4", 5121, 4, ",\"normalized\":true");
	const std::string primitive = fmt::format("\"attributes\":{{\"POSITION\":0,\"COLOR_0\":1}},\"extensions\":{{\"KHR_draco_mesh_compression\":{{\"bufferView\":{},\"attributes\":{{\"POSITION\":7,\"COLOR_0\":9}}}}}}", view);
	const GltfDocument document = builder.parse(one_primitive(primitive, "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],")).take();
	const MeshSurface &surface = document.meshes.at(0).primitives.at(0).surface;
	REQUIRE(surface.indices.size() == 6);
	REQUIRE(surface.colors.size() == surface.positions.size());
	float area = 0.0f;
	for (size_t i = 0; i < 6; i += 3) {
		const Vector3 &a = surface.positions[surface.indices[i]];
		area += 0.5f * glm::cross(surface.positions[surface.indices[i + 1]] - a, surface.positions[surface.indices[i + 2]] - a).z;
	}
	CHECK(area == doctest::Approx(1.0f).epsilon(0.001));
	for (size_t i = 0; i < surface.positions.size(); i++) {
		CHECK(surface.colors[i].x == doctest::Approx(surface.positions[i].x).epsilon(0.001));
		CHECK(surface.colors[i].w == doctest::Approx(1.0f));
	}
	for (size_t cut = 0; cut < size; cut += 3) {
		GltfBuilder broken;
		const int broken_view = broken.add_view(std::vector<char>(data.begin(), data.begin() + ptrdiff_t(cut + 1)));
		broken.add(SQUARE, "VEC3", 5126, 4);
		const std::string json = fmt::format("\"attributes\":{{\"POSITION\":0}},\"extensions\":{{\"KHR_draco_mesh_compression\":{{\"bufferView\":{},\"attributes\":{{\"POSITION\":7}}}}}}", broken_view);
		const Result<GltfDocument> result = broken.parse(one_primitive(json));
		CHECK_MESSAGE(!result.ok(), "cut to " << cut + 1 << " of " << size);
	}
}

TEST_CASE("glTF: EXT_meshopt_compression gives the vertices and indices that were compressed") {
	std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, 12));
	vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), SQUARE.data(), 4, 12));
	const std::vector<unsigned int> wide(SQUARE_INDICES.begin(), SQUARE_INDICES.end());
	std::vector<unsigned char> indices(meshopt_encodeIndexBufferBound(6, 4));
	indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), wide.data(), 6));
	const auto file = [&](size_t p_vertex_bytes, size_t p_index_bytes) {
		std::vector<std::byte> binary;
		for (const std::vector<unsigned char> *part : { &vertices, &indices }) {
			const std::byte *data = reinterpret_cast<const std::byte *>(part->data());
			binary.insert(binary.end(), data, data + part->size());
		}
		const std::string json = fmt::format(R"({{"asset":{{"version":"2.0"}},"extensionsRequired":["EXT_meshopt_compression"],"nodes":[{{"mesh":0}}],
			"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
			"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":4}},{{"bufferView":1,"componentType":5123,"type":"SCALAR","count":6}}],
			"buffers":[{{"byteLength":{0},"uri":"packed.bin"}},{{"byteLength":60,"extensions":{{"EXT_meshopt_compression":{{"fallback":true}}}}}}],
			"bufferViews":[{{"buffer":1,"byteLength":48,"byteStride":12,"extensions":{{"EXT_meshopt_compression":{{"buffer":0,"byteLength":{1},"byteStride":12,"count":4,"mode":"ATTRIBUTES"}}}}}},
			{{"buffer":1,"byteOffset":48,"byteLength":12,"extensions":{{"EXT_meshopt_compression":{{"buffer":0,"byteOffset":{2},"byteLength":{3},"byteStride":2,"count":6,"mode":"TRIANGLES"}}}}}}]}})",
				binary.size(), p_vertex_bytes, vertices.size(), p_index_bytes);
		return parse_gltf(lucent::test::text_bytes(json), "test.gltf", [binary](const std::string &) -> Result<std::vector<std::byte>> { return binary; });
	};
	const GltfDocument document = file(vertices.size(), indices.size()).take();
	const MeshSurface &surface = document.meshes.at(0).primitives.at(0).surface;
	REQUIRE(surface.indices.size() == 6);
	float area = 0.0f;
	for (size_t i = 0; i < 6; i += 3) {
		const Vector3 &a = surface.positions[surface.indices[i]];
		area += 0.5f * glm::cross(surface.positions[surface.indices[i + 1]] - a, surface.positions[surface.indices[i + 2]] - a).z;
	}
	CHECK(area == doctest::Approx(1.0f));
	CHECK(!file(vertices.size() - 1, indices.size()).ok());
	CHECK(!file(vertices.size(), indices.size() - 1).ok());
}
