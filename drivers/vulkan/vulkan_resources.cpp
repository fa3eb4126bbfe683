// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_driver_impl.h"

#include <algorithm>

namespace lucent {

namespace {

VkImageUsageFlags image_usage(uint32_t p_usage) {
	VkImageUsageFlags flags = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
	flags |= p_usage & TEXTURE_SAMPLED ? VK_IMAGE_USAGE_SAMPLED_BIT : 0;
	flags |= p_usage & TEXTURE_STORAGE ? VK_IMAGE_USAGE_STORAGE_BIT : 0;
	flags |= p_usage & TEXTURE_COLOR_TARGET ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT : 0;
	flags |= p_usage & TEXTURE_DEPTH_TARGET ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : 0;
	return flags;
}

} // namespace

DriverBuffer VulkanDriver::create_buffer(const BufferDesc &p_desc, MemoryKind p_kind, uint64_t &r_allocated_bytes) {
	VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
	usage |= p_desc.usage & BUFFER_STORAGE ? VK_BUFFER_USAGE_STORAGE_BUFFER_BIT : 0;
	usage |= p_desc.usage & BUFFER_UNIFORM ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT : 0;
	usage |= p_desc.usage & BUFFER_INDEX ? VK_BUFFER_USAGE_INDEX_BUFFER_BIT : 0;
	usage |= p_desc.usage & BUFFER_INDIRECT ? VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT : 0;
	const VkBufferCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
		.size = p_desc.size_bytes,
		.usage = usage,
	};
	VulkanBuffer buffer;
	VkResult result = vkCreateBuffer(context.device, &create_info, nullptr, &buffer.buffer);
	if (result == VK_SUCCESS) {
		buffer.memory = memory->allocate_for(buffer.buffer, p_kind);
		result = buffer.memory.is_valid() ? vkBindBufferMemory(context.device, buffer.buffer, buffer.memory.block->memory, buffer.memory.offset) : VK_ERROR_OUT_OF_DEVICE_MEMORY;
	}
	if (result != VK_SUCCESS) {
		log_error("buffer '{}' of {} bytes: {}", p_desc.name, p_desc.size_bytes, result_name(result));
		vkDestroyBuffer(context.device, buffer.buffer, nullptr);
		memory->free(buffer.memory);
		return {};
	}
	context.set_name(VK_OBJECT_TYPE_BUFFER, uint64_t(buffer.buffer), p_desc.name);
	r_allocated_bytes = buffer.memory.size;
	return make_id<DriverBuffer>(new VulkanBuffer(buffer));
}

std::byte *VulkanDriver::mapped(DriverBuffer p_buffer) {
	return get<VulkanBuffer>(p_buffer).memory.mapped();
}

void VulkanDriver::destroy(DriverBuffer p_buffer) {
	if (p_buffer.is_valid()) {
		VulkanBuffer &buffer = get<VulkanBuffer>(p_buffer);
		vkDestroyBuffer(context.device, buffer.buffer, nullptr);
		memory->free(buffer.memory);
		delete &buffer;
	}
}

DriverTexture VulkanDriver::create_texture(const TextureDesc &p_desc, uint64_t &r_allocated_bytes) {
	const bool is_3d = p_desc.type == TextureType::TEXTURE_3D;
	const VkImageCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
		.flags = p_desc.type == TextureType::TEXTURE_CUBE ? VkImageCreateFlags(VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT) : 0,
		.imageType = is_3d ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D,
		.format = to_vk(p_desc.format),
		.extent = { p_desc.width, p_desc.height, is_3d ? p_desc.depth : 1 },
		.mipLevels = p_desc.mips,
		.arrayLayers = p_desc.layer_count(),
		.samples = VK_SAMPLE_COUNT_1_BIT,
		.tiling = VK_IMAGE_TILING_OPTIMAL,
		.usage = image_usage(p_desc.usage),
		.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
	};
	VkImageFormatProperties limits;
	VkResult result = vkGetPhysicalDeviceImageFormatProperties(context.physical_device, create_info.format, create_info.imageType, create_info.tiling, create_info.usage, create_info.flags, &limits);
	const bool fits = result == VK_SUCCESS && create_info.extent.width <= limits.maxExtent.width && create_info.extent.height <= limits.maxExtent.height && create_info.extent.depth <= limits.maxExtent.depth && create_info.arrayLayers <= limits.maxArrayLayers && create_info.mipLevels <= limits.maxMipLevels;
	if (!fits) {
		log_error("texture '{}': {} cannot make {}x{}x{}, {} layers, {} with usage {:#x}", p_desc.name, context.info.name, p_desc.width, p_desc.height, p_desc.depth, create_info.arrayLayers, format_name(p_desc.format), p_desc.usage);
		return {};
	}
	VulkanTexture texture;
	texture.desc = p_desc;
	result = vkCreateImage(context.device, &create_info, nullptr, &texture.image);
	if (result == VK_SUCCESS) {
		texture.memory = memory->allocate_for(texture.image);
		result = texture.memory.is_valid() ? vkBindImageMemory(context.device, texture.image, texture.memory.block->memory, texture.memory.offset) : VK_ERROR_OUT_OF_DEVICE_MEMORY;
	}
	if (result != VK_SUCCESS) {
		log_error("texture '{}' of {}x{}x{}: {}", p_desc.name, p_desc.width, p_desc.height, p_desc.depth, result_name(result));
		vkDestroyImage(context.device, texture.image, nullptr);
		memory->free(texture.memory);
		return {};
	}
	context.set_name(VK_OBJECT_TYPE_IMAGE, uint64_t(texture.image), p_desc.name);
	r_allocated_bytes = texture.memory.size;
	return make_id<DriverTexture>(new VulkanTexture(std::move(texture)));
}

