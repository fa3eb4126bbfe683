// SPDX-License-Identifier: MIT
#pragma once
// Properties of nodes and of what they refer to, by path: "WorldEnvironment:environment:sky:sky_material:sky_curve",
// "Lamp:position:x". What --set and animation tracks say.

#include "modules/scene/node.h"

namespace lucent::scene {

// The names are looked up from p_root; if p_root has no such child but is itself called as the first one, from its parent.
Status set_property_by_path(Node &p_root, const NodePath &p_path, const Variant &p_value);
Result<Variant> get_property_by_path(Node &p_root, const NodePath &p_path);

} // namespace lucent::scene
