// SPDX-License-Identifier: MIT
#pragma once
// Passes are declared, not hand-built: what a pass reads and writes, its constants, its dispatch or draws. The recorder
// checks every binding against the shader's SPIR-V (missing, surplus, wrong kind, constants' size: INVARIANT), derives the
// barriers, opens the debug label and the GPU timestamp. Program order is execution order.

#include "servers/rendering/device/resource_types.h"
#include "servers/rendering/device/shader_ids.gen.h"

#include <array>
#include <cstring>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

namespace lucent {

class RenderingDevice;

// One texture view as a pass sees it. mip/layer = ALL: the whole texture.
struct TextureView {
	static constexpr uint32_t ALL = UINT32_MAX;
	TextureHandle texture;
	uint32_t mip = ALL;
	uint32_t layer = ALL;
};

// Fixed state of a draw; the pipeline is found or made from it, the shaders and the pass's target formats. Front faces
// are counter-clockwise in world space (the viewport's y is flipped by the projection, not by a negative viewport).
// Vertices are pulled from storage buffers by gl_VertexIndex: there are no vertex attributes.
struct DrawState {
	Shader vertex_shader;
	Shader fragment_shader = Shader::NONE; // NONE: depth only
	CullMode cull = CullMode::BACK;
	bool front_face_clockwise = false; // for mirrored transforms
	bool depth_test = true;
	bool depth_write = true;
	CompareOp depth_compare = CompareOp::GREATER_OR_EQUAL; // reversed z
	BlendMode blend = BlendMode::NONE; // every colour target alike
	float depth_bias_constant = 0.0f;
	float depth_bias_slope = 0.0f;
	bool depth_clamp = false; // ignored where the device lacks it
	bool operator==(const DrawState &) const = default;
};

struct DrawCommand {
	DrawState state;
	BindingSetHandle material; // set 1; null: the shaders declare no set 1
	std::array<std::byte, 128> constants{}; // push constants, both stages
	uint32_t constants_size_bytes = 0;
	uint32_t first_index = 0; // with an index buffer; else first vertex
	uint32_t index_count = 0;
	int32_t vertex_offset = 0;
	uint32_t instance_count = 1;
	uint32_t first_instance = 0;

	template <typename T>
	void set_constants(const T &p_constants) {
		static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 128);
		std::memcpy(constants.data(), &p_constants, sizeof(T));
		constants_size_bytes = sizeof(T);
	}
};

enum class PassBindingKind : uint8_t {
	READ_TEXTURE,
	WRITE_TEXTURE,
	READ_WRITE_TEXTURE,
	READ_BUFFER,
	WRITE_BUFFER,
	READ_WRITE_BUFFER,
	UNIFORM_BUFFER,
	SAMPLER
};
struct PassBinding {
	uint32_t binding = 0;
	PassBindingKind kind = PassBindingKind::READ_TEXTURE;
	TextureView view;
	BufferHandle buffer;
	SamplerHandle sampler;
};

class PassRecorder;

// All pass bindings are in set 0. `read` of a texture: `texture2D/3D` or a readonly image in the shader; of a buffer: a readonly
// storage block. `write`/`read_write`: storage images and blocks.
class ComputePass {
public:
	ComputePass &read(uint32_t p_binding, TextureHandle p_texture) { return read(p_binding, TextureView{ p_texture }); }
	ComputePass &read(uint32_t p_binding, TextureView p_view);
	ComputePass &read(uint32_t p_binding, BufferHandle p_buffer);
	ComputePass &write(uint32_t p_binding, TextureHandle p_texture) { return write(p_binding, TextureView{ p_texture }); }
	ComputePass &write(uint32_t p_binding, TextureView p_view);
	ComputePass &write(uint32_t p_binding, BufferHandle p_buffer);
	ComputePass &read_write(uint32_t p_binding, TextureHandle p_texture) { return read_write(p_binding, TextureView{ p_texture }); }
	ComputePass &read_write(uint32_t p_binding, TextureView p_view);
	ComputePass &read_write(uint32_t p_binding, BufferHandle p_buffer);
	ComputePass &uniform(uint32_t p_binding, BufferHandle p_buffer);
	ComputePass &sampler(uint32_t p_binding, SamplerHandle p_sampler);
	ComputePass &specialize(uint32_t p_constant_id, uint32_t p_value);
	template <typename T>
	ComputePass &constants(const T &p_constants) {
		static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 128);
		std::memcpy(push_constants.data(), &p_constants, sizeof(T));
		push_constants_size_bytes = sizeof(T);
		return *this;
	}
	// Exactly one of these ends the declaration and records the pass. Threads are divided by the shader's local size, rounded up.
	void dispatch_threads(uint32_t p_x, uint32_t p_y = 1, uint32_t p_z = 1);
	void dispatch_groups(uint32_t p_x, uint32_t p_y = 1, uint32_t p_z = 1);
	void dispatch_indirect(BufferHandle p_arguments, uint64_t p_offset_bytes = 0); // uvec3 of groups

