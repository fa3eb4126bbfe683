// SPDX-License-Identifier: MIT
#include "modules/tscn/text_loader.h"

#include <filesystem>

namespace lucent {

namespace fs = std::filesystem;

std::string absolute_path(const std::string &p_path) {
	std::error_code error;
	return fs::absolute(p_path, error).lexically_normal().string();
}

std::string project_folder(const std::string &p_from, const std::string &p_scene_folder) {
	std::error_code error;
	for (fs::path up = fs::absolute(p_from, error).parent_path();; up = up.parent_path()) {
		if (fs::is_regular_file(up / "project.godot", error)) {
			return up.string();
		}
		if (up == up.parent_path()) {
			return fs::absolute(p_scene_folder, error).lexically_normal().string();
		}
	}
}

std::string resolve_resource_path(const std::string &p_path, const std::string &p_from, const std::string &p_scene_folder) {
	std::error_code error;
	const bool from_project = p_path.starts_with("res://");
	const fs::path folder = from_project ? fs::path(project_folder(p_from, p_scene_folder)) : fs::absolute(p_from, error).parent_path();
	return (folder / p_path.substr(from_project ? 6 : 0)).lexically_normal().string(); // an absolute p_path replaces the folder
}

} // namespace lucent
