// SPDX-License-Identifier: MIT
#pragma once

#include "servers/core/error.h"
#include "servers/rendering/device/rendering_device_driver.h"

#include <volk.h>

// A lost device or a call that cannot fail in a correct program.
#define VK_CHECK(m_call) \
	do { \
		const VkResult vk_check_result = (m_call); \
		INVARIANT(vk_check_result == VK_SUCCESS, "{}", ::lucent::result_name(vk_check_result)); \
	} while (false)

namespace lucent {

const char *result_name(VkResult p_result);
VkFormat to_vk(Format p_format);
VkImageLayout to_vk(TextureLayout p_layout);
VkImageAspectFlags format_aspect(Format p_format);
VkDescriptorType to_vk(DescriptorKind p_kind);
VkCompareOp to_vk(CompareOp p_op);
VkCullModeFlags to_vk(CullMode p_mode);
VkSamplerAddressMode to_vk(AddressMode p_mode);
VkAttachmentLoadOp to_vk(LoadOp p_op);
VkPipelineColorBlendAttachmentState to_vk(BlendMode p_mode);

struct StageAccess {
	VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
	VkAccessFlags2 access = VK_ACCESS_2_NONE;
};
StageAccess to_vk(uint32_t p_access);

} // namespace lucent
