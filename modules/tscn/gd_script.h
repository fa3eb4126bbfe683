// SPDX-License-Identifier: MIT
#pragma once

#include "servers/core/object.h"

#include <string>

namespace lucent {

// A script of Godot's, which isn't run: kept to say what is lost. p_path names the file; "": it is part of a scene.
Ref<Resource> make_gd_script(const std::string &p_path);
// Whether a resource's type or its file's extension is that of a script.
bool is_gd_script(const std::string &p_type, const std::string &p_path);
// "scripts are not run: 'Lamp' loses _process and _ready of lamp.gd; lucent.attach() in Python replaces them".
std::string gd_script_notice(const Object &p_owner, const Resource &p_script);

} // namespace lucent
