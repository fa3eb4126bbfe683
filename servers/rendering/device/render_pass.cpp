// SPDX-License-Identifier: MIT
#include "servers/rendering/device/pass_bindings.h"
#include "servers/rendering/device/pass_checks.h"

#include <algorithm>

namespace lucent {

RenderPass::RenderPass(PassRecorder &p_recorder, std::string p_name) :
		recorder(p_recorder), name(std::move(p_name)) {
	bindings.reserve(12);
}

RenderPass &RenderPass::color(uint32_t p_index, TextureView p_target, LoadOp p_load, Vector4 p_clear) {
	INVARIANT(p_index < PipelineStore::MAX_COLOR_TARGETS, "pass '{}': colour target {}", name, p_index);
	color_targets.resize(std::max(color_targets.size(), size_t(p_index) + 1));
	color_targets[p_index] = { p_target, p_load, p_clear, false };
	return *this;
}

RenderPass &RenderPass::depth(TextureView p_target, LoadOp p_load, float p_clear) {
	depth_target = { p_target, p_load, Vector4(p_clear), false };
	return *this;
}

RenderPass &RenderPass::depth_read_only(TextureView p_target) {
	depth_target = { p_target, LoadOp::LOAD, Vector4(0.0f), true };
	return *this;
}

RenderPass &RenderPass::read(uint32_t p_binding, TextureView p_view) {
	bindings.push_back({ p_binding, PassBindingKind::READ_TEXTURE, p_view, {}, {} });
	return *this;
}

RenderPass &RenderPass::read(uint32_t p_binding, BufferHandle p_buffer) {
	bindings.push_back({ p_binding, PassBindingKind::READ_BUFFER, {}, p_buffer, {} });
	return *this;
}

RenderPass &RenderPass::uniform(uint32_t p_binding, BufferHandle p_buffer) {
	bindings.push_back({ p_binding, PassBindingKind::UNIFORM_BUFFER, {}, p_buffer, {} });
	return *this;
}

RenderPass &RenderPass::sampler(uint32_t p_binding, SamplerHandle p_sampler) {
	bindings.push_back({ p_binding, PassBindingKind::SAMPLER, {}, {}, p_sampler });
	return *this;
}

RenderPass &RenderPass::indices(BufferHandle p_buffer) {
	index_buffer = p_buffer;
	return *this;
}

RenderPass &RenderPass::viewport(uint32_t p_x, uint32_t p_y, uint32_t p_width, uint32_t p_height) {
	viewport_rect = { p_x, p_y, p_width, p_height };
	return *this;
}

// One draw() while it records.
struct RenderPassRecording {
	const RenderPass &pass;
	RenderingDevice::Impl &impl;
	PassInfo info;
	PipelineStore::Targets formats;

