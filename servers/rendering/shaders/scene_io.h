// SPDX-License-Identifier: MIT
// The scene as shaders see it: GpuScene (gpu_scene.h) fills these buffers. Shared by C++ and GLSL.
#ifndef SCENE_IO_H
#define SCENE_IO_H
#include "servers/rendering/device/shader_interop.h"

#define LIGHT_TYPE_DIRECTIONAL 0
#define LIGHT_TYPE_OMNI 1
#define LIGHT_TYPE_SPOT 2

#define LIGHT_FLAG_SHADOW 1 // casts shadows in the raster frame
#define LIGHT_FLAG_GI 2 // bake mode is not DISABLED; directional: sky mode is not SKY_ONLY

#define MATERIAL_FLAG_UNSHADED 1
#define MATERIAL_FLAG_VERTEX_COLOR 2
#define MATERIAL_FLAG_ALPHA_SCISSOR 4
#define MATERIAL_FLAG_ALPHA_BLEND 8
#define MATERIAL_FLAG_DOUBLE_SIDED 16 // cull disabled
#define MATERIAL_FLAG_CULL_FRONT 32
#define MATERIAL_FLAG_EMISSION_ADD 64 // emission + texture * emission_energy, else emission * texture

#define MATERIAL_SLOT_ALBEDO 0
#define MATERIAL_SLOT_NORMAL 1
#define MATERIAL_SLOT_METALLIC 2
#define MATERIAL_SLOT_ROUGHNESS 3
#define MATERIAL_SLOT_OCCLUSION 4
#define MATERIAL_SLOT_EMISSION 5
#define MATERIAL_SLOT_COUNT 6

#define INSTANCE_FLAG_MIRRORED 1 // negative determinant: front faces are clockwise

INTEROP_BEGIN
// Affine: world = (dot(row_x, (p, 1)), dot(row_y, …), dot(row_z, …)).
struct InstanceData {
	vec4 world_from_local[3];
	vec4 previous_world_from_local[3];
	uint flags;
	float transparency;
};
// Beside the positions buffer (vec3 a vertex, tightly packed).
struct VertexAttributes {
	vec3 normal;
	vec4 tangent; // w: handedness
	vec2 uv;
	vec2 uv2;
	uint color; // linear rgba8 unorm
};
// uv' = (dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z)
struct UvTransform {
	vec3 row0;
	vec3 row1;
};
struct MaterialData {
	vec4 albedo; // linear, alpha
	vec3 emission; // linear radiance
	float emission_energy;
	vec3 specular_tint;
	float specular;
	float metallic;
	float roughness;
	float normal_scale;
	float occlusion_strength;
	float alpha_scissor_threshold;
	uint flags;
	uint uv2_mask; // bit i: slot i reads the second uv set
	uint channels; // 4 bits a slot: TextureChannel of single-channel slots
	int gi_albedo_layer; // layer of GpuScene's gi_textures (small square copies, rgba8 sRGB-decoded on read), -1: none
	int gi_emission_layer;
	float gi_of_albedo; // what GI's bounces reflect: albedo * gi_of_albedo + gi_added (gi_reflectance.h)
	vec3 gi_added;
	UvTransform uv_transforms[MATERIAL_SLOT_COUNT];
};
// One drawn surface of one instance, as GI's voxelizer walks them: triangle t of all GI triangles belongs to the last surface with first_triangle <= t.
struct GiSurface {
	uint first_triangle; // running sum over the list
	uint world_triangle; // its first in the list of all surfaces
	uint first_index; // into the index buffer
	int vertex_offset; // added to each index
	uint instance;
	uint material;
};
struct LightData {
	vec3 position; // m; directional: unused
	float range; // m
	vec3 direction; // that the light shines along, unit
	float attenuation; // decay exponent
	vec3 color; // linear * energy; a Lambertian surface reflects albedo * color * cos * attenuation; negative for negative lights
	float indirect_energy;
	float specular; // multiplies the specular lobe
	float spot_cos; // cos(spot_angle)
	float spot_exponent; // of light_falloff_inc.glsl
	float angular_radius; // directional: radians
	float size; // positional: radius of the source, m
	float shadow_bias;
	float shadow_normal_bias;
	float shadow_opacity;
	uint type; // LIGHT_TYPE_*
	uint flags; // LIGHT_FLAG_*
	int shadow_index; // the renderer's, -1: none
};
INTEROP_END
INTEROP_SIZE(InstanceData, 104)
INTEROP_SIZE(VertexAttributes, 48)
INTEROP_SIZE(MaterialData, 248)
INTEROP_SIZE(GiSurface, 24)
INTEROP_SIZE(LightData, 92)
#endif
