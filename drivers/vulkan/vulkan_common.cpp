// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_common.h"

namespace lucent {

const char *result_name(VkResult p_result) {
	switch (p_result) {
		case VK_SUCCESS:
			return "success";
		case VK_TIMEOUT:
			return "timeout";
		case VK_ERROR_OUT_OF_HOST_MEMORY:
			return "out of host memory";
		case VK_ERROR_OUT_OF_DEVICE_MEMORY:
			return "out of device memory";
		case VK_ERROR_INITIALIZATION_FAILED:
			return "initialization failed";
		case VK_ERROR_DEVICE_LOST:
			return "device lost";
		case VK_ERROR_LAYER_NOT_PRESENT:
			return "layer not present";
		case VK_ERROR_EXTENSION_NOT_PRESENT:
			return "extension not present";
		case VK_ERROR_FEATURE_NOT_PRESENT:
			return "feature not present";
		case VK_ERROR_INCOMPATIBLE_DRIVER:
			return "incompatible driver";
		default:
			return "unexpected Vulkan result";
	}
}

VkFormat to_vk(Format p_format) {
	switch (p_format) {
		case Format::UNDEFINED:
			return VK_FORMAT_UNDEFINED;
		case Format::R8_UNORM:
			return VK_FORMAT_R8_UNORM;
		case Format::R8_UINT:
			return VK_FORMAT_R8_UINT;
		case Format::RG8_UNORM:
			return VK_FORMAT_R8G8_UNORM;
		case Format::RGBA8_UNORM:
			return VK_FORMAT_R8G8B8A8_UNORM;
		case Format::RGBA8_SRGB:
			return VK_FORMAT_R8G8B8A8_SRGB;
		case Format::R16_UINT:
			return VK_FORMAT_R16_UINT;
		case Format::R16_FLOAT:
			return VK_FORMAT_R16_SFLOAT;
		case Format::RG16_FLOAT:
			return VK_FORMAT_R16G16_SFLOAT;
		case Format::RG16_UNORM:
			return VK_FORMAT_R16G16_UNORM;
		case Format::RGBA16_FLOAT:
			return VK_FORMAT_R16G16B16A16_SFLOAT;
		case Format::R32_UINT:
			return VK_FORMAT_R32_UINT;
		case Format::R32_FLOAT:
			return VK_FORMAT_R32_SFLOAT;
		case Format::RG32_UINT:
			return VK_FORMAT_R32G32_UINT;
		case Format::RG32_FLOAT:
			return VK_FORMAT_R32G32_SFLOAT;
		case Format::RGBA32_UINT:
			return VK_FORMAT_R32G32B32A32_UINT;
		case Format::RGBA32_FLOAT:
			return VK_FORMAT_R32G32B32A32_SFLOAT;
		case Format::RGB10A2_UNORM:
			return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
		case Format::D32_FLOAT:
			return VK_FORMAT_D32_SFLOAT;
	}
	return VK_FORMAT_UNDEFINED;
}

VkImageLayout to_vk(TextureLayout p_layout) {
	constexpr VkImageLayout LAYOUTS[] = {
		VK_IMAGE_LAYOUT_UNDEFINED,
		VK_IMAGE_LAYOUT_GENERAL,
		VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
		VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
		VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
		VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
		VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
		VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
	};
	return LAYOUTS[size_t(p_layout)];
}

VkImageAspectFlags format_aspect(Format p_format) {
	return format_kind(p_format) == FormatKind::DEPTH ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkDescriptorType to_vk(DescriptorKind p_kind) {
	switch (p_kind) {
		case DescriptorKind::SAMPLED_TEXTURE:
			return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
		case DescriptorKind::STORAGE_TEXTURE:
			return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
		case DescriptorKind::STORAGE_BUFFER:
			return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
		case DescriptorKind::UNIFORM_BUFFER:
			return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
		case DescriptorKind::SAMPLER:
			return VK_DESCRIPTOR_TYPE_SAMPLER;
		case DescriptorKind::TEXTURE_WITH_SAMPLER:
			return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
		case DescriptorKind::NONE:
			break;
	}
	return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

VkCompareOp to_vk(CompareOp p_op) {
	constexpr VkCompareOp OPS[] = { VK_COMPARE_OP_NEVER, VK_COMPARE_OP_LESS, VK_COMPARE_OP_EQUAL, VK_COMPARE_OP_LESS_OR_EQUAL,
		VK_COMPARE_OP_GREATER, VK_COMPARE_OP_GREATER_OR_EQUAL, VK_COMPARE_OP_ALWAYS };
	return OPS[size_t(p_op)];
}

VkCullModeFlags to_vk(CullMode p_mode) {
	constexpr VkCullModeFlags MODES[] = { VK_CULL_MODE_NONE, VK_CULL_MODE_FRONT_BIT, VK_CULL_MODE_BACK_BIT };
	return MODES[size_t(p_mode)];
}

VkSamplerAddressMode to_vk(AddressMode p_mode) {
	constexpr VkSamplerAddressMode MODES[] = { VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
		VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER };
	return MODES[size_t(p_mode)];
}

VkAttachmentLoadOp to_vk(LoadOp p_op) {
	constexpr VkAttachmentLoadOp OPS[] = { VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_DONT_CARE };
	return OPS[size_t(p_op)];
}

VkPipelineColorBlendAttachmentState to_vk(BlendMode p_mode) {
	VkPipelineColorBlendAttachmentState state = {
		.blendEnable = p_mode != BlendMode::NONE,
		.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
		.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
		.colorBlendOp = VK_BLEND_OP_ADD,
		.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
		.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
		.alphaBlendOp = VK_BLEND_OP_ADD,
		.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT,
	};
	switch (p_mode) {
		case BlendMode::NONE:
		case BlendMode::MIX:
			break;
		case BlendMode::ADD:
			state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
			state.srcAlphaBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
			state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
			break;
		case BlendMode::SUB:
			state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_REVERSE_SUBTRACT;
			state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
			state.srcAlphaBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
			state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
			break;
		case BlendMode::MUL:
			state.srcColorBlendFactor = VK_BLEND_FACTOR_DST_COLOR;
			state.dstColorBlendFactor = VK_BLEND_FACTOR_ZERO;
			state.srcAlphaBlendFactor = VK_BLEND_FACTOR_DST_ALPHA;
			state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
			break;
		case BlendMode::PREMULTIPLIED:
			state.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
			break;
	}
	return state;
}

StageAccess to_vk(uint32_t p_access) {
	constexpr VkPipelineStageFlags2 GRAPHICS = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
	constexpr VkPipelineStageFlags2 DEPTH = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
	constexpr StageAccess TABLE[] = {
		// by the bits of Access
		{ VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT },
		{ VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT },
		{ VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT },
		{ VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_UNIFORM_READ_BIT },
		{ GRAPHICS, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT },
		{ GRAPHICS, VK_ACCESS_2_SHADER_STORAGE_READ_BIT },
		{ GRAPHICS, VK_ACCESS_2_UNIFORM_READ_BIT },
		{ VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT },
		{ VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT },
		{ VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT },
		{ VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT },
		{ DEPTH, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT },
		{ DEPTH, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT },
		{ VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT },
		{ VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT },
		{ VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT },
	};
	StageAccess result;
	for (uint32_t bit = 0; bit < std::size(TABLE); bit++) {
		if (p_access & (1u << bit)) {
			result.stages |= TABLE[bit].stages;
			result.access |= TABLE[bit].access;
		}
	}
	return result;
}

} // namespace lucent
