// SPDX-License-Identifier: MIT
#include "servers/rendering/device/pass_checks.h"

#include <algorithm>

namespace lucent {

namespace {

const char *kind_name(DescriptorKind p_kind) {
	constexpr const char *NAMES[] = { "nothing", "a sampled texture", "a storage image", "a storage buffer", "a uniform buffer", "a sampler", "a combined texture and sampler" };
	return NAMES[size_t(p_kind)];
}

const char *declared_name(PassBindingKind p_kind) {
	constexpr const char *NAMES[] = { "read(texture)", "write(texture)", "read_write(texture)", "read(buffer)", "write(buffer)", "read_write(buffer)", "uniform(buffer)", "sampler()" };
	return NAMES[size_t(p_kind)];
}

bool matches(PassBindingKind p_declared, const ReflectedBinding &p_reflected) {
	switch (p_declared) {
		case PassBindingKind::READ_TEXTURE:
			return p_reflected.kind == DescriptorKind::SAMPLED_TEXTURE || (p_reflected.kind == DescriptorKind::STORAGE_TEXTURE && !p_reflected.writable);
		case PassBindingKind::WRITE_TEXTURE:
		case PassBindingKind::READ_WRITE_TEXTURE:
			return p_reflected.kind == DescriptorKind::STORAGE_TEXTURE && p_reflected.writable;
		case PassBindingKind::READ_BUFFER:
			return p_reflected.kind == DescriptorKind::STORAGE_BUFFER && !p_reflected.writable;
		case PassBindingKind::WRITE_BUFFER:
		case PassBindingKind::READ_WRITE_BUFFER:
			return p_reflected.kind == DescriptorKind::STORAGE_BUFFER && p_reflected.writable;
		case PassBindingKind::UNIFORM_BUFFER:
			return p_reflected.kind == DescriptorKind::UNIFORM_BUFFER;
		case PassBindingKind::SAMPLER:
			return p_reflected.kind == DescriptorKind::SAMPLER;
	}
	return false;
}

} // namespace

const ReflectedBinding *find_reflected(uint32_t p_binding, std::span<const ShaderReflection *const> p_shaders) {
	for (const ShaderReflection *shader : p_shaders) {
		for (const ReflectedBinding &reflected : shader->bindings) {
			if (reflected.set == 0 && reflected.binding == p_binding) {
				return &reflected;
			}
		}
	}
	return nullptr;
}

std::string check_set0(std::span<const PassBinding> p_declared, std::span<const ShaderReflection *const> p_shaders) {
	for (size_t i = 0; i < p_declared.size(); i++) {
		const uint32_t binding = p_declared[i].binding;
		for (size_t j = 0; j < i; j++) {
			if (p_declared[j].binding == binding) {
				return fmt::format("binding {} is declared twice", binding);
			}
		}
		if (!p_shaders.empty() && find_reflected(binding, p_shaders) == nullptr) {
			return fmt::format("binding {} is declared, but no shader of the pass has it", binding);
		}
	}
	for (const ShaderReflection *shader : p_shaders) {
		for (const ReflectedBinding &reflected : shader->bindings) {
			if (reflected.set != 0) {
				continue;
			}
			const auto declared = std::find_if(p_declared.begin(), p_declared.end(), [&](const PassBinding &p_binding) { return p_binding.binding == reflected.binding; });
			if (declared == p_declared.end()) {
				return fmt::format("binding {}, '{}', {}, is not declared", reflected.binding, reflected.name, kind_name(reflected.kind));
			}
			if (!matches(declared->kind, reflected)) {
				const bool storage = reflected.kind == DescriptorKind::STORAGE_BUFFER || reflected.kind == DescriptorKind::STORAGE_TEXTURE;
				return fmt::format("binding {}, '{}', is {}{}, but declared as {}", reflected.binding, reflected.name, kind_name(reflected.kind), storage ? (reflected.writable ? " that is writable" : " that is readonly") : "", declared_name(declared->kind));
			}
			const ReflectedBinding *first = find_reflected(reflected.binding, p_shaders);
			if (first->kind != reflected.kind || first->shape != reflected.shape) {
				return fmt::format("binding {} is '{}' in one shader and '{}' in another, of another kind", reflected.binding, first->name, reflected.name);
			}
		}
	}
	return {};
}

std::string check_texture(const TextureDesc &p_desc, const TextureView &p_view, const ReflectedBinding &p_reflected) {
	const bool is_3d = p_desc.type == TextureType::TEXTURE_3D;
	const bool one_layer = p_view.layer != TextureView::ALL || p_desc.layer_count() == 1;
	bool fits = false;
	switch (p_reflected.shape) {
		case ViewShape::D2:
			fits = !is_3d && one_layer;
			break;
		case ViewShape::D2_ARRAY:
			fits = !is_3d;
			break;
		case ViewShape::D3:
			fits = is_3d;
			break;
		case ViewShape::CUBE:
			fits = p_desc.type == TextureType::TEXTURE_CUBE && p_view.layer == TextureView::ALL;
			break;
	}
	if (!fits) {
		constexpr const char *SHAPES[] = { "2D", "2D array", "3D", "cube" };
		return fmt::format("'{}' is {} in the shader, which '{}' ({} layers{}) is not", p_reflected.name, SHAPES[size_t(p_reflected.shape)], p_desc.name, p_desc.layer_count(), is_3d ? ", 3D" : "");
	}
	const bool storage = p_reflected.kind == DescriptorKind::STORAGE_TEXTURE;
	if (storage && p_reflected.storage_format != Format::UNDEFINED && p_reflected.storage_format != p_desc.format) {
		return fmt::format("'{}' is {} in the shader, but '{}' is {}", p_reflected.name, format_name(p_reflected.storage_format), p_desc.name, format_name(p_desc.format));
	}
	if ((p_reflected.sampled == SampledKind::UINT) != (format_kind(p_desc.format) == FormatKind::UINT)) {
		return fmt::format("'{}' and '{}' ({}) differ in being unsigned integers", p_reflected.name, p_desc.name, format_name(p_desc.format));
	}
	const uint32_t needed = storage ? TEXTURE_STORAGE : TEXTURE_SAMPLED;
	if ((p_desc.usage & needed) == 0) {
		return fmt::format("'{}' was made without TEXTURE_{}", p_desc.name, storage ? "STORAGE" : "SAMPLED");
	}
	if (storage && p_view.mip == TextureView::ALL && p_desc.mips > 1) {
		return fmt::format("'{}' has {} mips: say which one '{}' is", p_desc.name, p_desc.mips, p_reflected.name);
	}
	if ((p_view.mip != TextureView::ALL && p_view.mip >= p_desc.mips) || (p_view.layer != TextureView::ALL && p_view.layer >= p_desc.layer_count())) {
		return fmt::format("'{}' has {} mips and {} layers", p_desc.name, p_desc.mips, p_desc.layer_count());
	}
	return {};
}

std::string check_set1(std::span<const DescriptorKind> p_kinds, const ShaderReflection &p_shader) {
	for (const ReflectedBinding &reflected : p_shader.bindings) {
		if (reflected.set == 0) {
			continue;
		}
		if (reflected.set != 1) {
			return fmt::format("'{}' is in set {}; there are 0 and 1", reflected.name, reflected.set);
		}
		const DescriptorKind given = reflected.binding < p_kinds.size() ? p_kinds[reflected.binding] : DescriptorKind::NONE;
		if (given != reflected.kind) {
			return fmt::format("set 1, binding {}, '{}', is {}, but the draw's binding set has {}", reflected.binding, reflected.name, kind_name(reflected.kind), kind_name(given));
		}
		if (reflected.writable) {
			return fmt::format("set 1, binding {}, '{}', must be readonly", reflected.binding, reflected.name);
		}
	}
	return {};
}

std::string check_constants(uint32_t p_size_bytes, std::span<const ShaderReflection *const> p_shaders) {
	bool used = false;
	for (const ShaderReflection *shader : p_shaders) {
		if (shader->push_constants_size_bytes != 0 && shader->push_constants_size_bytes != p_size_bytes) {
			return fmt::format("the constants are {} bytes, the shader's block is {}", p_size_bytes, shader->push_constants_size_bytes);
		}
		used = used || shader->push_constants_size_bytes != 0;
	}
	if (p_size_bytes != 0 && !used) {
		return fmt::format("{} bytes of constants for shaders without a block", p_size_bytes);
	}
	return {};
}

} // namespace lucent
