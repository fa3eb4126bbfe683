// SPDX-License-Identifier: MIT
#pragma once

#include "servers/core/object.h"

#include <string>

namespace lucent {

// A node's script in Godot's language, which isn't run: kept to say what is lost. p_path names the file.
Ref<Resource> make_gd_script(const std::string &p_path);
// "scripts are not run: 'Lamp' loses _process and _ready of lamp.gd; lucent.attach() in Python replaces them".
std::string gd_script_notice(const Object &p_owner, const Resource *p_script);

} // namespace lucent
