// SPDX-License-Identifier: MIT
#include "servers/rendering/device/shader_data.h"
#include "servers/rendering/device/shader_ids.gen.h"
#include "servers/rendering/device/shader_reflection.h"
#include "tests/gpu/shaders/test_io.h"
#include "tests/shader_layout.h"

#include <doctest/doctest.h>

namespace lucent {
namespace {

TEST_CASE("shader reflection: every embedded shader keeps the limits that all devices share") {
	size_t count = 0;
	for (const ShaderData *data = SHADER_DATA; data->spirv != nullptr; data++, count++) {
		CAPTURE(data->source_path);
		const Result<ShaderReflection> reflection = reflect_shader({ data->spirv, data->word_count });
		CAPTURE(reflection.error().message);
		REQUIRE(reflection.ok());
		const ShaderReflection &shader = reflection.value();
		CHECK(shader.push_constants_size_bytes <= 128);
		CHECK(shader.local_size[0] * shader.local_size[1] * shader.local_size[2] <= 256);
		int storage_images = 0;
		for (const ReflectedBinding &binding : shader.bindings) {
			CHECK(binding.set < 4);
			storage_images += binding.kind == DescriptorKind::STORAGE_TEXTURE;
		}
		CHECK(storage_images <= 16);
	}
	CHECK(count == size_t(Shader::COUNT));
}

TEST_CASE("shader reflection: bindings, constants, group size") {
	const ShaderData &data = SHADER_DATA[size_t(Shader::TEST_VOLUME)];
	const ShaderReflection shader = reflect_shader({ data.spirv, data.word_count }).take();
	REQUIRE(shader.bindings.size() == 1);
	CHECK(shader.bindings[0].name == "target");
	CHECK(shader.bindings[0].kind == DescriptorKind::STORAGE_TEXTURE);
	CHECK(shader.bindings[0].writable);
	CHECK(shader.bindings[0].shape == ViewShape::D3);
	CHECK(shader.bindings[0].sampled == SampledKind::UINT);
	CHECK(shader.bindings[0].storage_format == Format::R32_UINT);
	CHECK(shader.local_size == std::array<uint32_t, 3>{ 4, 4, 4 });
	CHECK(shader.push_constants_size_bytes == 0);

	const ShaderData &counted = SHADER_DATA[size_t(Shader::TEST_COUNT)];
	const ShaderReflection specialized = reflect_shader({ counted.spirv, counted.word_count }).take();
	CHECK(specialized.local_size_constant_id[0] == 7);
	CHECK(specialized.specialization_ids == std::vector<uint32_t>{ 7 });
}

TEST_CASE("shader reflection: what is no SPIR-V is an error") {
	const std::vector<uint32_t> words(20, 0xdeadbeefu);
	CHECK_FALSE(reflect_shader(words).ok());
	CHECK_FALSE(reflect_shader({}).ok());
	CHECK_FALSE(reflect_structs(words).ok());
}

TEST_CASE("shader layout: test_io.h") {
	CHECK_SHADER_STRUCT(TestConstants, count, value);
	CHECK_SHADER_STRUCT(TestInner, direction, length);
	CHECK_SHADER_STRUCT(TestStruct, a, b, c, d, e, inner, f, g);
	CHECK_SHADER_STRUCT(TestVertex, position, color);
}

TEST_CASE("shader layout: differences are found") {
	using test::shader_struct_difference;
	CHECK(shader_struct_difference("TestInner", 16, { { "direction", 0 }, { "length", 16 } }).find("length is at byte 12") != std::string::npos);
	CHECK(shader_struct_difference("TestInner", 20, { { "direction", 0 }, { "length", 12 } }).find("16 bytes") != std::string::npos);
	CHECK(shader_struct_difference("TestInner", 16, { { "direction", 0 } }) != "");
	CHECK(shader_struct_difference("TestInner", 16, { { "direction", 0 }, { "length", 12 }, { "extra", 16 } }) != "");
	CHECK(shader_struct_difference("NoSuchStruct", 16, {}) == "no shader uses NoSuchStruct");
}

} // namespace
} // namespace lucent