	RenderTarget resolve_target(const RenderPass::Target &p_target, bool p_depth);
	void resolve_targets();
	void collect_shaders(std::span<const DrawCommand> p_draws);
	void use_material(BindingSetHandle p_material);
	void check_draw(const DrawCommand &p_command);
	void record_draws(std::span<const DrawCommand> p_draws);
};

// Makes one target's attachment and checks its size and layers against those before it.
RenderTarget RenderPassRecording::resolve_target(const RenderPass::Target &p_target, bool p_depth) {
	TextureResource *texture = impl.textures.get(p_target.view.texture);
	INVARIANT(texture != nullptr, "pass '{}': a target is null or was freed", info.name);
	const TextureDesc &desc = texture->desc;
	const uint32_t needed = p_depth ? TEXTURE_DEPTH_TARGET : TEXTURE_COLOR_TARGET;
	INVARIANT(desc.usage & needed, "pass '{}': '{}' was made without TEXTURE_{}_TARGET", info.name, desc.name, p_depth ? "DEPTH" : "COLOR");
	INVARIANT(desc.type != TextureType::TEXTURE_3D, "pass '{}': '{}' is 3D", info.name, desc.name);
	RenderTarget target;
	target.texture = texture->id;
	target.range = resolve_range(desc, p_target.view);
	INVARIANT(target.range.mip_count == 1, "pass '{}': '{}' has {} mips: say which", info.name, desc.name, desc.mips);
	target.load = p_target.load;
	target.clear = p_target.clear;
	target.store = !p_target.read_only;
	uint32_t access = ACCESS_COLOR_READ | ACCESS_COLOR_WRITE;
	target.layout = TextureLayout::COLOR_TARGET;
	if (p_depth) {
		access = p_target.read_only ? ACCESS_DEPTH_READ : ACCESS_DEPTH_READ | ACCESS_DEPTH_WRITE;
		target.layout = p_target.read_only ? TextureLayout::DEPTH_READ : TextureLayout::DEPTH_TARGET;
	}
	impl.use(*texture, target.range, access, target.layout, p_target.load != LoadOp::LOAD);
	if (p_target.load == LoadOp::LOAD) {
		info.reads.push_back(desc.name);
	}
	if (!p_target.read_only) {
		info.writes.push_back(desc.name);
	}
	RenderTargets &targets = impl.scratch_targets;
	const glm::uvec2 size(desc.mip_size(target.range.first_mip));
	const bool fits = targets.size.x == 0 || (targets.size == size && targets.layer_count == target.range.layer_count);
	INVARIANT(fits, "pass '{}': '{}' differs in size or layers from the targets before it", info.name, desc.name);
	targets.size = size;
	targets.layer_count = target.range.layer_count;
	return target;
}

void RenderPassRecording::resolve_targets() {
	RenderTargets &targets = impl.scratch_targets;
	targets.color.clear();
	targets.depth = {};
	targets.size = glm::uvec2(0);
	for (const RenderPass::Target &target : pass.color_targets) {
		formats.colors[formats.color_count++] = impl.texture(target.view.texture).desc.format;
		targets.color.push_back(resolve_target(target, false));
	}
	if (pass.depth_target.view.texture.is_valid()) {
		formats.depth = impl.texture(pass.depth_target.view.texture).desc.format;
		targets.depth = resolve_target(pass.depth_target, true);
	}
	INVARIANT(targets.size.x != 0, "pass '{}' has no target", info.name);
	const glm::uvec4 &rect = pass.viewport_rect;
	targets.viewport = rect.z == 0 ? glm::uvec4(0, 0, targets.size.x, targets.size.y) : rect;
	const glm::uvec4 &used = targets.viewport;
	INVARIANT(used.x + used.z <= targets.size.x && used.y + used.w <= targets.size.y, "pass '{}': the viewport is beyond the {}x{} target", info.name, targets.size.x, targets.size.y);
}

void RenderPassRecording::collect_shaders(std::span<const DrawCommand> p_draws) {
	std::vector<const ShaderReflection *> &shaders = impl.scratch_shaders;
	shaders.clear();
	Shader last_vertex = Shader::NONE, last_fragment = Shader::NONE;
	for (const DrawCommand &command : p_draws) {
		if (command.state.vertex_shader == last_vertex && command.state.fragment_shader == last_fragment) {
			continue;
		}
		last_vertex = command.state.vertex_shader;
		last_fragment = command.state.fragment_shader;
		for (Shader shader : { last_vertex, last_fragment }) {
			const ShaderReflection *reflection = shader != Shader::NONE ? &impl.shaders.get(shader).reflection : nullptr;
			if (reflection != nullptr && std::find(shaders.begin(), shaders.end(), reflection) == shaders.end()) {
				shaders.push_back(reflection);
			}
		}
	}
}

void RenderPassRecording::use_material(BindingSetHandle p_material) {
	BindingSetResource &set = impl.binding_set(p_material);
	if (set.last_pass == impl.pass_serial + 1) {
		return; // this pass has it already; begin_pass counts it
	}
	set.last_pass = impl.pass_serial + 1;
	for (const SetBinding &binding : set.bindings) {
		if (binding.texture.is_valid()) {
			TextureResource *texture = impl.textures.get(binding.texture);
			INVARIANT(texture != nullptr, "pass '{}': binding set '{}' holds a texture that was freed", info.name, set.name);
			impl.use(*texture, texture->state.whole(), ACCESS_GRAPHICS_SAMPLE, shader_layout(texture->desc));
		} else {
			BufferResource *buffer = impl.buffers.get(binding.buffer);
			INVARIANT(buffer != nullptr, "pass '{}': binding set '{}' holds a buffer that was freed", info.name, set.name);
			impl.use(*buffer, binding.buffer_is_uniform ? ACCESS_GRAPHICS_UNIFORM : ACCESS_GRAPHICS_READ);
		}
	}
}

void RenderPassRecording::check_draw(const DrawCommand &p_command) {
	const DrawState &state = p_command.state;
	INVARIANT(!(pass.depth_target.read_only && state.depth_test && state.depth_write), "pass '{}': a draw writes the read-only depth", info.name);
	const ShaderReflection *shaders[2] = { &impl.shaders.get(state.vertex_shader).reflection, nullptr };
	size_t count = 1;
	if (state.fragment_shader != Shader::NONE) {
		shaders[count++] = &impl.shaders.get(state.fragment_shader).reflection;
	}
	const std::string wrong = check_constants(p_command.constants_size_bytes, { shaders, count });
	INVARIANT(wrong.empty(), "pass '{}', '{}': {}", info.name, impl.shaders.get(state.vertex_shader).name, wrong);
}

void RenderPassRecording::record_draws(std::span<const DrawCommand> p_draws) {
	RenderingDeviceDriver &driver = *impl.driver;
	const DriverSetLayout set0 = driver.set_layout(impl.scratch_kinds);
	const bool indexed = pass.index_buffer.is_valid();
	if (indexed) {
		driver.cmd_bind_indices(impl.buffer(pass.index_buffer).id);
	}
	const DrawCommand *previous = nullptr;
	DriverPipeline bound;
	DriverSet bound_set;
	for (const DrawCommand &command : p_draws) {
		const BindingSetResource *set = command.material.is_valid() ? &impl.binding_set(command.material) : nullptr;
		const DriverSetLayout set1 = set != nullptr ? set->layout : DriverSetLayout();
		const bool same_layout = previous != nullptr && (previous->material == command.material || (set != nullptr && previous->material.is_valid() && impl.binding_set(previous->material).layout == set1));
		const bool same_state = previous != nullptr && previous->state == command.state;
		if (!same_state || !same_layout) {
			const std::span<const DescriptorKind> kinds = set != nullptr ? std::span<const DescriptorKind>(set->kinds) : std::span<const DescriptorKind>();
			const DriverPipeline pipeline = impl.pipelines.find_graphics(command.state, formats, set0, set1, kinds);
			if (pipeline != bound) {
				driver.cmd_bind_pipeline(pipeline);
				bound = pipeline;
			}
		}
		if (!same_state || previous->constants_size_bytes != command.constants_size_bytes) {
			check_draw(command);
		}
		if (previous == nullptr && !impl.scratch_bindings.empty()) {
			driver.cmd_bind_transient(set0, impl.scratch_bindings);
		}
		if (set != nullptr && (set->id != bound_set || !same_layout)) {
			driver.cmd_bind_set(set->id);
			bound_set = set->id;
		}
		if (command.constants_size_bytes != 0) {
			driver.cmd_push_constants({ command.constants.data(), command.constants_size_bytes });
		}
		if (indexed) {
			driver.cmd_draw_indexed(command.first_index, command.index_count, command.vertex_offset, command.instance_count, command.first_instance);
		} else {
			driver.cmd_draw(command.first_index, command.index_count, command.instance_count, command.first_instance);
		}
		previous = &command;
	}
}

void RenderPass::draw(std::span<const DrawCommand> p_draws) {
	RenderingDevice::Impl &impl = *recorder.device.impl;
	RenderPassRecording recording = { *this, impl, {}, {} };
	recording.info.name = name;
	recording.collect_shaders(p_draws);
	recording.resolve_targets();
	resolve_bindings(impl, bindings, true, recording.info);
	for (const DrawCommand &command : p_draws) {
		if (command.material.is_valid()) {
			recording.use_material(command.material);
		}
	}
	if (index_buffer.is_valid()) {
		BufferResource &indices = impl.buffer(index_buffer);
		INVARIANT(indices.desc.usage & BUFFER_INDEX, "pass '{}': '{}' was made without BUFFER_INDEX", name, indices.desc.name);
		impl.use(indices, ACCESS_INDEX_READ);
		recording.info.reads.push_back(indices.desc.name);
	}
	impl.begin_pass(name);
	impl.driver->cmd_begin_rendering(impl.scratch_targets);
	recording.record_draws(p_draws);
	impl.driver->cmd_end_rendering();
	impl.end_pass(recorder, std::move(recording.info));
}

} // namespace lucent
