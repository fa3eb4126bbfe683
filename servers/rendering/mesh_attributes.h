// SPDX-License-Identifier: MIT
#pragma once
// A surface's attributes as shaders read them; what the mesh lacks is generated.

#include "servers/rendering/render_scene.h"
#include "servers/rendering/shaders/scene_io.h"

#include <vector>

namespace lucent {

// Missing normals: averaged over the triangles at each vertex, weighted by area. Missing tangents: averaged directions of
// growing u, orthogonal to the normal; any direction without uvs.
std::vector<shader::VertexAttributes> make_vertex_attributes(const MeshSurface &p_surface);

} // namespace lucent
