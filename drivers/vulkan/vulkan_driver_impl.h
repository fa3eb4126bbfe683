// SPDX-License-Identifier: MIT
#pragma once

#include "drivers/vulkan/vulkan_context.h"
#include "drivers/vulkan/vulkan_memory.h"
#include "drivers/vulkan/vulkan_pipeline_cache.h"

#include <map>

namespace lucent {

struct VulkanBuffer {
	VkBuffer buffer = VK_NULL_HANDLE;
	MemoryAllocation memory;
};

struct VulkanTexture {
	struct View {
		TextureRange range;
		ViewShape shape;
		VkImageView view;
	};
	TextureDesc desc;
	VkImage image = VK_NULL_HANDLE;
	MemoryAllocation memory;
	std::vector<View> views;
};

struct VulkanSetLayout {
	std::vector<DescriptorKind> kinds;
	VkDescriptorSetLayout layout = VK_NULL_HANDLE;
};

struct VulkanSet {
	VkDescriptorSet set = VK_NULL_HANDLE;
	VkDescriptorPool pool = VK_NULL_HANDLE;
};

struct VulkanPipeline {
	VkPipeline pipeline = VK_NULL_HANDLE;
	VkPipelineLayout layout = VK_NULL_HANDLE;
	VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
};

// One command list in flight with what it owns.
struct VulkanSlot {
	VkCommandPool command_pool = VK_NULL_HANDLE;
	VkCommandBuffer commands = VK_NULL_HANDLE;
	VkFence fence = VK_NULL_HANDLE;
	bool submitted = false;
	VkQueryPool timestamps = VK_NULL_HANDLE;
	std::vector<VkDescriptorPool> descriptor_pools;
	size_t descriptor_pool_in_use = 0;
};

class VulkanDriver final : public RenderingDeviceDriver {
public:
	static Result<std::unique_ptr<RenderingDeviceDriver>> create(const VulkanDriverOptions &p_options);
	~VulkanDriver() override;

	const DeviceInfo &info() const override { return context.info; }
	uint64_t validation_message_count() const override { return context.validation.messages; }

	// vulkan_resources.cpp
	DriverBuffer create_buffer(const BufferDesc &p_desc, MemoryKind p_kind, uint64_t &r_allocated_bytes) override;
	std::byte *mapped(DriverBuffer p_buffer) override;
	DriverTexture create_texture(const TextureDesc &p_desc, uint64_t &r_allocated_bytes) override;
	DriverSampler create_sampler(const SamplerDesc &p_desc) override;
	void destroy(DriverBuffer p_buffer) override;
	void destroy(DriverTexture p_texture) override;
	void destroy(DriverSampler p_sampler) override;

	// vulkan_descriptors.cpp
	DriverSetLayout set_layout(std::span<const DescriptorKind> p_kinds) override;
	DriverSet create_set(DriverSetLayout p_layout, std::span<const DriverBinding> p_bindings, const std::string &p_name) override;
	void destroy(DriverSet p_set) override;
	void cmd_bind_transient(DriverSetLayout p_layout, std::span<const DriverBinding> p_bindings) override;
	void cmd_bind_set(DriverSet p_set) override;

	// vulkan_pipelines.cpp
	DriverShader create_shader(std::span<const uint32_t> p_spirv, const std::string &p_name) override;
	DriverPipeline create_compute_pipeline(const ComputePipelineDesc &p_desc) override;
	DriverPipeline create_graphics_pipeline(const GraphicsPipelineDesc &p_desc) override;
	void destroy(DriverShader p_shader) override;
	void destroy(DriverPipeline p_pipeline) override;

	// vulkan_driver.cpp
	void begin_commands(uint32_t p_slot) override;
	void submit_commands() override;
	void wait_idle() override;
	bool read_timestamps(uint32_t p_slot, std::span<double> r_ms) override;

