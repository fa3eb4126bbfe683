// SPDX-License-Identifier: MIT
#pragma once
// --set 'Node/Path:property:sub=value'.

#include "servers/core/error.h"

#include <string>

namespace lucent {

namespace scene {
class Node;
}

// The node of that path below p_root, p_root itself by its name, or the only node of that name anywhere. Error: with a suggestion.
Result<scene::Node *> find_node(scene::Node &p_root, const std::string &p_path);

// p_setting: 'WorldEnvironment:environment:sdfgi_enabled=false', 'Lamp:light_color:r=0.5'. The value is written as in a .tscn.
Status apply_setting(scene::Node &p_root, const std::string &p_setting);

} // namespace lucent
