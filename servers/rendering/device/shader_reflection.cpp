// SPDX-License-Identifier: MIT
#include "servers/rendering/device/shader_reflection.h"

#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <memory>

namespace lucent {

namespace {

// Owns one parsed module.
struct Parsed {
	spvc_context context = nullptr;
	spvc_compiler compiler = nullptr;
	spvc_resources resources = nullptr;
	Parsed() = default;
	Parsed(const Parsed &) = delete;
	Parsed &operator=(const Parsed &) = delete;
	~Parsed() {
		if (context != nullptr) {
			spvc_context_destroy(context);
		}
	}
	bool parse(std::span<const uint32_t> p_spirv) {
		spvc_parsed_ir ir = nullptr;
		return spvc_context_create(&context) == SPVC_SUCCESS && spvc_context_parse_spirv(context, p_spirv.data(), p_spirv.size(), &ir) == SPVC_SUCCESS &&
				spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler) == SPVC_SUCCESS &&
				spvc_compiler_create_shader_resources(compiler, &resources) == SPVC_SUCCESS;
	}
	Error error() const { return make_error("not usable SPIR-V: {}", context != nullptr ? spvc_context_get_last_error_string(context) : "out of memory"); }
	std::span<const spvc_reflected_resource> list(spvc_resource_type p_type) const {
		const spvc_reflected_resource *items = nullptr;
		size_t count = 0;
		spvc_resources_get_resource_list_for_type(resources, p_type, &items, &count);
		return { items, count };
	}
};

Format storage_format(SpvImageFormat p_format) {
	switch (p_format) {
		case SpvImageFormatR8:
			return Format::R8_UNORM;
		case SpvImageFormatR8ui:
			return Format::R8_UINT;
		case SpvImageFormatRg8:
			return Format::RG8_UNORM;
		case SpvImageFormatRgba8:
			return Format::RGBA8_UNORM;
		case SpvImageFormatR16ui:
			return Format::R16_UINT;
		case SpvImageFormatR16f:
			return Format::R16_FLOAT;
		case SpvImageFormatRg16f:
			return Format::RG16_FLOAT;
		case SpvImageFormatRg16:
			return Format::RG16_UNORM;
		case SpvImageFormatRgba16f:
			return Format::RGBA16_FLOAT;
		case SpvImageFormatR32ui:
			return Format::R32_UINT;
		case SpvImageFormatR32f:
			return Format::R32_FLOAT;
		case SpvImageFormatRg32ui:
			return Format::RG32_UINT;
		case SpvImageFormatRg32f:
			return Format::RG32_FLOAT;
		case SpvImageFormatRgba32ui:
			return Format::RGBA32_UINT;
		case SpvImageFormatRgba32f:
			return Format::RGBA32_FLOAT;
		case SpvImageFormatRgb10A2:
			return Format::RGB10A2_UNORM;
		default:
			return Format::UNDEFINED;
	}
}

Status reflect_image(const Parsed &p_module, spvc_type p_type, ReflectedBinding &r_binding) {
	const bool arrayed = spvc_type_get_image_arrayed(p_type);
	switch (spvc_type_get_image_dimension(p_type)) {
		case SpvDim2D:
			r_binding.shape = arrayed ? ViewShape::D2_ARRAY : ViewShape::D2;
			break;
		case SpvDim3D:
			r_binding.shape = ViewShape::D3;
			break;
		case SpvDimCube:
			r_binding.shape = ViewShape::CUBE;
			break;
		default:
			return make_error("'{}': only 2D, 2D array, 3D and cube images are supported", r_binding.name);
	}
	const spvc_basetype sampled = spvc_type_get_basetype(spvc_compiler_get_type_handle(p_module.compiler, spvc_type_get_image_sampled_type(p_type)));
	r_binding.sampled = sampled == SPVC_BASETYPE_UINT32 ? SampledKind::UINT : (sampled == SPVC_BASETYPE_INT32 ? SampledKind::INT : SampledKind::FLOAT);
	if (r_binding.kind == DescriptorKind::STORAGE_TEXTURE) {
		r_binding.storage_format = storage_format(spvc_type_get_image_storage_format(p_type));
	}
	return Ok();
}

bool block_is_writable(const Parsed &p_module, spvc_variable_id p_id) {
	const SpvDecoration *decorations = nullptr;
	size_t count = 0;
	spvc_compiler_get_buffer_block_decorations(p_module.compiler, p_id, &decorations, &count);
	return std::find(decorations, decorations + count, SpvDecorationNonWritable) == decorations + count;
}

Status reflect_bindings(const Parsed &p_module, ShaderReflection &r_shader) {
	constexpr std::pair<spvc_resource_type, DescriptorKind> KINDS[] = {
		{ SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, DescriptorKind::UNIFORM_BUFFER },
		{ SPVC_RESOURCE_TYPE_STORAGE_BUFFER, DescriptorKind::STORAGE_BUFFER },
		{ SPVC_RESOURCE_TYPE_STORAGE_IMAGE, DescriptorKind::STORAGE_TEXTURE },
		{ SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, DescriptorKind::TEXTURE_WITH_SAMPLER },
		{ SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, DescriptorKind::SAMPLED_TEXTURE },
		{ SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, DescriptorKind::SAMPLER },
	};
	for (const auto &[resource_type, kind] : KINDS) {
		for (const spvc_reflected_resource &resource : p_module.list(resource_type)) {
			ReflectedBinding binding;
			binding.kind = kind;
			binding.name = resource.name;
			binding.set = spvc_compiler_get_decoration(p_module.compiler, resource.id, SpvDecorationDescriptorSet);
			binding.binding = spvc_compiler_get_decoration(p_module.compiler, resource.id, SpvDecorationBinding);
			const spvc_type type = spvc_compiler_get_type_handle(p_module.compiler, resource.type_id);
			if (spvc_type_get_num_array_dimensions(type) != 0) {
				return make_error("'{}': arrays of descriptors are not supported", binding.name);
			}
			if (kind == DescriptorKind::STORAGE_BUFFER) {
				binding.writable = block_is_writable(p_module, resource.id);
			} else if (kind == DescriptorKind::STORAGE_TEXTURE) {
				binding.writable = !spvc_compiler_has_decoration(p_module.compiler, resource.id, SpvDecorationNonWritable);
			}
			if (kind == DescriptorKind::STORAGE_TEXTURE || kind == DescriptorKind::SAMPLED_TEXTURE || kind == DescriptorKind::TEXTURE_WITH_SAMPLER) {
				if (Status status = reflect_image(p_module, type, binding); !status) {
					return status;
				}
			}
			r_shader.bindings.push_back(binding);
		}
	}
	std::sort(r_shader.bindings.begin(), r_shader.bindings.end(), [](const ReflectedBinding &a, const ReflectedBinding &b) {
		return std::pair(a.set, a.binding) < std::pair(b.set, b.binding);
	});
	for (size_t i = 1; i < r_shader.bindings.size(); i++) {
		const ReflectedBinding &a = r_shader.bindings[i - 1], &b = r_shader.bindings[i];
		if (a.set == b.set && a.binding == b.binding) {
			return make_error("'{}' and '{}' share set {}, binding {}", a.name, b.name, a.set, a.binding);
		}
	}
	return Ok();
}

void reflect_work_group(const Parsed &p_module, ShaderReflection &r_shader) {
	spvc_specialization_constant axes[3] = {};
	spvc_compiler_get_work_group_size_specialization_constants(p_module.compiler, &axes[0], &axes[1], &axes[2]);
	for (unsigned i = 0; i < 3; i++) {
		r_shader.local_size[i] = spvc_compiler_get_execution_mode_argument_by_index(p_module.compiler, SpvExecutionModeLocalSize, i);
		if (axes[i].id != 0) {
			r_shader.local_size_constant_id[i] = axes[i].constant_id;
			r_shader.local_size[i] = spvc_constant_get_scalar_u32(spvc_compiler_get_constant_handle(p_module.compiler, axes[i].id), 0, 0);
		}
	}
}

using StructMap = std::multimap<std::string, StructLayout>;

void collect_structs(const Parsed &p_module, spvc_type_id p_type, uint64_t p_stride, StructMap &r_structs) {
	const spvc_type type = spvc_compiler_get_type_handle(p_module.compiler, p_type);
	if (spvc_type_get_basetype(type) != SPVC_BASETYPE_STRUCT) {
		return;
	}
	const spvc_type_id base = spvc_type_get_base_type_id(type);
	const spvc_type base_type = spvc_compiler_get_type_handle(p_module.compiler, base); // without array dimensions
	const unsigned member_count = spvc_type_get_num_member_types(base_type);
	StructLayout layout;
	layout.array_stride_bytes = p_stride;
	for (unsigned i = 0; i < member_count; i++) {
		unsigned offset = 0;
		if (spvc_compiler_type_struct_member_offset(p_module.compiler, base_type, i, &offset) == SPVC_SUCCESS) {
			layout.member_offsets[spvc_compiler_get_member_name(p_module.compiler, base, i)] = offset;
		}
		const spvc_type_id member = spvc_type_get_member_type(base_type, i);
		unsigned stride = 0;
		if (spvc_type_get_num_array_dimensions(spvc_compiler_get_type_handle(p_module.compiler, member)) != 0) {
			spvc_compiler_type_struct_member_array_stride(p_module.compiler, base_type, i, &stride);
		}
		collect_structs(p_module, member, stride, r_structs);
	}
	size_t size = 0;
	spvc_compiler_get_declared_struct_size(p_module.compiler, base_type, &size);
	layout.size_bytes = size;
	r_structs.emplace(spvc_compiler_get_name(p_module.compiler, base), layout);
}

} // namespace

