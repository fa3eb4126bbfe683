// SPDX-License-Identifier: MIT
#pragma once
// What a SPIR-V module declares, by SPIRV-Cross: bindings, push constants, work group, struct layouts.

#include "servers/rendering/device/rendering_device_driver.h"

#include <array>
#include <map>

namespace lucent {

enum class ShaderStage : uint8_t {
	COMPUTE,
	VERTEX,
	FRAGMENT
};
enum class SampledKind : uint8_t {
	FLOAT,
	UINT,
	INT
};

struct ReflectedBinding {
	uint32_t set = 0;
	uint32_t binding = 0;
	DescriptorKind kind = DescriptorKind::NONE;
	bool writable = false; // storage: not `readonly`
	ViewShape shape = ViewShape::D2; // textures
	SampledKind sampled = SampledKind::FLOAT; // textures
	Format storage_format = Format::UNDEFINED; // storage textures; UNDEFINED: declared without a format
	std::string name;
};

struct ShaderReflection {
	ShaderStage stage = ShaderStage::COMPUTE;
	std::vector<ReflectedBinding> bindings; // by set, then by binding
	uint32_t push_constants_size_bytes = 0;
	std::array<uint32_t, 3> local_size{ 1, 1, 1 };
	std::array<uint32_t, 3> local_size_constant_id{ UINT32_MAX, UINT32_MAX, UINT32_MAX }; // UINT32_MAX: not specialised
	std::vector<uint32_t> specialization_ids;
};

Result<ShaderReflection> reflect_shader(std::span<const uint32_t> p_spirv);

struct StructLayout {
	uint64_t size_bytes = 0; // end of the last member
	uint64_t array_stride_bytes = 0; // where it is a member's element; 0: nowhere
	std::map<std::string, uint64_t> member_offsets;
	bool operator==(const StructLayout &) const = default;
};

// Every struct with offsets that the module's buffers and push constants reach, by its GLSL name; several where the
// module lays it out in several ways.
Result<std::multimap<std::string, StructLayout>> reflect_structs(std::span<const uint32_t> p_spirv);

} // namespace lucent