private:
	friend class PassRecorder;
	ComputePass(PassRecorder &p_recorder, std::string p_name, Shader p_shader);
	template <typename Dispatch>
	void record(Dispatch &&p_dispatch, BufferHandle p_arguments);
	PassRecorder &recorder;
	std::string name;
	Shader shader;
	std::vector<PassBinding> bindings;
	std::vector<std::pair<uint32_t, uint32_t>> specialization;
	std::array<std::byte, 128> push_constants{};
	uint32_t push_constants_size_bytes = 0;
};

// A render pass: targets, the bindings that all its draws share (set 0), the draws.
class RenderPass {
public:
	RenderPass &color(uint32_t p_index, TextureView p_target, LoadOp p_load, Vector4 p_clear = Vector4(0.0f));
	RenderPass &depth(TextureView p_target, LoadOp p_load, float p_clear = 0.0f);
	RenderPass &depth_read_only(TextureView p_target);
	RenderPass &read(uint32_t p_binding, TextureHandle p_texture) { return read(p_binding, TextureView{ p_texture }); }
	RenderPass &read(uint32_t p_binding, TextureView p_view);
	RenderPass &read(uint32_t p_binding, BufferHandle p_buffer);
	RenderPass &uniform(uint32_t p_binding, BufferHandle p_buffer);
	RenderPass &sampler(uint32_t p_binding, SamplerHandle p_sampler);
	RenderPass &indices(BufferHandle p_buffer); // uint32
	RenderPass &viewport(uint32_t p_x, uint32_t p_y, uint32_t p_width, uint32_t p_height); // default: the whole target
	// Ends the declaration and records the pass. No draws: only the clears happen.
	void draw(std::span<const DrawCommand> p_draws);

private:
	friend class PassRecorder;
	friend struct RenderPassRecording;
	RenderPass(PassRecorder &p_recorder, std::string p_name);
	struct Target {
		TextureView view;
		LoadOp load = LoadOp::LOAD;
		Vector4 clear{ 0.0f };
		bool read_only = false;
	};
	PassRecorder &recorder;
	std::string name;
	std::vector<Target> color_targets;
	Target depth_target;
	std::vector<PassBinding> bindings;
	BufferHandle index_buffer;
	glm::uvec4 viewport_rect{ 0 }; // x, y, width, height; width 0: whole target
};

// What a recorded pass touched: for approval tests, --stats and the per-pass hook.
struct PassInfo {
	std::string name;
	std::string shader; // compute only
	std::vector<std::string> reads; // debug names
	std::vector<std::string> writes;
};

class PassRecorder {
public:
	ComputePass compute(std::string p_name, Shader p_shader) { return ComputePass(*this, std::move(p_name), p_shader); }
	RenderPass render(std::string p_name) { return RenderPass(*this, std::move(p_name)); }
	void clear_buffer(BufferHandle p_buffer, uint32_t p_word = 0); // fills with 32-bit words
	void clear_texture(TextureHandle p_texture, Vector4 p_value = Vector4(0.0f));
	void copy_buffer(BufferHandle p_from, BufferHandle p_to, uint64_t p_size_bytes, uint64_t p_from_offset = 0, uint64_t p_to_offset = 0);
	void copy_texture(TextureHandle p_from, TextureHandle p_to); // same size and format, all mips and layers
	// At most 64 KiB, ordered with the passes around it (unlike RenderingDevice::upload_*, which precede the frame).
	void update_buffer(BufferHandle p_buffer, uint64_t p_offset_bytes, std::span<const std::byte> p_data);

	const std::vector<PassInfo> &pass_list() const { return passes; }
	// Called after each pass while recording; may record copies.
	void set_pass_hook(std::function<void(const PassInfo &)> p_hook) { hook = std::move(p_hook); }

private:
	friend class ComputePass;
	friend class RenderPass;
	friend class RenderingDevice;
	explicit PassRecorder(RenderingDevice &p_device) :
			device(p_device) {}
	RenderingDevice &device;
	std::vector<PassInfo> passes;
	std::function<void(const PassInfo &)> hook;
};

} // namespace lucent