Result<ShaderReflection> reflect_shader(std::span<const uint32_t> p_spirv) {
	Parsed module;
	if (!module.parse(p_spirv)) {
		return module.error();
	}
	ShaderReflection shader;
	switch (spvc_compiler_get_execution_model(module.compiler)) {
		case SpvExecutionModelGLCompute:
			shader.stage = ShaderStage::COMPUTE;
			reflect_work_group(module, shader);
			break;
		case SpvExecutionModelVertex:
			shader.stage = ShaderStage::VERTEX;
			break;
		case SpvExecutionModelFragment:
			shader.stage = ShaderStage::FRAGMENT;
			break;
		default:
			return make_error("only compute, vertex and fragment shaders are supported");
	}
	if (Status status = reflect_bindings(module, shader); !status) {
		return status.error();
	}
	for (const spvc_reflected_resource &block : module.list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
		size_t size = 0;
		spvc_compiler_get_declared_struct_size(module.compiler, spvc_compiler_get_type_handle(module.compiler, block.base_type_id), &size);
		shader.push_constants_size_bytes = uint32_t(size);
	}
	const spvc_specialization_constant *constants = nullptr;
	size_t constant_count = 0;
	spvc_compiler_get_specialization_constants(module.compiler, &constants, &constant_count);
	std::vector<uint32_t> &ids = shader.specialization_ids;
	for (size_t i = 0; i < constant_count; i++) {
		ids.push_back(constants[i].constant_id);
	}
	std::sort(ids.begin(), ids.end()); // glslang repeats those of the group's size
	ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
	return shader;
}

Result<std::multimap<std::string, StructLayout>> reflect_structs(std::span<const uint32_t> p_spirv) {
	Parsed module;
	if (!module.parse(p_spirv)) {
		return module.error();
	}
	StructMap structs;
	for (spvc_resource_type type : { SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, SPVC_RESOURCE_TYPE_STORAGE_BUFFER, SPVC_RESOURCE_TYPE_PUSH_CONSTANT }) {
		for (const spvc_reflected_resource &resource : module.list(type)) {
			collect_structs(module, resource.base_type_id, 0, structs);
		}
	}
	return structs;
}

} // namespace lucent
