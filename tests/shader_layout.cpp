// SPDX-License-Identifier: MIT
#include "tests/shader_layout.h"

#include "servers/rendering/device/shader_data.h"
#include "servers/rendering/device/shader_reflection.h"

namespace lucent::test {

std::string shader_struct_difference(const std::string &p_struct, uint64_t p_size_bytes, const std::vector<StructMember> &p_members) {
	std::map<std::string, uint64_t> expected;
	for (const StructMember &member : p_members) {
		expected[member.name] = member.offset_bytes;
	}
	bool found = false;
	for (const ShaderData *data = SHADER_DATA; data->spirv != nullptr; data++) {
		const auto structs = reflect_structs({ data->spirv, data->word_count });
		if (!structs) {
			return fmt::format("{}: {}", data->source_path, structs.error().message);
		}
		const auto [begin, end] = structs.value().equal_range(p_struct);
		for (auto entry = begin; entry != end; ++entry) {
			found = true;
			const StructLayout &layout = entry->second;
			for (const auto &[name, offset] : layout.member_offsets) {
				if (!expected.contains(name) || expected[name] != offset) {
					return fmt::format("{}: {}.{} is at byte {}", data->source_path, p_struct, name, offset);
				}
			}
			const bool stride_differs = layout.array_stride_bytes != 0 && layout.array_stride_bytes != p_size_bytes;
			if (layout.member_offsets.size() != expected.size() || layout.size_bytes != p_size_bytes || stride_differs) {
				return fmt::format("{}: {} has {} members, {} bytes, stride {}", data->source_path, p_struct, layout.member_offsets.size(), layout.size_bytes, layout.array_stride_bytes);
			}
		}
	}
	return found ? "" : fmt::format("no shader uses {}", p_struct);
}

} // namespace lucent::test
