// SPDX-License-Identifier: MIT
#pragma once
// What a driver must do: make objects, record commands, submit them. Drivers know no rendering words, derive no barriers
// and call nothing above them. One thread. See drivers/vulkan and drivers/null.

#include "servers/rendering/device/resource_types.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lucent {

enum class DeviceType : uint8_t {
	DISCRETE,
	INTEGRATED,
	VIRTUAL,
	CPU,
	OTHER
};

struct DeviceInfo {
	std::string name;
	std::string driver; // name and version
	std::string api_version;
	DeviceType type = DeviceType::OTHER;
	uint32_t subgroup_size = 1;
	bool timestamps = false;
	bool depth_clamp = false;
	float max_anisotropy = 1.0f;
	uint32_t max_texture_2d_texels = 4096; // per axis
	uint64_t max_storage_buffer_bytes = 1u << 27;
	std::vector<std::string> optional_features; // what `lucent info` lists
};

// A driver's object. 0: none.
template <typename Tag>
struct DriverId {
	uint64_t value = 0;
	bool is_valid() const { return value != 0; }
	bool operator==(const DriverId &) const = default;
};
using DriverBuffer = DriverId<struct DriverBufferTag>;
using DriverTexture = DriverId<struct DriverTextureTag>;
using DriverSampler = DriverId<struct DriverSamplerTag>;
using DriverShader = DriverId<struct DriverShaderTag>;
using DriverSetLayout = DriverId<struct DriverSetLayoutTag>;
using DriverSet = DriverId<struct DriverSetTag>;
using DriverPipeline = DriverId<struct DriverPipelineTag>;

enum class MemoryKind : uint8_t {
	DEVICE,
	UPLOAD,
	READ_BACK
};

// How commands touch a resource; bits combine. Stages are implied: GRAPHICS is vertex and fragment.
enum Access : uint32_t {
	ACCESS_COMPUTE_SAMPLE = 1u << 0,
	ACCESS_COMPUTE_READ = 1u << 1, // storage
	ACCESS_COMPUTE_WRITE = 1u << 2,
	ACCESS_COMPUTE_UNIFORM = 1u << 3,
	ACCESS_GRAPHICS_SAMPLE = 1u << 4,
	ACCESS_GRAPHICS_READ = 1u << 5,
	ACCESS_GRAPHICS_UNIFORM = 1u << 6,
	ACCESS_INDEX_READ = 1u << 7,
	ACCESS_INDIRECT_READ = 1u << 8,
	ACCESS_COLOR_READ = 1u << 9,
	ACCESS_COLOR_WRITE = 1u << 10,
	ACCESS_DEPTH_READ = 1u << 11,
	ACCESS_DEPTH_WRITE = 1u << 12,
	ACCESS_COPY_READ = 1u << 13,
	ACCESS_COPY_WRITE = 1u << 14,
	ACCESS_HOST_READ = 1u << 15,
};
constexpr uint32_t ACCESS_ALL_WRITES = ACCESS_COMPUTE_WRITE | ACCESS_COLOR_WRITE | ACCESS_DEPTH_WRITE | ACCESS_COPY_WRITE;

enum class TextureLayout : uint8_t {
	UNDEFINED,
	GENERAL,
	SHADER_READ,
	COLOR_TARGET,
	DEPTH_TARGET,
	DEPTH_READ,
	COPY_SOURCE,
	COPY_TARGET
};

struct TextureRange {
	uint32_t first_mip = 0;
	uint32_t mip_count = 1;
	uint32_t first_layer = 0;
	uint32_t layer_count = 1;
	bool operator==(const TextureRange &) const = default;
};

struct Barrier {
	DriverBuffer buffer; // one of these two
	DriverTexture texture;
	TextureRange range;
	uint32_t source = 0; // Access bits; 0: nothing to wait for (a first transition)
	uint32_t target = 0;
	TextureLayout old_layout = TextureLayout::UNDEFINED;
	TextureLayout new_layout = TextureLayout::UNDEFINED;
	bool operator==(const Barrier &) const = default;
};

enum class DescriptorKind : uint8_t {
	NONE,
	SAMPLED_TEXTURE,
	STORAGE_TEXTURE,
	STORAGE_BUFFER,
	UNIFORM_BUFFER,
	SAMPLER,
	TEXTURE_WITH_SAMPLER
};
enum class ViewShape : uint8_t {
	D2,
	D2_ARRAY,
	D3,
	CUBE
};

struct DriverBinding {
	uint32_t binding = 0;
	DescriptorKind kind = DescriptorKind::NONE;
	DriverBuffer buffer;
	DriverTexture texture;
	TextureRange range;
	ViewShape shape = ViewShape::D2;
	TextureLayout layout = TextureLayout::SHADER_READ;
	DriverSampler sampler;
};

struct ComputePipelineDesc {
	std::string name;
	DriverShader shader;
	DriverSetLayout set_layout;
	std::span<const std::pair<uint32_t, uint32_t>> specialization; // constant id, value
};

struct GraphicsPipelineDesc {
	std::string name;
	DriverShader vertex_shader;
	DriverShader fragment_shader;
	DriverSetLayout set_layouts[2];
	std::vector<Format> color_formats;
	Format depth_format = Format::UNDEFINED;
	CullMode cull = CullMode::BACK;
	bool front_face_clockwise = false; // on the screen, y down
	bool depth_test = true;
	bool depth_write = true;
	CompareOp depth_compare = CompareOp::GREATER_OR_EQUAL;
	BlendMode blend = BlendMode::NONE;
	float depth_bias_constant = 0.0f;
	float depth_bias_slope = 0.0f;
	bool depth_clamp = false;
};

