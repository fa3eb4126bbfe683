// SPDX-License-Identifier: MIT
#pragma once

namespace lucent::scene {

// Every class of this module, and the core's. Calling it again does nothing.
void register_scene_classes();

} // namespace lucent::scene
