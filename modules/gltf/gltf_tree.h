// SPDX-License-Identifier: MIT
#pragma once
// A glTF document's nodes as Godot 4's importer makes them: names, types, order, skeletons, and what suffixes of names ask for.

#include "modules/gltf/gltf_document.h"
#include "modules/scene/mesh.h"
#include "modules/scene/node_3d.h"

namespace lucent {

// What copies of a scene share.
struct GltfResources {
	std::vector<Ref<scene::Texture2D>> textures; // by image
	std::vector<Ref<scene::Material>> materials;
	std::vector<Ref<scene::ArrayMesh>> meshes;
};

// The part of a .import file that changes the tree.
struct GltfImportSettings {
	std::string root_name; // empty: the scene's
	float root_scale = 1.0f;
	bool use_name_suffixes = true; // -noimp
	bool use_node_type_suffixes = true; // -col, -navmesh, …
	int naming_version = 2; // below 2 the scene's name is taken from the nodes' names
};

// Defaults where p_path has no .import file beside it.
GltfImportSettings load_gltf_import_settings(const std::string &p_path);

// p_fallback_name: the file's, for a scene without a name.
std::unique_ptr<scene::Node> build_gltf_tree(const GltfDocument &p_document, const GltfResources &p_resources, const GltfSceneRoots &p_scene, const std::string &p_fallback_name, const GltfImportSettings &p_settings);

// Whether p_name ends in -HINT, _HINT or has $HINT, with digits and "_" after it left out; in any case. As Godot's importer.
bool has_name_hint(const std::string &p_name, const std::string &p_hint);
std::string without_name_hint(const std::string &p_name, const std::string &p_hint);

} // namespace lucent