	// vulkan_commands.cpp
	void cmd_barriers(std::span<const Barrier> p_barriers) override;
	void cmd_begin_label(const std::string &p_name) override;
	void cmd_end_label() override;
	void cmd_timestamp(uint32_t p_index) override;
	void cmd_fill_buffer(DriverBuffer p_buffer, uint64_t p_offset, uint64_t p_size, uint32_t p_word) override;
	void cmd_update_buffer(DriverBuffer p_buffer, uint64_t p_offset, std::span<const std::byte> p_data) override;
	void cmd_copy_buffer(DriverBuffer p_from, DriverBuffer p_to, uint64_t p_size, uint64_t p_from_offset, uint64_t p_to_offset) override;
	void cmd_clear_texture(DriverTexture p_texture, const TextureRange &p_range, Vector4 p_value) override;
	void cmd_copy_texture(DriverTexture p_from, DriverTexture p_to) override;
	void cmd_copy_buffer_to_texture(DriverBuffer p_from, uint64_t p_offset, DriverTexture p_to, uint32_t p_mip, uint32_t p_layer) override;
	void cmd_copy_texture_to_buffer(DriverTexture p_from, uint32_t p_mip, uint32_t p_layer, DriverBuffer p_to, uint64_t p_offset) override;
	void cmd_bind_pipeline(DriverPipeline p_pipeline) override;
	void cmd_push_constants(std::span<const std::byte> p_data) override;
	void cmd_dispatch(uint32_t p_x, uint32_t p_y, uint32_t p_z) override;
	void cmd_dispatch_indirect(DriverBuffer p_buffer, uint64_t p_offset) override;
	void cmd_begin_rendering(const RenderTargets &p_targets) override;
	void cmd_bind_indices(DriverBuffer p_buffer) override;
	void cmd_draw(uint32_t p_first_vertex, uint32_t p_count, uint32_t p_instances, uint32_t p_first_instance) override;
	void cmd_draw_indexed(uint32_t p_first_index, uint32_t p_count, int32_t p_vertex_offset, uint32_t p_instances, uint32_t p_first_instance) override;
	void cmd_end_rendering() override;

private:
	static constexpr VkShaderStageFlags ALL_STAGES = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
	static constexpr uint32_t PUSH_CONSTANTS_SIZE_BYTES = 128;

	VulkanDriver() = default;
	void create_slots();
	VkImageView view_of(VulkanTexture &r_texture, const TextureRange &p_range, ViewShape p_shape);
	VkPipelineLayout pipeline_layout(DriverSetLayout p_set0, DriverSetLayout p_set1);
	VkDescriptorSet allocate_transient(VkDescriptorSetLayout p_layout);
	VkDescriptorPool make_descriptor_pool(bool p_free_sets);
	void write_set(VkDescriptorSet p_set, std::span<const DriverBinding> p_bindings);
	VkRenderingAttachmentInfo attachment(const RenderTarget &p_target, uint32_t p_layer_count);
	VkCommandBuffer commands() const { return slots[slot_in_use].commands; }

	template <typename T, typename Id>
	static T &get(Id p_id) {
		return *reinterpret_cast<T *>(p_id.value);
	}
	template <typename Id, typename T>
	static Id make_id(T *p_object) {
		return Id{ reinterpret_cast<uint64_t>(p_object) };
	}

	VulkanContext context;
	std::unique_ptr<VulkanMemory> memory;
	VulkanPipelineCache pipeline_cache;
	VulkanSlot slots[SLOT_COUNT];
	uint32_t slot_in_use = 0;
	const VulkanPipeline *bound_pipeline = nullptr;

	std::map<std::vector<DescriptorKind>, std::unique_ptr<VulkanSetLayout>> set_layouts;
	std::map<std::pair<uint64_t, uint64_t>, VkPipelineLayout> pipeline_layouts;
	std::vector<VkDescriptorPool> set_pools;

	// Kept between calls so that recording does not allocate.
	std::vector<VkWriteDescriptorSet> scratch_writes;
	std::vector<VkDescriptorImageInfo> scratch_images;
	std::vector<VkDescriptorBufferInfo> scratch_buffers;
	std::vector<VkImageMemoryBarrier2> scratch_barriers;
	std::vector<VkRenderingAttachmentInfo> scratch_attachments;
};

} // namespace lucent
