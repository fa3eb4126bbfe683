// SPDX-License-Identifier: MIT
#include "servers/rendering/device/pass_bindings.h"
#include "servers/rendering/device/pass_checks.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr uint32_t MAX_GROUPS = 65535; // per axis: the least that Vulkan allows

} // namespace

ComputePass::ComputePass(PassRecorder &p_recorder, std::string p_name, Shader p_shader) :
		recorder(p_recorder), name(std::move(p_name)), shader(p_shader) {
	bindings.reserve(12);
}

ComputePass &ComputePass::read(uint32_t p_binding, TextureView p_view) {
	bindings.push_back({ p_binding, PassBindingKind::READ_TEXTURE, p_view, {}, {} });
	return *this;
}

ComputePass &ComputePass::read(uint32_t p_binding, BufferHandle p_buffer) {
	bindings.push_back({ p_binding, PassBindingKind::READ_BUFFER, {}, p_buffer, {} });
	return *this;
}

ComputePass &ComputePass::write(uint32_t p_binding, TextureView p_view) {
	bindings.push_back({ p_binding, PassBindingKind::WRITE_TEXTURE, p_view, {}, {} });
	return *this;
}

ComputePass &ComputePass::write(uint32_t p_binding, BufferHandle p_buffer) {
	bindings.push_back({ p_binding, PassBindingKind::WRITE_BUFFER, {}, p_buffer, {} });
	return *this;
}

ComputePass &ComputePass::read_write(uint32_t p_binding, TextureView p_view) {
	bindings.push_back({ p_binding, PassBindingKind::READ_WRITE_TEXTURE, p_view, {}, {} });
	return *this;
}

ComputePass &ComputePass::read_write(uint32_t p_binding, BufferHandle p_buffer) {
	bindings.push_back({ p_binding, PassBindingKind::READ_WRITE_BUFFER, {}, p_buffer, {} });
	return *this;
}

ComputePass &ComputePass::uniform(uint32_t p_binding, BufferHandle p_buffer) {
	bindings.push_back({ p_binding, PassBindingKind::UNIFORM_BUFFER, {}, p_buffer, {} });
	return *this;
}

ComputePass &ComputePass::sampler(uint32_t p_binding, SamplerHandle p_sampler) {
	bindings.push_back({ p_binding, PassBindingKind::SAMPLER, {}, {}, p_sampler });
	return *this;
}

ComputePass &ComputePass::specialize(uint32_t p_constant_id, uint32_t p_value) {
	specialization.push_back({ p_constant_id, p_value });
	return *this;
}

void ComputePass::dispatch_threads(uint32_t p_x, uint32_t p_y, uint32_t p_z) {
	const ShaderReflection &reflection = recorder.device.impl->shaders.get(shader).reflection;
	std::array<uint32_t, 3> groups = { p_x, p_y, p_z };
	for (size_t axis = 0; axis < 3; axis++) {
		uint32_t local = reflection.local_size[axis];
		for (const auto &[id, value] : specialization) {
			local = id == reflection.local_size_constant_id[axis] ? value : local;
		}
		groups[axis] = (groups[axis] + local - 1) / local;
	}
	dispatch_groups(groups[0], groups[1], groups[2]);
}

void ComputePass::dispatch_groups(uint32_t p_x, uint32_t p_y, uint32_t p_z) {
	INVARIANT(std::max({ p_x, p_y, p_z }) <= MAX_GROUPS, "pass '{}': {}x{}x{} groups; at most {} an axis", name, p_x, p_y, p_z, MAX_GROUPS);
	record([&](RenderingDeviceDriver &r_driver) { r_driver.cmd_dispatch(p_x, p_y, p_z); }, {});
}

void ComputePass::dispatch_indirect(BufferHandle p_arguments, uint64_t p_offset_bytes) {
	const BufferResource &arguments = recorder.device.impl->buffer(p_arguments);
	INVARIANT(arguments.desc.usage & BUFFER_INDIRECT, "pass '{}': '{}' was made without BUFFER_INDIRECT", name, arguments.desc.name);
	INVARIANT(p_offset_bytes % 4 == 0 && p_offset_bytes + 12 <= arguments.desc.size_bytes, "pass '{}': no arguments at byte {} of '{}'", name, p_offset_bytes, arguments.desc.name);
	const DriverBuffer id = arguments.id;
	record([&](RenderingDeviceDriver &r_driver) { r_driver.cmd_dispatch_indirect(id, p_offset_bytes); }, p_arguments);
}

template <typename Dispatch>
void ComputePass::record(Dispatch &&p_dispatch, BufferHandle p_arguments) {
	RenderingDevice::Impl &impl = *recorder.device.impl;
	const LoadedShader &loaded = impl.shaders.get(shader);
	const ComputePipeline &pipeline = impl.pipelines.find_compute(shader, specialization);
	PassInfo info = { std::move(name), loaded.name, {}, {} };
	impl.scratch_shaders.assign(1, &loaded.reflection);
	const std::string wrong = check_constants(push_constants_size_bytes, impl.scratch_shaders);
	INVARIANT(wrong.empty(), "pass '{}': {}", info.name, wrong);
	resolve_bindings(impl, bindings, false, info);
	if (p_arguments.is_valid()) {
		BufferResource &arguments = impl.buffer(p_arguments);
		impl.use(arguments, ACCESS_INDIRECT_READ);
		info.reads.push_back(arguments.desc.name);
	}
	impl.begin_pass(info.name);
	impl.driver->cmd_bind_pipeline(pipeline.pipeline);
	if (!impl.scratch_bindings.empty()) {
		impl.driver->cmd_bind_transient(pipeline.set_layout, impl.scratch_bindings);
	}
	if (push_constants_size_bytes != 0) {
		impl.driver->cmd_push_constants({ push_constants.data(), push_constants_size_bytes });
	}
	p_dispatch(*impl.driver);
	impl.end_pass(recorder, std::move(info));
}

} // namespace lucent
