// SPDX-License-Identifier: MIT
#pragma once
// Normals and tangents that a file does not have.

#include "servers/rendering/render_scene.h"

namespace lucent {

// Makes every normal a unit vector. Missing and zero ones become the area-weighted normal of the triangles around the vertex.
void complete_normals(MeshSurface &r_surface);

// Unit tangents along +u of p_uvs (one a vertex), orthogonal to the normal, angle-weighted; w is such that cross(normal, tangent) * w
// points along -v, which is up in a glTF normal texture. A vertex between mirrored halves is split in two.
// After Lengyel, "Foundations of Game Engine Development 2", 7.5.
void make_tangents(MeshSurface &r_surface, bool p_second_uv_set);

} // namespace lucent
