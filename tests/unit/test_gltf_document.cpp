// SPDX-License-Identifier: MIT
#include "tests/unit/gltf_builder.h"

#include <doctest/doctest.h>

using namespace lucent;
using lucent::test::GltfBuilder;
using lucent::test::one_primitive;
using lucent::test::parse_text;

namespace {

// Four corners of a unit square in the xy plane, counter-clockwise from the origin.
const std::vector<float> SQUARE = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
// The same, in strip order.
const std::vector<float> SQUARE_STRIP = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 };

const MeshSurface &only_surface(const GltfDocument &p_document) {
	REQUIRE(p_document.meshes.size() == 1);
	REQUIRE(p_document.meshes[0].primitives.size() == 1);
	return p_document.meshes[0].primitives[0].surface;
}

// Sum of the triangles' areas along z: 1 for a whole square that faces +z everywhere.
float signed_area(const MeshSurface &p_surface) {
	float area = 0.0f;
	for (size_t i = 0; i < p_surface.indices.size(); i += 3) {
		const Vector3 &a = p_surface.positions[p_surface.indices[i]];
		area += 0.5f * glm::cross(p_surface.positions[p_surface.indices[i + 1]] - a, p_surface.positions[p_surface.indices[i + 2]] - a).z;
	}
	return area;
}

} // namespace

TEST_CASE("glTF: triangles, strips and fans, indexed or not, cover the square with its winding") {
	struct Case {
		const std::vector<float> &positions;
		std::vector<uint16_t> indices;
		int mode;
	};
	const Case cases[] = {
		{ SQUARE, { 0, 1, 2, 0, 2, 3 }, 4 },
		{ SQUARE_STRIP, {}, 5 },
		{ SQUARE, { 0, 1, 3, 2 }, 5 },
		{ SQUARE, { 0, 0, 0, 1, 3, 2 }, 5 }, // with a joint
		{ SQUARE, {}, 6 },
		{ SQUARE, { 1, 2, 3, 0 }, 6 },
	};
	for (const Case &c : cases) {
		GltfBuilder builder;
		const int position = builder.add(c.positions, "VEC3", 5126, 4);
		std::string primitive = fmt::format("\"attributes\":{{\"POSITION\":{}}},\"mode\":{}", position, c.mode);
		if (!c.indices.empty()) {
			primitive += fmt::format(",\"indices\":{}", builder.add(c.indices, "SCALAR", 5123, c.indices.size()));
		}
		const GltfDocument document = builder.parse(one_primitive(primitive)).take();
		const MeshSurface &surface = only_surface(document);
		CHECK(surface.indices.size() == 6);
		CHECK(signed_area(surface) == doctest::Approx(1.0f));
		REQUIRE(surface.normals.size() == surface.positions.size());
		CHECK(surface.normals[0].z == doctest::Approx(1.0f));
		CHECK(document.warnings.empty());
	}
}

TEST_CASE("glTF: points and lines are left out with one warning") {
	for (int mode = 0; mode < 4; mode++) {
		GltfBuilder builder;
		builder.add(SQUARE, "VEC3", 5126, 4);
		const GltfDocument document = builder.parse(one_primitive(fmt::format("\"attributes\":{{\"POSITION\":0}},\"mode\":{}", mode))).take();
		CHECK(document.meshes[0].primitives.empty());
		CHECK(document.warnings == std::vector<std::string>{ "test.glb: points and lines are left out" });
	}
}

