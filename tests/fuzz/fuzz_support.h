// SPDX-License-Identifier: MIT
#pragma once
// What the libFuzzer targets share. doc/testing.md says how to run them.

#include "modules/scene/image_loader.h"
#include "modules/scene/packed_scene.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/scene_tree.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace lucent::test {

// Warnings of broken files are what is expected: they go nowhere. Files that an input names are read as pictures only.
inline bool prepare_fuzzing() {
	set_log_handler([](LogLevel, std::string_view) {});
	scene::register_scene_classes();
	scene::register_image_loaders();
	return true;
}

// All the way to the server's data, as `lucent render` goes before it draws.
inline void show_scene(const scene::PackedScene &p_scene) {
	RenderingServer server(nullptr);
	scene::SceneTree tree(&server);
	Result<std::unique_ptr<scene::Node>> root = p_scene.instantiate();
	if (root) {
		tree.set_current_scene(root.take());
		tree.process(1.0 / 60.0);
	}
}

} // namespace lucent::test
