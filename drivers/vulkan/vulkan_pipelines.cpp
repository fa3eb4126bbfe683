// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_driver_impl.h"

namespace lucent {

DriverShader VulkanDriver::create_shader(std::span<const uint32_t> p_spirv, const std::string &p_name) {
	const VkShaderModuleCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
		.codeSize = p_spirv.size_bytes(),
		.pCode = p_spirv.data(),
	};
	VkShaderModule module = VK_NULL_HANDLE;
	const VkResult result = vkCreateShaderModule(context.device, &create_info, nullptr, &module);
	if (result != VK_SUCCESS) {
		log_error("shader '{}': {}", p_name, result_name(result));
		return {};
	}
	context.set_name(VK_OBJECT_TYPE_SHADER_MODULE, uint64_t(module), p_name);
	return { uint64_t(module) };
}

void VulkanDriver::destroy(DriverShader p_shader) {
	vkDestroyShaderModule(context.device, VkShaderModule(p_shader.value), nullptr);
}

// Every layout has the same push constants, so that layouts with equal first sets are compatible for them.
VkPipelineLayout VulkanDriver::pipeline_layout(DriverSetLayout p_set0, DriverSetLayout p_set1) {
	VkPipelineLayout &layout = pipeline_layouts[{ p_set0.value, p_set1.value }];
	if (layout == VK_NULL_HANDLE) {
		VkDescriptorSetLayout sets[2] = { get<VulkanSetLayout>(p_set0).layout, VK_NULL_HANDLE };
		if (p_set1.is_valid()) {
			sets[1] = get<VulkanSetLayout>(p_set1).layout;
		}
		const VkPushConstantRange range = { ALL_STAGES, 0, PUSH_CONSTANTS_SIZE_BYTES };
		const VkPipelineLayoutCreateInfo create_info = {
			.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
			.setLayoutCount = p_set1.is_valid() ? 2u : 1u,
			.pSetLayouts = sets,
			.pushConstantRangeCount = 1,
			.pPushConstantRanges = &range,
		};
		VK_CHECK(vkCreatePipelineLayout(context.device, &create_info, nullptr, &layout));
	}
	return layout;
}

DriverPipeline VulkanDriver::create_compute_pipeline(const ComputePipelineDesc &p_desc) {
	std::vector<VkSpecializationMapEntry> entries;
	std::vector<uint32_t> values;
	for (const auto &[id, value] : p_desc.specialization) {
		entries.push_back({ id, uint32_t(values.size() * sizeof(uint32_t)), sizeof(uint32_t) });
		values.push_back(value);
	}
	const VkSpecializationInfo specialization = { uint32_t(entries.size()), entries.data(), values.size() * sizeof(uint32_t), values.data() };
	VulkanPipeline pipeline;
	pipeline.layout = pipeline_layout(p_desc.set_layout, {});
	const VkComputePipelineCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
		.stage = {
				.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
				.stage = VK_SHADER_STAGE_COMPUTE_BIT,
				.module = VkShaderModule(p_desc.shader.value),
				.pName = "main",
				.pSpecializationInfo = entries.empty() ? nullptr : &specialization,
		},
		.layout = pipeline.layout,
	};
	const VkResult result = vkCreateComputePipelines(context.device, pipeline_cache.handle(), 1, &create_info, nullptr, &pipeline.pipeline);
	if (result != VK_SUCCESS) {
		log_error("compute pipeline '{}': {}", p_desc.name, result_name(result));
		return {};
	}
	context.set_name(VK_OBJECT_TYPE_PIPELINE, uint64_t(pipeline.pipeline), p_desc.name);
	return make_id<DriverPipeline>(new VulkanPipeline(pipeline));
}

