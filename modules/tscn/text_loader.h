// SPDX-License-Identifier: MIT
#pragma once
// Godot's text scenes (.tscn) and resources (.tres), format 3.

#include "modules/scene/resource_loader.h"

#include <string>
#include <string_view>

namespace lucent {

// Makes ResourceLoader read .tscn and .tres.
void register_tscn_loaders();

// A .tscn becomes a PackedScene, a .tres the resource that it describes. p_path names the text in messages and is where res:// and
// relative paths start from.
Result<Ref<Resource>> load_text_resource(std::string_view p_text, const std::string &p_path);

// p_path without "." and "..", from the root of the file system.
std::string absolute_path(const std::string &p_path);

// Where res:// of the file p_from starts: the nearest folder upwards that has a project.godot, else p_scene_folder.
std::string project_folder(const std::string &p_from, const std::string &p_scene_folder);

// "res://a/b.png", "b.png" or "/x/b.png" as seen from the file p_from.
std::string resolve_resource_path(const std::string &p_path, const std::string &p_from, const std::string &p_scene_folder);

} // namespace lucent
