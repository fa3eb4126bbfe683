// SPDX-License-Identifier: MIT
#include "servers/rendering/device/pass_bindings.h"

#include "servers/rendering/device/pass_checks.h"

#include <algorithm>

namespace lucent {

namespace {

uint32_t access_of(PassBindingKind p_kind, bool p_graphics, bool p_sampled) {
	switch (p_kind) {
		case PassBindingKind::READ_TEXTURE:
			if (p_sampled) {
				return p_graphics ? ACCESS_GRAPHICS_SAMPLE : ACCESS_COMPUTE_SAMPLE;
			}
			return p_graphics ? ACCESS_GRAPHICS_READ : ACCESS_COMPUTE_READ;
		case PassBindingKind::READ_BUFFER:
			return p_graphics ? ACCESS_GRAPHICS_READ : ACCESS_COMPUTE_READ;
		case PassBindingKind::WRITE_TEXTURE:
		case PassBindingKind::WRITE_BUFFER:
			return ACCESS_COMPUTE_WRITE;
		case PassBindingKind::READ_WRITE_TEXTURE:
		case PassBindingKind::READ_WRITE_BUFFER:
			return ACCESS_COMPUTE_READ | ACCESS_COMPUTE_WRITE;
		case PassBindingKind::UNIFORM_BUFFER:
			return p_graphics ? ACCESS_GRAPHICS_UNIFORM : ACCESS_COMPUTE_UNIFORM;
		case PassBindingKind::SAMPLER:
			break;
	}
	return 0;
}

} // namespace

void resolve_bindings(RenderingDevice::Impl &r_impl, std::span<const PassBinding> p_bindings, bool p_graphics, PassInfo &r_info) {
	const std::vector<const ShaderReflection *> &shaders = r_impl.scratch_shaders;
	const std::string wrong = check_set0(p_bindings, shaders);
	INVARIANT(wrong.empty(), "pass '{}': {}", r_info.name, wrong);
	r_impl.scratch_bindings.clear();
	r_impl.scratch_kinds.clear();
	for (const PassBinding &declared : p_bindings) {
		const ReflectedBinding *reflected = find_reflected(declared.binding, shaders);
		if (reflected == nullptr) {
			continue; // a render pass without draws
		}
		DriverBinding &binding = r_impl.scratch_bindings.emplace_back();
		binding.binding = declared.binding;
		binding.kind = reflected->kind;
		r_impl.scratch_kinds.resize(std::max(r_impl.scratch_kinds.size(), size_t(declared.binding) + 1), DescriptorKind::NONE);
		r_impl.scratch_kinds[declared.binding] = reflected->kind;
		const uint32_t access = access_of(declared.kind, p_graphics, reflected->kind == DescriptorKind::SAMPLED_TEXTURE);
		const std::string *name = nullptr;
		if (declared.kind == PassBindingKind::SAMPLER) {
			const auto *sampler = r_impl.samplers.get(declared.sampler);
			INVARIANT(sampler != nullptr, "pass '{}': binding {} has no sampler", r_info.name, declared.binding);
			binding.sampler = sampler->second;
			continue;
		}
		if (declared.kind <= PassBindingKind::READ_WRITE_TEXTURE) {
			TextureResource *texture = r_impl.textures.get(declared.view.texture);
			INVARIANT(texture != nullptr, "pass '{}': the texture for '{}' is null or was freed", r_info.name, reflected->name);
			const std::string unfit = check_texture(texture->desc, declared.view, *reflected);
			INVARIANT(unfit.empty(), "pass '{}': {}", r_info.name, unfit);
			binding.texture = texture->id;
			binding.range = resolve_range(texture->desc, declared.view);
			binding.shape = reflected->shape;
			binding.layout = reflected->kind == DescriptorKind::STORAGE_TEXTURE ? TextureLayout::GENERAL : shader_layout(texture->desc);
			r_impl.use(*texture, binding.range, access, binding.layout);
			name = &texture->desc.name;
		} else {
			BufferResource *buffer = r_impl.buffers.get(declared.buffer);
			INVARIANT(buffer != nullptr, "pass '{}': the buffer for '{}' is null or was freed", r_info.name, reflected->name);
			const uint32_t needed = declared.kind == PassBindingKind::UNIFORM_BUFFER ? BUFFER_UNIFORM : BUFFER_STORAGE;
			INVARIANT(buffer->desc.usage & needed, "pass '{}': '{}' was made without BUFFER_{}", r_info.name, buffer->desc.name, needed == BUFFER_UNIFORM ? "UNIFORM" : "STORAGE");
			binding.buffer = buffer->id;
			r_impl.use(*buffer, access);
			name = &buffer->desc.name;
		}
		const bool writes = (access & ACCESS_ALL_WRITES) != 0;
		const bool reads = declared.kind != PassBindingKind::WRITE_TEXTURE && declared.kind != PassBindingKind::WRITE_BUFFER;
		if (reads) {
			r_info.reads.push_back(*name);
		}
		if (writes) {
			r_info.writes.push_back(*name);
		}
	}
}

} // namespace lucent