DriverPipeline VulkanDriver::create_graphics_pipeline(const GraphicsPipelineDesc &p_desc) {
	const auto stage = [](VkShaderStageFlagBits p_stage, DriverShader p_shader) {
		return VkPipelineShaderStageCreateInfo{ .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, .stage = p_stage, .module = VkShaderModule(p_shader.value), .pName = "main" };
	};
	const VkPipelineShaderStageCreateInfo stages[] = { stage(VK_SHADER_STAGE_VERTEX_BIT, p_desc.vertex_shader), stage(VK_SHADER_STAGE_FRAGMENT_BIT, p_desc.fragment_shader) };
	const VkPipelineVertexInputStateCreateInfo vertex_input = { .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO };
	const VkPipelineInputAssemblyStateCreateInfo assembly = { .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST };
	const VkPipelineViewportStateCreateInfo viewport = { .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1 };
	const VkPipelineRasterizationStateCreateInfo raster = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
		.depthClampEnable = p_desc.depth_clamp && context.features.depthClamp,
		.cullMode = to_vk(p_desc.cull),
		.frontFace = p_desc.front_face_clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE,
		.depthBiasEnable = p_desc.depth_bias_constant != 0.0f || p_desc.depth_bias_slope != 0.0f,
		.depthBiasConstantFactor = p_desc.depth_bias_constant,
		.depthBiasSlopeFactor = p_desc.depth_bias_slope,
		.lineWidth = 1.0f,
	};
	const VkPipelineMultisampleStateCreateInfo multisample = { .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT };
	const bool has_depth = p_desc.depth_format != Format::UNDEFINED;
	const VkPipelineDepthStencilStateCreateInfo depth = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
		.depthTestEnable = has_depth && p_desc.depth_test,
		.depthWriteEnable = has_depth && p_desc.depth_write,
		.depthCompareOp = to_vk(p_desc.depth_compare),
	};
	const std::vector<VkPipelineColorBlendAttachmentState> blends(p_desc.color_formats.size(), to_vk(p_desc.blend));
	const VkPipelineColorBlendStateCreateInfo blend = { .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = uint32_t(blends.size()), .pAttachments = blends.data() };
	const VkDynamicState dynamic_states[] = { VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR };
	const VkPipelineDynamicStateCreateInfo dynamic = { .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO, .dynamicStateCount = 2, .pDynamicStates = dynamic_states };
	std::vector<VkFormat> formats;
	for (Format format : p_desc.color_formats) {
		formats.push_back(to_vk(format));
	}
	const VkPipelineRenderingCreateInfo rendering = {
		.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
		.colorAttachmentCount = uint32_t(formats.size()),
		.pColorAttachmentFormats = formats.data(),
		.depthAttachmentFormat = to_vk(p_desc.depth_format),
	};
	VulkanPipeline pipeline;
	pipeline.bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
	pipeline.layout = pipeline_layout(p_desc.set_layouts[0], p_desc.set_layouts[1]);
	const VkGraphicsPipelineCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
		.pNext = &rendering,
		.stageCount = p_desc.fragment_shader.is_valid() ? 2u : 1u,
		.pStages = stages,
		.pVertexInputState = &vertex_input,
		.pInputAssemblyState = &assembly,
		.pViewportState = &viewport,
		.pRasterizationState = &raster,
		.pMultisampleState = &multisample,
		.pDepthStencilState = &depth,
		.pColorBlendState = &blend,
		.pDynamicState = &dynamic,
		.layout = pipeline.layout,
	};
	const VkResult result = vkCreateGraphicsPipelines(context.device, pipeline_cache.handle(), 1, &create_info, nullptr, &pipeline.pipeline);
	if (result != VK_SUCCESS) {
		log_error("graphics pipeline '{}': {}", p_desc.name, result_name(result));
		return {};
	}
	context.set_name(VK_OBJECT_TYPE_PIPELINE, uint64_t(pipeline.pipeline), p_desc.name);
	return make_id<DriverPipeline>(new VulkanPipeline(pipeline));
}

void VulkanDriver::destroy(DriverPipeline p_pipeline) {
	if (p_pipeline.is_valid()) {
		VulkanPipeline &pipeline = get<VulkanPipeline>(p_pipeline);
		vkDestroyPipeline(context.device, pipeline.pipeline, nullptr);
		delete &pipeline;
	}
}

} // namespace lucent
