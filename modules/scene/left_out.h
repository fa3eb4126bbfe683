// SPDX-License-Identifier: MIT
#pragma once
// What Godot has and Lucent leaves out: the one list behind the loaders' warnings and the README's "What does not, yet".

#include <cstdint>
#include <span>
#include <string_view>

namespace lucent::scene {

enum class LeftOutEffect : uint8_t {
	NONE, // a picture is the same without it
	LOOK, // colours or light differ
	GEOMETRY, // something that should be seen is not there
};

struct LeftOutKind {
	const char *classes; // names with spaces between; "CSG*" and "*Joint3D" stand for all that begin or end so
	LeftOutEffect effect;
	bool spatial; // nodes of these classes have a place that their children build on
	const char *what; // for the README and warnings
};

std::span<const LeftOutKind> left_out_kinds();
// The first that names p_class; null: unknown to the list.
const LeftOutKind *find_left_out(std::string_view p_class);

// Whether a property that a supported class lacks says nothing about a picture.
bool is_property_without_effect(std::string_view p_class, std::string_view p_property);

} // namespace lucent::scene
