// SPDX-License-Identifier: MIT
#include "servers/rendering/device/pass_checks.h"
#include "servers/rendering/device/shader_data.h"
#include "tests/gpu/shaders/test_io.h"

#include <doctest/doctest.h>

namespace lucent {
namespace {

ShaderReflection reflection_of(Shader p_shader) {
	const ShaderData &data = SHADER_DATA[size_t(p_shader)];
	return reflect_shader({ data.spirv, data.word_count }).take();
}

PassBinding declared(uint32_t p_binding, PassBindingKind p_kind) {
	PassBinding binding;
	binding.binding = p_binding;
	binding.kind = p_kind;
	return binding;
}

TEST_CASE("pass checks: set 0") {
	const ShaderReflection add = reflection_of(Shader::TEST_ADD);
	const ShaderReflection *shaders[] = { &add };
	const auto check = [&](std::vector<PassBinding> p_bindings) { return check_set0(p_bindings, shaders); };
	const PassBinding source = declared(TEST_SOURCE, PassBindingKind::READ_BUFFER);
	const PassBinding target = declared(TEST_TARGET, PassBindingKind::WRITE_BUFFER);
	CHECK(check({ target, source }) == "");
	CHECK(check({ source, declared(TEST_TARGET, PassBindingKind::READ_WRITE_BUFFER) }) == "");
	CHECK(check({ source }) == "binding 1, 'Target', a storage buffer, is not declared");
	CHECK(check({ source, target, source }) == "binding 0 is declared twice");
	CHECK(check({ source, target, declared(5, PassBindingKind::SAMPLER) }) == "binding 5 is declared, but no shader of the pass has it");
	CHECK(check({ declared(TEST_SOURCE, PassBindingKind::WRITE_BUFFER), target }) == "binding 0, 'Source', is a storage buffer that is readonly, but declared as write(buffer)");
	CHECK(check({ source, declared(TEST_TARGET, PassBindingKind::READ_BUFFER) }) == "binding 1, 'Target', is a storage buffer that is writable, but declared as read(buffer)");
	CHECK(check({ source, declared(TEST_TARGET, PassBindingKind::UNIFORM_BUFFER) }) != "");
	CHECK(check({ source, declared(TEST_TARGET, PassBindingKind::WRITE_TEXTURE) }) != "");
}

TEST_CASE("pass checks: textures") {
	const ShaderReflection volume = reflection_of(Shader::TEST_VOLUME);
	const ShaderReflection array = reflection_of(Shader::TEST_SAMPLE_ARRAY);
	const ShaderReflection down = reflection_of(Shader::TEST_DOWNSAMPLE);
	TextureDesc desc;
	desc.type = TextureType::TEXTURE_3D;
	desc.format = Format::R32_UINT;
	desc.usage = TEXTURE_STORAGE;
	desc.name = "t";
	CHECK(check_texture(desc, {}, volume.bindings[0]) == "");
	desc.format = Format::RG32_UINT;
	CHECK(check_texture(desc, {}, volume.bindings[0]) == "'target' is r32_uint in the shader, but 't' is rg32_uint");
	desc.format = Format::R32_UINT;
	desc.usage = TEXTURE_SAMPLED;
	CHECK(check_texture(desc, {}, volume.bindings[0]) == "'t' was made without TEXTURE_STORAGE");
	desc.type = TextureType::TEXTURE_2D_ARRAY;
	CHECK(check_texture(desc, {}, volume.bindings[0]) != "");
	CHECK(check_texture(desc, {}, array.bindings[0]) == "'source' and 't' (r32_uint) differ in being unsigned integers");
	desc.format = Format::R32_FLOAT;
	CHECK(check_texture(desc, {}, array.bindings[0]) == "");
	desc.layers = 2;
	CHECK(check_texture(desc, {}, down.bindings[0]) != ""); // a 2D texture needs one layer
	CHECK(check_texture(desc, { {}, TextureView::ALL, 1 }, down.bindings[0]) == "");
	CHECK(check_texture(desc, { {}, TextureView::ALL, 2 }, down.bindings[0]) == "'t' has 1 mips and 2 layers");
	desc.usage = TEXTURE_STORAGE;
	desc.mips = 2;
	CHECK(check_texture(desc, { {}, TextureView::ALL, 1 }, down.bindings[1]) == "'t' has 2 mips: say which one 'target' is");
	CHECK(check_texture(desc, { {}, 1, 1 }, down.bindings[1]) == "");
}

TEST_CASE("pass checks: constants and set 1") {
	const ShaderReflection material = reflection_of(Shader::TEST_MATERIAL_FRAG);
	const ShaderReflection triangle = reflection_of(Shader::TEST_TRIANGLE_VERT);
	const ShaderReflection *both[] = { &triangle, &material };
	const ShaderReflection *neither[] = { &triangle };
	CHECK(check_constants(8, both) == "");
	CHECK(check_constants(12, both) == "the constants are 12 bytes, the shader's block is 8");
	CHECK(check_constants(0, both) != "");
	CHECK(check_constants(0, neither) == "");
	CHECK(check_constants(4, neither) == "4 bytes of constants for shaders without a block");
	const DescriptorKind right[] = { DescriptorKind::TEXTURE_WITH_SAMPLER, DescriptorKind::STORAGE_BUFFER };
	const DescriptorKind wrong[] = { DescriptorKind::TEXTURE_WITH_SAMPLER, DescriptorKind::UNIFORM_BUFFER };
	CHECK(check_set1(right, material) == "");
	CHECK(check_set1(wrong, material) == "set 1, binding 1, 'Tint', is a storage buffer, but the draw's binding set has a uniform buffer");
	CHECK(check_set1({}, material) != "");
	CHECK(check_set1({}, triangle) == "");
}

} // namespace
} // namespace lucent
