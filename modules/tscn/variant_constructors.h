// SPDX-License-Identifier: MIT
#pragma once
// The types that Godot's text form writes as a name and numbers.

#include "servers/core/variant.h"

#include <span>
#include <string_view>

namespace lucent {

using Numbers = std::span<const double>;

struct NumberConstructor {
	const char *name;
	size_t count; // of all numbers; of a packed array: of each element
	Variant (*make)(Numbers p_n);
};

// Null: no such type.
const NumberConstructor *find_number_constructor(std::string_view p_type); // "Vector3"
const NumberConstructor *find_packed_constructor(std::string_view p_type); // "PackedVector3Array"

} // namespace lucent