void VulkanDriver::destroy(DriverTexture p_texture) {
	if (p_texture.is_valid()) {
		VulkanTexture &texture = get<VulkanTexture>(p_texture);
		for (const VulkanTexture::View &view : texture.views) {
			vkDestroyImageView(context.device, view.view, nullptr);
		}
		vkDestroyImage(context.device, texture.image, nullptr);
		memory->free(texture.memory);
		delete &texture;
	}
}

VkImageView VulkanDriver::view_of(VulkanTexture &r_texture, const TextureRange &p_range, ViewShape p_shape) {
	for (const VulkanTexture::View &view : r_texture.views) {
		if (view.range == p_range && view.shape == p_shape) {
			return view.view;
		}
	}
	constexpr VkImageViewType TYPES[] = { VK_IMAGE_VIEW_TYPE_2D, VK_IMAGE_VIEW_TYPE_2D_ARRAY, VK_IMAGE_VIEW_TYPE_3D, VK_IMAGE_VIEW_TYPE_CUBE };
	const VkImageViewCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
		.image = r_texture.image,
		.viewType = TYPES[size_t(p_shape)],
		.format = to_vk(r_texture.desc.format),
		.subresourceRange = { format_aspect(r_texture.desc.format), p_range.first_mip, p_range.mip_count, p_range.first_layer, p_range.layer_count },
	};
	VkImageView view = VK_NULL_HANDLE;
	VK_CHECK(vkCreateImageView(context.device, &create_info, nullptr, &view));
	context.set_name(VK_OBJECT_TYPE_IMAGE_VIEW, uint64_t(view), r_texture.desc.name);
	r_texture.views.push_back({ p_range, p_shape, view });
	return view;
}

DriverSampler VulkanDriver::create_sampler(const SamplerDesc &p_desc) {
	const auto filter = [](Filter p_filter) { return p_filter == Filter::LINEAR ? VK_FILTER_LINEAR : VK_FILTER_NEAREST; };
	const float anisotropy = std::min(p_desc.max_anisotropy, context.info.max_anisotropy);
	const VkSamplerCreateInfo create_info = {
		.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
		.magFilter = filter(p_desc.mag_filter),
		.minFilter = filter(p_desc.min_filter),
		.mipmapMode = p_desc.mip_filter == Filter::LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
		.addressModeU = to_vk(p_desc.address_u),
		.addressModeV = to_vk(p_desc.address_v),
		.addressModeW = to_vk(p_desc.address_w),
		.anisotropyEnable = anisotropy > 1.0f,
		.maxAnisotropy = std::max(anisotropy, 1.0f),
		.compareEnable = p_desc.compare,
		.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL,
		.maxLod = p_desc.max_lod,
		.borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK,
	};
	VkSampler sampler = VK_NULL_HANDLE;
	VK_CHECK(vkCreateSampler(context.device, &create_info, nullptr, &sampler));
	return { uint64_t(sampler) };
}

void VulkanDriver::destroy(DriverSampler p_sampler) {
	vkDestroySampler(context.device, VkSampler(p_sampler.value), nullptr);
}

} // namespace lucent
