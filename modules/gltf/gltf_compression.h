// SPDX-License-Identifier: MIT
#pragma once
// EXT_meshopt_compression and KHR_draco_mesh_compression, through their libraries.

#include "modules/gltf/gltf_context.h"

#include <map>

namespace lucent {

// p_json: the extension's object of a buffer view.
std::vector<std::byte> decode_meshopt(GltfContext &r_context, const JsonView &p_json, std::span<const std::byte> p_bytes);

struct DracoAttribute {
	uint32_t components = 0;
	float integer_max = 0.0f; // of unsigned integers that are not normalised yet; 0: nothing is left to do
	std::vector<float> values; // vertex_count * components
};

struct DracoMesh {
	uint32_t vertex_count = 0;
	std::vector<uint32_t> indices; // 3 a triangle, all below vertex_count
	std::map<std::string, DracoAttribute> attributes; // by glTF semantic
};

// p_json: the extension's object of a primitive.
DracoMesh decode_draco(GltfContext &r_context, const JsonView &p_json, std::span<const std::byte> p_bytes);

} // namespace lucent