TEST_CASE("glTF: a primitive keeps only the vertices that it uses, in order") {
	GltfBuilder builder;
	builder.add(SQUARE, "VEC3", 5126, 4);
	builder.add(std::vector<float>{ 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 0 }, "VEC3", 5126, 4);
	builder.add(std::vector<uint8_t>{ 3, 1, 2, 0 }, "SCALAR", 5121, 3);
	const GltfDocument document = builder.parse(one_primitive("\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2")).take();
	const MeshSurface &surface = only_surface(document);
	REQUIRE(surface.positions.size() == 3);
	CHECK(surface.indices == std::vector<uint32_t>{ 2, 0, 1 });
	CHECK(surface.positions[0] == Vector3(1, 0, 0));
	CHECK(surface.positions[2] == Vector3(0, 1, 0));
	CHECK(surface.normals[0] == Vector3(0, 0, 1)); // made a unit vector
	CHECK(surface.normals[2].z == doctest::Approx(std::abs(surface.normals[2].z))); // zero in the file: from the triangle
	CHECK(glm::length(surface.normals[2]) == doctest::Approx(1.0f));
}

TEST_CASE("glTF: sparse accessors replace elements, with and without a buffer view below") {
	GltfBuilder builder;
	const int indices = builder.add_view(std::vector<uint16_t>{ 1, 2 });
	const int values = builder.add_view(std::vector<float>{ 5, 0, 0, 5, 5, 0 });
	const std::string sparse = fmt::format(",\"sparse\":{{\"count\":2,\"indices\":{{\"bufferView\":{},\"componentType\":5123}},\"values\":{{\"bufferView\":{}}}}}", indices, values);
	builder.add(SQUARE, "VEC3", 5126, 4, sparse);
	const GltfDocument document = builder.parse(one_primitive("\"attributes\":{\"POSITION\":0},\"mode\":6")).take();
	CHECK(signed_area(only_surface(document)) == doctest::Approx(15.0f)); // 0,0 5,0 5,5 0,1

	const std::string json = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
		"buffers":[{"byteLength":15,"uri":"data:application/octet-stream;base64,AQIDAAAAAAAAgD8AAAAA"}],
		"bufferViews":[{"buffer":0,"byteLength":2},{"buffer":0,"byteOffset":3,"byteLength":12}],
		"accessors":[{"componentType":5126,"type":"VEC3","count":3,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":1}}}]})";
	const GltfDocument zeros = parse_text(json).take();
	const MeshSurface &surface = only_surface(zeros);
	CHECK(surface.positions[0] == Vector3(0.0f));
	CHECK(surface.positions[1] == Vector3(0, 1, 0));
	CHECK(surface.positions[2] == Vector3(0.0f));
}

TEST_CASE("glTF: normalised integers, strides and RGB colours are decoded") {
	GltfBuilder builder;
	builder.add(SQUARE, "VEC3", 5126, 4);
	builder.add(std::vector<uint8_t>{ 255, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0 }, "VEC3", 5121, 4, ",\"normalized\":true");
	builder.add(std::vector<uint16_t>{ 65535, 0, 0, 32768, 0, 0, 0, 0 }, "VEC2", 5123, 4, ",\"normalized\":true");
	builder.add(std::vector<int8_t>{ 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, -128, 0, 0 }, "VEC3", 5120, 4, ",\"normalized\":true");
	std::vector<std::byte> file = builder.glb(one_primitive("\"attributes\":{\"POSITION\":0,\"COLOR_0\":1,\"TEXCOORD_1\":2,\"NORMAL\":3},\"mode\":6"));
	// The fourth view gets a stride of 4.
	std::string text(reinterpret_cast<const char *>(file.data()), file.size());
	const std::string from = "\"byteLength\":16}]", to = "\"byteLength\":16,\"byteStride\":4}]";
	const size_t at = text.find(from);
	REQUIRE(at != std::string::npos);
	text.replace(at, from.size(), to);
	const size_t grown = to.size() - from.size();
	uint32_t lengths[2] = { uint32_t(text.size()), 0 };
	std::memcpy(&lengths[1], text.data() + 12, 4);
	lengths[1] += uint32_t(grown);
	std::memcpy(text.data() + 8, lengths, 8);
	std::memcpy(text.data() + 12, &lengths[1], 4);
	std::memcpy(text.data() + 16, "JSON", 4);
	const GltfDocument document = parse_gltf(lucent::test::text_bytes(text), "test.glb", nullptr).take();
	const MeshSurface &surface = only_surface(document);
	CHECK(surface.colors[0].x == doctest::Approx(1.0f));
	CHECK(surface.colors[0].z == doctest::Approx(0.2f));
	CHECK(surface.colors[0].w == 1.0f);
	CHECK(surface.uv2s[0].x == 1.0f);
	CHECK(surface.uv2s[1].y == doctest::Approx(32768.0f / 65535.0f));
	CHECK(surface.uvs.empty());
	CHECK(surface.normals[0].z == doctest::Approx(1.0f));
	CHECK(surface.normals[3].y == doctest::Approx(-1.0f));
}

TEST_CASE("glTF: tangents follow u, the bitangent is up in the picture, mirrored halves are split") {
	GltfBuilder builder;
	builder.add(std::vector<float>{ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 0, 0, -1, 1, 0 }, "VEC3", 5126, 6);
	builder.add(std::vector<float>{ 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 }, "VEC3", 5126, 6);
	// v runs down from the top edge; the left half repeats the right one mirrored.
	builder.add(std::vector<float>{ 0, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 0 }, "VEC2", 5126, 6);
	builder.add(std::vector<uint16_t>{ 0, 1, 2, 0, 2, 3, 4, 0, 3, 4, 3, 5 }, "SCALAR", 5123, 12);
	const std::string png = "\"images\":[{\"uri\":\"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mNoaPgPAAODAgA+WCglAAAAAElFTkSuQmCC\"}],\"textures\":[{\"source\":0}],";
	const GltfDocument document = builder.parse(one_primitive("\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2},\"indices\":3,\"material\":0", png + "\"materials\":[{\"normalTexture\":{\"index\":0,\"scale\":0.5}}],")).take();
	CHECK(document.warnings.empty());
	CHECK(document.materials[0].normal_scale == 0.5f);
	const MeshSurface &surface = only_surface(document);
	REQUIRE(surface.tangents.size() == 8); // the two vertices on the seam are there twice
	for (size_t i = 0; i < surface.indices.size(); i++) {
		const uint32_t index = surface.indices[i];
		const bool left = i >= 6;
		const Vector3 tangent(surface.tangents[index]);
		CHECK(tangent.x == doctest::Approx(left ? -1.0f : 1.0f));
		CHECK((glm::cross(surface.normals[index], tangent) * surface.tangents[index].w).y == doctest::Approx(1.0f));
	}
}

TEST_CASE("glTF: materials and their extensions become Godot's terms") {
	const GltfDocument document = parse_text(R"({"asset":{"version":"2.0"},"materials":[
		{"name":"a","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.25,"roughnessFactor":0.75},"doubleSided":true,
		 "emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8},"KHR_materials_specular":{"specularFactor":0}}},
		{"alphaMode":"MASK","alphaCutoff":0.3,"extensions":{"KHR_materials_unlit":{},"KHR_materials_specular":{"specularFactor":0.25,"specularColorFactor":[1,0,0]}}},
		{"alphaMode":"BLEND","extensions":{"KHR_materials_ior":{"ior":2}}},
		{"extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}}]})")
										  .take();
	const std::vector<GltfMaterial> &m = document.materials;
	REQUIRE(m.size() == 4);
	CHECK(m[0].base_color == Vector4(0.1f, 0.2f, 0.3f, 0.4f));
	CHECK(m[0].metallic == 0.25f);
	CHECK(m[0].roughness == 0.75f);
	CHECK(m[0].double_sided);
	CHECK(m[0].emission == Vector3(8, 4, 0));
	CHECK(m[0].specular == 0.0f);
	CHECK(m[0].transparency == TransparencyMode::OPAQUE);
	CHECK(m[1].transparency == TransparencyMode::ALPHA_SCISSOR);
	CHECK(m[1].alpha_cutoff == 0.3f);
	CHECK(m[1].unlit);
	CHECK(m[1].specular == doctest::Approx(0.25f)); // f0 = 0.01
	CHECK(m[1].specular_tint == Vector3(1, 0, 0));
	CHECK(m[2].transparency == TransparencyMode::ALPHA_BLEND);
	CHECK(m[2].specular == doctest::Approx(0.8333333f)); // f0 = 1/9
	CHECK(m[3].specular == doctest::Approx(0.5f));
	CHECK(m[3].base_color.a == doctest::Approx(0.1f));
	CHECK(m[3].metallic == 1.0f);
	CHECK(document.warnings == std::vector<std::string>{ "test.gltf: KHR_materials_transmission is shown as alpha" });
}

TEST_CASE("glTF: texture settings: sampler, coordinate set and transform; an unreadable image is a warning") {
	GltfBuilder builder;
	const std::string json = R"("images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mNoaPgPAAODAgA+WCglAAAAAElFTkSuQmCC"},{"uri":"none.png"},{"uri":"data:image/png;base64,"}],
		"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728,"minFilter":9728}],
		"textures":[{"source":0,"sampler":0},{"source":1},{"source":2}],
		"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0.25],"rotation":1.5,"scale":[2,3],"texCoord":1}}}},
			"emissiveTexture":{"index":1},"occlusionTexture":{"index":2,"strength":0.5}}],)";
	const GltfDocument document = parse_text("{" + json + "\"asset\":{\"version\":\"2.0\"}}").take();
	const GltfTextureRef &texture = document.materials[0].base_color_texture;
	REQUIRE(texture.image == 0);
	CHECK(document.images[0].image->width == 1);
	CHECK(texture.uv_set == 1);
	CHECK(texture.wrap_u == TextureWrap::CLAMP);
	CHECK(texture.wrap_v == TextureWrap::MIRRORED_REPEAT);
	CHECK(texture.filter == TextureFilter::NEAREST);
	CHECK(texture.uv_offset == Vector2(0.5f, 0.25f));
	CHECK(texture.uv_scale == Vector2(2.0f, 3.0f));
	CHECK(texture.uv_rotation == 1.5f);
	CHECK(document.materials[0].emission_texture.image == -1);
	CHECK(document.materials[0].occlusion_texture.image == -1);
	CHECK(document.materials[0].occlusion_strength == 0.5f);
	CHECK(document.warnings.empty());
	REQUIRE(document.errors.size() == 2);
	CHECK(document.errors[1].find("none.png") != std::string::npos);
	CHECK(document.errors[0].find("the file is empty") != std::string::npos);
}

TEST_CASE("glTF: lights in candela and lux become Godot's energy, cameras keep their lens") {
	const GltfDocument document = parse_text(R"({"asset":{"version":"2.0"},"extensions":{"KHR_lights_punctual":{"lights":[
		{"type":"directional","intensity":3.14159265},{"type":"point","intensity":6.2831853,"color":[1,0.5,0],"name":"bulb"},
		{"type":"spot","range":7,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.6}}]}},
		"cameras":[{"type":"perspective","perspective":{"yfov":1.0,"znear":0.1,"zfar":50}},{"type":"orthographic","orthographic":{"xmag":2,"ymag":3,"znear":0,"zfar":9}}],
		"nodes":[{"camera":1,"extensions":{"KHR_lights_punctual":{"light":2}}}]})")
										  .take();
	REQUIRE(document.lights.size() == 3);
	CHECK(document.lights[0].light.type == LightType::DIRECTIONAL);
	CHECK(document.lights[0].light.energy == doctest::Approx(1.0f));
	const Light &point = document.lights[1].light;
	CHECK(point.type == LightType::OMNI);
	CHECK(point.energy == doctest::Approx(2.0f));
	CHECK(point.color == Vector3(1.0f, 0.5f, 0.0f));
	CHECK(point.attenuation == 2.0f);
	CHECK(point.range_m == 4096.0f);
	const Light &spot = document.lights[2].light;
	CHECK(spot.range_m == 7.0f);
	CHECK(spot.spot_angle_degrees == doctest::Approx(34.37747f));
	// Both cones are at one half where glTF's t^2 is.
	const float cos_half = std::cos(0.6f) + std::sqrt(0.5f) * (std::cos(0.2f) - std::cos(0.6f));
	CHECK(1.0f - std::pow((1.0f - cos_half) / (1.0f - std::cos(0.6f)), spot.spot_exponent()) == doctest::Approx(0.5f));
	CHECK(document.cameras[0].camera.fov_degrees == doctest::Approx(57.29578f));
	CHECK(document.cameras[0].camera.far_m == 50.0f);
	CHECK(document.cameras[1].camera.size_m == 6.0f);
	CHECK(document.nodes[0].camera == 1);
	CHECK(document.nodes[0].light == 2);
}

