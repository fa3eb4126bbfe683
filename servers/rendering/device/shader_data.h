// SPDX-License-Identifier: MIT
#pragma once
// The embedded SPIR-V, written by servers/rendering/shaders/SCsub. Indexed by Shader; ends with an empty entry.

#include <cstdint>

namespace lucent {

struct ShaderData {
	const char *name; // "trace_probes", "opaque_vert"
	const char *source_path; // from the repository's root
	const uint32_t *spirv;
	uint32_t word_count;
};
extern const ShaderData SHADER_DATA[];

} // namespace lucent
