// SPDX-License-Identifier: MIT
// What a surface's vertex shader hands to its fragment shaders. VARYING is in or out.
layout(location = 0) VARYING vec3 v_position; // world, m
layout(location = 1) VARYING vec3 v_normal;
layout(location = 2) VARYING vec4 v_tangent;
layout(location = 3) VARYING vec4 v_uvs;
layout(location = 4) VARYING vec4 v_color;
layout(location = 5) VARYING float v_opacity;
