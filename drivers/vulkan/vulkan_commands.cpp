// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_driver_impl.h"

#include <algorithm>

namespace lucent {

namespace {

VkBufferImageCopy2 image_copy(const TextureDesc &p_desc, uint64_t p_offset, uint32_t p_mip, uint32_t p_layer) {
	const glm::uvec3 size = p_desc.mip_size(p_mip);
	return {
		.sType = VK_STRUCTURE_TYPE_BUFFER_IMAGE_COPY_2,
		.bufferOffset = p_offset,
		.imageSubresource = { format_aspect(p_desc.format), p_mip, p_layer, 1 },
		.imageExtent = { size.x, size.y, size.z },
	};
}

} // namespace

// Layout changes name their image; all other hazards share one memory barrier.
void VulkanDriver::cmd_barriers(std::span<const Barrier> p_barriers) {
	VkMemoryBarrier2 shared = { .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2 };
	scratch_barriers.clear();
	for (const Barrier &barrier : p_barriers) {
		const StageAccess source = to_vk(barrier.source);
		const StageAccess source_writes = to_vk(barrier.source & ACCESS_ALL_WRITES);
		const StageAccess target = to_vk(barrier.target);
		if (barrier.old_layout == barrier.new_layout) {
			shared.srcStageMask |= source.stages;
			shared.srcAccessMask |= source_writes.access;
			shared.dstStageMask |= target.stages;
			shared.dstAccessMask |= target.access;
			continue;
		}
		const VulkanTexture &texture = get<VulkanTexture>(barrier.texture);
		scratch_barriers.push_back({
				.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
				.srcStageMask = source.stages,
				.srcAccessMask = source_writes.access,
				.dstStageMask = target.stages,
				.dstAccessMask = target.access,
				.oldLayout = to_vk(barrier.old_layout),
				.newLayout = to_vk(barrier.new_layout),
				.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
				.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
				.image = texture.image,
				.subresourceRange = { format_aspect(texture.desc.format), barrier.range.first_mip, barrier.range.mip_count, barrier.range.first_layer, barrier.range.layer_count },
		});
	}
	const VkDependencyInfo dependency = {
		.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
		.memoryBarrierCount = shared.srcStageMask != VK_PIPELINE_STAGE_2_NONE ? 1u : 0u,
		.pMemoryBarriers = &shared,
		.imageMemoryBarrierCount = uint32_t(scratch_barriers.size()),
		.pImageMemoryBarriers = scratch_barriers.data(),
	};
	vkCmdPipelineBarrier2(commands(), &dependency);
}

void VulkanDriver::cmd_begin_label(const std::string &p_name) {
	if (context.debug_utils && vkCmdBeginDebugUtilsLabelEXT != nullptr) {
		const VkDebugUtilsLabelEXT label = { .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = p_name.c_str() };
		vkCmdBeginDebugUtilsLabelEXT(commands(), &label);
	}
}

void VulkanDriver::cmd_end_label() {
	if (context.debug_utils && vkCmdEndDebugUtilsLabelEXT != nullptr) {
		vkCmdEndDebugUtilsLabelEXT(commands());
	}
}

void VulkanDriver::cmd_timestamp(uint32_t p_index) {
	if (slots[slot_in_use].timestamps != VK_NULL_HANDLE && p_index < MAX_TIMESTAMPS) {
		vkCmdWriteTimestamp2(commands(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slots[slot_in_use].timestamps, p_index);
	}
}

void VulkanDriver::cmd_fill_buffer(DriverBuffer p_buffer, uint64_t p_offset, uint64_t p_size, uint32_t p_word) {
	vkCmdFillBuffer(commands(), get<VulkanBuffer>(p_buffer).buffer, p_offset, p_size, p_word);
}

void VulkanDriver::cmd_update_buffer(DriverBuffer p_buffer, uint64_t p_offset, std::span<const std::byte> p_data) {
	vkCmdUpdateBuffer(commands(), get<VulkanBuffer>(p_buffer).buffer, p_offset, p_data.size(), p_data.data());
}

void VulkanDriver::cmd_copy_buffer(DriverBuffer p_from, DriverBuffer p_to, uint64_t p_size, uint64_t p_from_offset, uint64_t p_to_offset) {
	const VkBufferCopy region = { p_from_offset, p_to_offset, p_size };
	vkCmdCopyBuffer(commands(), get<VulkanBuffer>(p_from).buffer, get<VulkanBuffer>(p_to).buffer, 1, &region);
}

void VulkanDriver::cmd_clear_texture(DriverTexture p_texture, const TextureRange &p_range, Vector4 p_value) {
	const VulkanTexture &texture = get<VulkanTexture>(p_texture);
	const VkImageSubresourceRange range = { format_aspect(texture.desc.format), p_range.first_mip, p_range.mip_count, p_range.first_layer, p_range.layer_count };
	const FormatKind kind = format_kind(texture.desc.format);
	if (kind == FormatKind::DEPTH) {
		const VkClearDepthStencilValue value = { p_value.x, 0 };
		vkCmdClearDepthStencilImage(commands(), texture.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
		return;
	}
	VkClearColorValue value = {};
	for (int i = 0; i < 4; i++) {
		if (kind == FormatKind::UINT) {
			value.uint32[i] = p_value[i] >= 4294967040.0f ? UINT32_MAX : (p_value[i] > 0.0f ? uint32_t(p_value[i]) : 0u);
		} else {
			value.float32[i] = p_value[i];
		}
	}
	vkCmdClearColorImage(commands(), texture.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
}

void VulkanDriver::cmd_copy_texture(DriverTexture p_from, DriverTexture p_to) {
	const VulkanTexture &from = get<VulkanTexture>(p_from);
	const VulkanTexture &to = get<VulkanTexture>(p_to);
	const VkImageAspectFlags aspect = format_aspect(from.desc.format);
	std::vector<VkImageCopy> regions;
	for (uint32_t mip = 0; mip < from.desc.mips; mip++) {
		const glm::uvec3 size = from.desc.mip_size(mip);
		const VkImageSubresourceLayers layers = { aspect, mip, 0, from.desc.layer_count() };
		regions.push_back({ .srcSubresource = layers, .dstSubresource = layers, .extent = { size.x, size.y, size.z } });
	}
	vkCmdCopyImage(commands(), from.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, uint32_t(regions.size()), regions.data());
}

void VulkanDriver::cmd_copy_buffer_to_texture(DriverBuffer p_from, uint64_t p_offset, DriverTexture p_to, uint32_t p_mip, uint32_t p_layer) {
	const VulkanTexture &texture = get<VulkanTexture>(p_to);
	const VkBufferImageCopy2 region = image_copy(texture.desc, p_offset, p_mip, p_layer);
	const VkCopyBufferToImageInfo2 copy = {
		.sType = VK_STRUCTURE_TYPE_COPY_BUFFER_TO_IMAGE_INFO_2,
		.srcBuffer = get<VulkanBuffer>(p_from).buffer,
		.dstImage = texture.image,
		.dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
		.regionCount = 1,
		.pRegions = &region,
	};
	vkCmdCopyBufferToImage2(commands(), &copy);
}

void VulkanDriver::cmd_copy_texture_to_buffer(DriverTexture p_from, uint32_t p_mip, uint32_t p_layer, DriverBuffer p_to, uint64_t p_offset) {
	const VulkanTexture &texture = get<VulkanTexture>(p_from);
	const VkBufferImageCopy2 region = image_copy(texture.desc, p_offset, p_mip, p_layer);
	const VkCopyImageToBufferInfo2 copy = {
		.sType = VK_STRUCTURE_TYPE_COPY_IMAGE_TO_BUFFER_INFO_2,
		.srcImage = texture.image,
		.srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
		.dstBuffer = get<VulkanBuffer>(p_to).buffer,
		.regionCount = 1,
		.pRegions = &region,
	};
	vkCmdCopyImageToBuffer2(commands(), &copy);
}

void VulkanDriver::cmd_bind_pipeline(DriverPipeline p_pipeline) {
	bound_pipeline = &get<VulkanPipeline>(p_pipeline);
	vkCmdBindPipeline(commands(), bound_pipeline->bind_point, bound_pipeline->pipeline);
}

void VulkanDriver::cmd_push_constants(std::span<const std::byte> p_data) {
	vkCmdPushConstants(commands(), bound_pipeline->layout, ALL_STAGES, 0, uint32_t(p_data.size()), p_data.data());
}

void VulkanDriver::cmd_dispatch(uint32_t p_x, uint32_t p_y, uint32_t p_z) {
	vkCmdDispatch(commands(), p_x, p_y, p_z);
}

void VulkanDriver::cmd_dispatch_indirect(DriverBuffer p_buffer, uint64_t p_offset) {
	vkCmdDispatchIndirect(commands(), get<VulkanBuffer>(p_buffer).buffer, p_offset);
}

VkRenderingAttachmentInfo VulkanDriver::attachment(const RenderTarget &p_target, uint32_t p_layer_count) {
	VkRenderingAttachmentInfo info = {
		.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
		.imageView = view_of(get<VulkanTexture>(p_target.texture), p_target.range, p_layer_count > 1 ? ViewShape::D2_ARRAY : ViewShape::D2),
		.imageLayout = to_vk(p_target.layout),
		.loadOp = to_vk(p_target.load),
		.storeOp = p_target.store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_NONE,
	};
	if (p_target.layout == TextureLayout::COLOR_TARGET) {
		info.clearValue.color = { { p_target.clear.x, p_target.clear.y, p_target.clear.z, p_target.clear.w } };
		if (format_kind(get<VulkanTexture>(p_target.texture).desc.format) == FormatKind::UINT) {
			for (int i = 0; i < 4; i++) {
				info.clearValue.color.uint32[i] = uint32_t(std::max(p_target.clear[i], 0.0f));
			}
		}
	} else {
		info.clearValue.depthStencil = { p_target.clear.x, 0 };
	}
	return info;
}

void VulkanDriver::cmd_begin_rendering(const RenderTargets &p_targets) {
	scratch_attachments.clear();
	for (const RenderTarget &target : p_targets.color) {
		scratch_attachments.push_back(attachment(target, p_targets.layer_count));
	}
	const bool has_depth = p_targets.depth.texture.is_valid();
	const VkRenderingAttachmentInfo depth = has_depth ? attachment(p_targets.depth, p_targets.layer_count) : VkRenderingAttachmentInfo{};
	const VkRenderingInfo rendering = {
		.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
		.renderArea = { { 0, 0 }, { p_targets.size.x, p_targets.size.y } },
		.layerCount = p_targets.layer_count,
		.colorAttachmentCount = uint32_t(scratch_attachments.size()),
		.pColorAttachments = scratch_attachments.data(),
		.pDepthAttachment = has_depth ? &depth : nullptr,
	};
	vkCmdBeginRendering(commands(), &rendering);
	const glm::uvec4 &rect = p_targets.viewport;
	const VkViewport viewport = { float(rect.x), float(rect.y), float(rect.z), float(rect.w), 0.0f, 1.0f };
	const VkRect2D scissor = { { int32_t(rect.x), int32_t(rect.y) }, { rect.z, rect.w } };
	vkCmdSetViewport(commands(), 0, 1, &viewport);
	vkCmdSetScissor(commands(), 0, 1, &scissor);
}

void VulkanDriver::cmd_bind_indices(DriverBuffer p_buffer) {
	vkCmdBindIndexBuffer(commands(), get<VulkanBuffer>(p_buffer).buffer, 0, VK_INDEX_TYPE_UINT32);
}

void VulkanDriver::cmd_draw(uint32_t p_first_vertex, uint32_t p_count, uint32_t p_instances, uint32_t p_first_instance) {
	vkCmdDraw(commands(), p_count, p_instances, p_first_vertex, p_first_instance);
}

void VulkanDriver::cmd_draw_indexed(uint32_t p_first_index, uint32_t p_count, int32_t p_vertex_offset, uint32_t p_instances, uint32_t p_first_instance) {
	vkCmdDrawIndexed(commands(), p_count, p_instances, p_first_index, p_vertex_offset, p_first_instance);
}

void VulkanDriver::cmd_end_rendering() {
	vkCmdEndRendering(commands());
}

} // namespace lucent
