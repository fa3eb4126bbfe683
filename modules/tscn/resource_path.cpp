// SPDX-License-Identifier: MIT
#include "modules/tscn/text_loader.h"

#include <filesystem>

namespace lucent {

namespace fs = std::filesystem;

std::string absolute_path(const std::string &p_path) {
	std::error_code error;
	return fs::absolute(p_path, error).lexically_normal().string();
}

std::string resolve_resource_path(const std::string &p_path, const std::string &p_from, const std::string &p_scene_folder) {
	std::error_code error;
	const fs::path folder = fs::absolute(p_from, error).parent_path();
	if (!p_path.starts_with("res://")) {
		return (folder / p_path).lexically_normal().string(); // an absolute p_path replaces the folder
	}
	const std::string rest = p_path.substr(6);
	for (fs::path up = folder;; up = up.parent_path()) {
		if (fs::is_regular_file(up / "project.godot", error)) {
			return (up / rest).lexically_normal().string();
		}
		if (up == up.parent_path()) {
			break;
		}
	}
	return (fs::absolute(p_scene_folder, error) / rest).lexically_normal().string();
}

} // namespace lucent
