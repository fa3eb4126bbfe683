// SPDX-License-Identifier: MIT
#pragma once
// A glTF document as nodes and resources of modules/scene.

#include "modules/gltf/gltf_tree.h"
#include "modules/scene/packed_scene.h"

namespace lucent {

// Every copy made from the result shares meshes, materials and textures. Nodes are as Godot's importer makes them (gltf_tree.h):
// characters that names do not have become "_", and a name that was given gets a number ("Lamp", "Lamp2"). The root is named after
// the scene, else p_name. p_scene: index in scenes; -1: the default one. A surface without a material has none: Godot's default shows.
Result<Ref<scene::PackedScene>> gltf_to_scene(GltfDocument p_document, const std::string &p_name, int32_t p_scene = -1, const GltfImportSettings &p_settings = {});

// Reads the file and logs its warnings.
Result<Ref<scene::PackedScene>> load_gltf_scene(const std::string &p_path, int32_t p_scene = -1);

// ResourceLoader reads .gltf and .glb as PackedScenes from now on.
void register_gltf_loaders();

} // namespace lucent
