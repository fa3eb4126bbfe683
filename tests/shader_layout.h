// SPDX-License-Identifier: MIT
#pragma once
// Compares a struct of an *_io.h file with its layout in every embedded shader that uses it (at least one must):
//   TEST_CASE("shader layout: scene_io.h") { CHECK_SHADER_STRUCT(InstanceData, world_from_local, flags); }
// Name all members: a member of the shader's struct that is not named fails too.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lucent::test {

struct StructMember {
	std::string name;
	uint64_t offset_bytes;
};

// What differs, or nothing.
std::string shader_struct_difference(const std::string &p_struct, uint64_t p_size_bytes, const std::vector<StructMember> &p_members);

} // namespace lucent::test

// Applies SHADER_MEMBER to up to 64 names.
#define SHADER_PARENTHESES ()
#define SHADER_EXPAND(...) SHADER_EXPAND_2(SHADER_EXPAND_2(SHADER_EXPAND_2(SHADER_EXPAND_2(__VA_ARGS__))))
#define SHADER_EXPAND_2(...) SHADER_EXPAND_3(SHADER_EXPAND_3(SHADER_EXPAND_3(SHADER_EXPAND_3(__VA_ARGS__))))
#define SHADER_EXPAND_3(...) SHADER_EXPAND_4(SHADER_EXPAND_4(SHADER_EXPAND_4(SHADER_EXPAND_4(__VA_ARGS__))))
#define SHADER_EXPAND_4(...) __VA_ARGS__
#define SHADER_MEMBER(m_struct, m_member, ...) \
	{ #m_member, offsetof(lucent::shader::m_struct, m_member) }, \
			__VA_OPT__(SHADER_MEMBER_AGAIN SHADER_PARENTHESES(m_struct, __VA_ARGS__))
#define SHADER_MEMBER_AGAIN() SHADER_MEMBER

#define CHECK_SHADER_STRUCT(m_struct, ...) \
	CHECK(::lucent::test::shader_struct_difference(#m_struct, sizeof(lucent::shader::m_struct), { SHADER_EXPAND(SHADER_MEMBER(m_struct, __VA_ARGS__)) }) == "")