struct RenderTarget {
	DriverTexture texture;
	TextureRange range; // one mip
	TextureLayout layout = TextureLayout::COLOR_TARGET;
	LoadOp load = LoadOp::LOAD;
	bool store = true;
	Vector4 clear{ 0.0f }; // depth: x
};

struct RenderTargets {
	std::vector<RenderTarget> color;
	RenderTarget depth; // no texture: none
	glm::uvec2 size{ 0 };
	uint32_t layer_count = 1;
	glm::uvec4 viewport{ 0 }; // x, y, width, height
};

class RenderingDeviceDriver {
public:
	static constexpr uint32_t SLOT_COUNT = 2; // command lists in flight
	static constexpr uint32_t MAX_TIMESTAMPS = 4096; // per slot

	virtual ~RenderingDeviceDriver() = default;
	virtual const DeviceInfo &info() const = 0;
	virtual uint64_t validation_message_count() const { return 0; }

	// Objects. An id of 0: it can't be made, and the log says why. Destroying 0 does nothing.
	virtual DriverBuffer create_buffer(const BufferDesc &p_desc, MemoryKind p_kind, uint64_t &r_allocated_bytes) = 0;
	virtual std::byte *mapped(DriverBuffer p_buffer) = 0; // UPLOAD and READ_BACK
	virtual DriverTexture create_texture(const TextureDesc &p_desc, uint64_t &r_allocated_bytes) = 0;
	virtual DriverSampler create_sampler(const SamplerDesc &p_desc) = 0;
	virtual DriverShader create_shader(std::span<const uint32_t> p_spirv, const std::string &p_name) = 0;
	virtual DriverSetLayout set_layout(std::span<const DescriptorKind> p_kinds) = 0; // by binding number; the driver keeps them
	virtual DriverSet create_set(DriverSetLayout p_layout, std::span<const DriverBinding> p_bindings, const std::string &p_name) = 0;
	virtual DriverPipeline create_compute_pipeline(const ComputePipelineDesc &p_desc) = 0;
	virtual DriverPipeline create_graphics_pipeline(const GraphicsPipelineDesc &p_desc) = 0;
	virtual void destroy(DriverBuffer p_buffer) = 0;
	virtual void destroy(DriverTexture p_texture) = 0;
	virtual void destroy(DriverSampler p_sampler) = 0;
	virtual void destroy(DriverShader p_shader) = 0;
	virtual void destroy(DriverSet p_set) = 0;
	virtual void destroy(DriverPipeline p_pipeline) = 0;

	// Command lists. begin_commands waits until what was last submitted in that slot has finished.
	virtual void begin_commands(uint32_t p_slot) = 0;
	virtual void submit_commands() = 0;
	virtual void wait_idle() = 0;
	// Milliseconds since an arbitrary moment of the first r_ms.size() timestamps of a finished slot. False: none.
	virtual bool read_timestamps(uint32_t p_slot, std::span<double> r_ms) = 0;

	virtual void cmd_barriers(std::span<const Barrier> p_barriers) = 0;
	virtual void cmd_begin_label(const std::string &p_name) = 0;
	virtual void cmd_end_label() = 0;
	virtual void cmd_timestamp(uint32_t p_index) = 0; // when all work before has finished
	virtual void cmd_fill_buffer(DriverBuffer p_buffer, uint64_t p_offset, uint64_t p_size, uint32_t p_word) = 0;
	virtual void cmd_update_buffer(DriverBuffer p_buffer, uint64_t p_offset, std::span<const std::byte> p_data) = 0;
	virtual void cmd_copy_buffer(DriverBuffer p_from, DriverBuffer p_to, uint64_t p_size, uint64_t p_from_offset, uint64_t p_to_offset) = 0;
	// In COPY_TARGET layout. Integer formats take the value rounded down.
	virtual void cmd_clear_texture(DriverTexture p_texture, const TextureRange &p_range, Vector4 p_value) = 0;
	// COPY_SOURCE to COPY_TARGET; all mips and layers.
	virtual void cmd_copy_texture(DriverTexture p_from, DriverTexture p_to) = 0;
	// One mip of one layer (3D: all slices), tightly packed.
	virtual void cmd_copy_buffer_to_texture(DriverBuffer p_from, uint64_t p_offset, DriverTexture p_to, uint32_t p_mip, uint32_t p_layer) = 0;
	virtual void cmd_copy_texture_to_buffer(DriverTexture p_from, uint32_t p_mip, uint32_t p_layer, DriverBuffer p_to, uint64_t p_offset) = 0;

	// Bindings live until the list has finished. Render passes bind after cmd_begin_rendering and a first pipeline.
	virtual void cmd_bind_pipeline(DriverPipeline p_pipeline) = 0;
	virtual void cmd_bind_transient(DriverSetLayout p_layout, std::span<const DriverBinding> p_bindings) = 0; // set 0
	virtual void cmd_bind_set(DriverSet p_set) = 0; // set 1
	virtual void cmd_push_constants(std::span<const std::byte> p_data) = 0;
	virtual void cmd_dispatch(uint32_t p_x, uint32_t p_y, uint32_t p_z) = 0;
	virtual void cmd_dispatch_indirect(DriverBuffer p_buffer, uint64_t p_offset) = 0;
	virtual void cmd_begin_rendering(const RenderTargets &p_targets) = 0;
	virtual void cmd_bind_indices(DriverBuffer p_buffer) = 0;
	virtual void cmd_draw(uint32_t p_first_vertex, uint32_t p_count, uint32_t p_instances, uint32_t p_first_instance) = 0;
	virtual void cmd_draw_indexed(uint32_t p_first_index, uint32_t p_count, int32_t p_vertex_offset, uint32_t p_instances, uint32_t p_first_instance) = 0;
	virtual void cmd_end_rendering() = 0;
};

} // namespace lucent
