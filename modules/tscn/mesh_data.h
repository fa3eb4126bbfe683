// SPDX-License-Identifier: MIT
#pragma once
// Meshes embedded in text scenes and resources: ArrayMesh's _surfaces.

#include "modules/scene/mesh.h"
#include "servers/core/variant.h"

namespace lucent {

// One entry of _surfaces: the buffers that Godot 4 gives its renderer, little-endian; layout after RenderingServer's ArrayFormat
// documentation and Godot's vertex shader (scene_forward_clustered.glsl, _unpack_vertex_attributes). Triangles are turned round:
// Godot's front is clockwise. Bones, blend shapes, custom channels and levels of detail are not read. Error: what does not fit.
Result<MeshSurface> decode_mesh_surface(const Dictionary &p_surface);

// Adds every surface of p_surfaces to r_mesh. Those that can't be read are left out with a warning, which names p_source and p_line.
void add_mesh_surfaces(scene::ArrayMesh &r_mesh, const Variant &p_surfaces, const std::string &p_source, int p_line);

} // namespace lucent
