// SPDX-License-Identifier: MIT
#pragma once
// Godot's NodePath: node names separated by '/', then property names, each after a ':'. "../Sun:light_color:r".

#include <string>
#include <vector>

namespace lucent {

struct NodePath {
	std::string text;

	NodePath() = default;
	explicit NodePath(std::string p_text) :
			text(std::move(p_text)) {}

	bool is_empty() const { return text.empty(); }
	bool is_absolute() const { return !text.empty() && text[0] == '/'; }
	// "", "." and empty names are left out; ".." stays.
	std::vector<std::string> get_names() const;
	std::vector<std::string> get_subnames() const;
	bool operator==(const NodePath &) const = default;
};

} // namespace lucent
