// SPDX-License-Identifier: MIT
#pragma once

#include "servers/core/error.h"

#include <string>

namespace lucent::scene {

// The class's page in the XML that Godot's documentation has. Empty: no such class.
std::string class_xml(const std::string &p_class);
// One CLASS.xml a registered class, into p_directory, which is made if it is not there. The first file that cannot be written is an error.
Status write_class_xml(const std::string &p_directory);

} // namespace lucent::scene
