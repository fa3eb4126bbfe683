// SPDX-License-Identifier: MIT
#pragma once
// What a pass declares against what its shaders declare. Each function returns a sentence about the first mistake, or nothing.

#include "servers/rendering/device/pass_recorder.h"
#include "servers/rendering/device/shader_reflection.h"

namespace lucent {

// Missing, surplus, double, wrong kind, wrong direction; descriptors of set 0.
std::string check_set0(std::span<const PassBinding> p_declared, std::span<const ShaderReflection *const> p_shaders);
// One declared texture: shape, storage format, sampled type.
std::string check_texture(const TextureDesc &p_desc, const TextureView &p_view, const ReflectedBinding &p_reflected);
std::string check_set1(std::span<const DescriptorKind> p_kinds, const ShaderReflection &p_shader);
std::string check_constants(uint32_t p_size_bytes, std::span<const ShaderReflection *const> p_shaders);

// The first shader's declaration of a binding of set 0, or null.
const ReflectedBinding *find_reflected(uint32_t p_binding, std::span<const ShaderReflection *const> p_shaders);

} // namespace lucent
