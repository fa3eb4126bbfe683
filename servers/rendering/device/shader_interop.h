// SPDX-License-Identifier: MIT
// The bridge of *_io.h files, which C++ and GLSL both include: #define bindings, structs of uint/int/float/vecN/mat4,
// no bool, no padding members, layout(scalar) blocks in GLSL. tests/unit compares offsetof with the SPIR-V's offsets.
#ifndef SHADER_INTEROP_H
#define SHADER_INTEROP_H
#ifdef __cplusplus
#include "servers/core/math_types.h"
#include <cstdint>
#define INTEROP_BEGIN \
	namespace lucent::shader { \
	using glm::vec2; \
	using glm::vec3; \
	using glm::vec4; \
	using glm::ivec2; \
	using glm::ivec3; \
	using glm::ivec4; \
	using glm::uvec2; \
	using glm::uvec3; \
	using glm::uvec4; \
	using glm::mat4; \
	using uint = uint32_t;
#define INTEROP_END }
#define INTEROP_SIZE(m_type, m_bytes) static_assert(sizeof(lucent::shader::m_type) == m_bytes, #m_type " drifted from its GLSL layout");
#else
#extension GL_EXT_scalar_block_layout : require
#define INTEROP_BEGIN
#define INTEROP_END
#define INTEROP_SIZE(m_type, m_bytes)
#endif
#endif
