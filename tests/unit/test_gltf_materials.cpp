// SPDX-License-Identifier: MIT
// Materials of extensions.
#include "modules/gltf/gltf_specular_glossiness.h"
#include "tests/unit/gltf_builder.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace lucent;

TEST_CASE("specular-glossiness: what is no metal keeps its colour, a metal takes its specular colour") {
	const MetallicRoughness plastic = to_metallic_roughness(Vector4(0.5f, 0.25f, 0.1f, 1), Vector3(0.04f), 0.75f);
	CHECK(plastic.metallic == doctest::Approx(0.0f).epsilon(1e-3));
	CHECK(plastic.roughness == doctest::Approx(0.25f));
	CHECK(glm::length(plastic.base_color - Vector3(0.5f, 0.25f, 0.1f)) < 1e-3f);
	const MetallicRoughness gold = to_metallic_roughness(Vector4(0, 0, 0, 1), Vector3(1.0f, 0.77f, 0.34f), 1.0f);
	CHECK(gold.metallic == doctest::Approx(1.0f));
	CHECK(gold.roughness == 0.0f);
	CHECK(glm::length(gold.base_color - Vector3(1.0f, 0.77f, 0.34f)) < 1e-3f);
}

TEST_CASE("specular-glossiness: images") {
	const auto image = [](std::initializer_list<int> p_bytes) {
		Image made{ ImageFormat::RGBA8, uint32_t(p_bytes.size() / 4), 1, {} };
		for (const int byte : p_bytes) {
			made.texels.push_back(std::byte(byte));
		}
		return made;
	};
	// Left: a red plastic of gloss 1; right: black with a white specular colour, so a mirror, of gloss 128 / 255.
	const auto diffuse = std::make_shared<const Image>(image({ 255, 0, 0, 255, 0, 0, 0, 64 }));
	const MetallicRoughnessImages made = to_metallic_roughness_images({}, diffuse, image({ 0, 0, 0, 255, 255, 255, 255, 128 }));
	const auto value = [](const Image &p_image, size_t p_byte) { return int(p_image.texels[p_byte]); };
	CHECK(value(made.base_color, 0) == 255);
	CHECK(value(made.base_color, 1) == 0);
	CHECK(value(made.metallic_roughness, 1) == 0);
	CHECK(value(made.metallic_roughness, 2) == 0);
	CHECK(value(made.base_color, 4) == 255);
	CHECK(value(made.base_color, 7) == 64);
	CHECK(value(made.metallic_roughness, 5) == 127);
	CHECK(value(made.metallic_roughness, 6) == 255);
}

TEST_CASE("glTF: specular-glossiness factors; what is approximated is one warning each") {
	const GltfDocument document = test::parse_text(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_materials_pbrSpecularGlossiness","EXT_texture_webp","KHR_texture_basisu"],"materials":[
		{"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.5,0.25,0.1,0.5],"specularFactor":[0,0,0],"glossinessFactor":0.2}}},
		{"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1},"KHR_materials_sheen":{}}},{"extensions":{"KHR_materials_clearcoat":{}}},
		{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],"baseColorTexture":{"index":0}}}],"textures":[{"extensions":{"KHR_texture_basisu":{"source":0}}}],"images":[{"uri":"a.ktx2"}]})")
										  .take();
	REQUIRE(document.materials.size() == 4);
	CHECK(document.materials[0].roughness == doctest::Approx(0.8f));
	CHECK(document.materials[0].metallic == 0.0f);
	CHECK(document.materials[0].base_color.a == 0.5f);
	CHECK(document.materials[3].base_color == Vector4(1, 0, 0, 1));
	CHECK(document.warnings.size() == 3); // clearcoat, sheen, basisu
	CHECK(document.errors.empty());
}