TEST_CASE("glTF: nodes keep names and transforms; scenes name their roots") {
	const GltfDocument document = parse_text(R"({"asset":{"version":"2.0"},"scene":1,"scenes":[{"name":"first","nodes":[2]},{"name":"second","nodes":[0],"extras":{"environment":{"type":"sunsky"}}}],
		"nodes":[{"name":"root","children":[1],"translation":[1,2,3],"scale":[2,2,2]},{"name":"child","rotation":[0,0.70710678,0,0.70710678]},
		{"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 7,8,9,1]}]})")
										  .take();
	CHECK(document.default_scene == 1);
	CHECK(document.scenes[1].nodes == std::vector<int32_t>{ 0 });
	CHECK(document.scenes[1].environment_json == "{\"type\":\"sunsky\"}");
	CHECK(document.nodes[1].parent == 0);
	CHECK(document.nodes[1].name == "child");
	CHECK(document.nodes[0].transform.xform(Vector3(1, 0, 0)) == Vector3(3, 2, 3));
	CHECK(document.nodes[1].transform.xform(Vector3(0, 0, 1)).x == doctest::Approx(1.0f));
	CHECK(document.nodes[2].transform.xform(Vector3(1, 0, 0)) == Vector3(7, 9, 9));
	const GltfDocument without = parse_text(R"({"asset":{"version":"2.0"},"nodes":[{},{"children":[0]}]})").take();
	REQUIRE(without.scenes.size() == 1);
	CHECK(without.scenes[0].nodes == std::vector<int32_t>{ 1 });
}

TEST_CASE("glTF: morph targets and skins stand in the file's pose") {
	GltfBuilder builder;
	builder.add(std::vector<float>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, "VEC3", 5126, 3);
	builder.add(std::vector<float>{ 0, 0, 4, 0, 0, 4, 0, 0, 4 }, "VEC3", 5126, 3);
	builder.add(std::vector<uint8_t>{ 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0 }, "VEC4", 5121, 3);
	builder.add(std::vector<float>{ 1, 0, 0, 0, 2, 0, 0, 0, 0.5f, 0.5f, 0, 0 }, "VEC4", 5126, 3);
	const std::string primitive = "\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":2,\"WEIGHTS_0\":3},\"targets\":[{\"POSITION\":1}]}]";
	const GltfDocument document = builder.parse("\"meshes\":[{" + primitive + ",\"weights\":[0.5]}],\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"weights\":[0.25]},"
																			  "{\"mesh\":0,\"skin\":0,\"translation\":[100,0,0]},{\"translation\":[0,10,0]},{\"translation\":[0,0,20]}],\"skins\":[{\"joints\":[3,4]}],")
										  .take();
	const auto position = [&](size_t p_node, size_t p_vertex) {
		return document.meshes[size_t(document.nodes[p_node].mesh)].primitives.at(0).surface.positions.at(p_vertex);
	};
	CHECK(position(0, 1) == Vector3(1, 0, 2));
	CHECK(position(1, 1) == Vector3(1, 0, 1));
	// In its skeleton's space, here the scene's; a skin ignores its node's place. Joint 1 moves by 20 along z, the third vertex is between.
	CHECK(position(2, 0) == Vector3(0, 0, 22));
	CHECK(position(2, 1) == Vector3(1, 0, 22));
	CHECK(position(2, 2) == Vector3(0, 6, 12));
}
