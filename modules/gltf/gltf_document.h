// SPDX-License-Identifier: MIT
#pragma once
// glTF 2.0 as plain, checked data: every index in here is in range, every position finite, the hierarchy is a forest. Skins and
// morph targets are applied in the pose that the file stands in; animations are not played. Specification: Khronos glTF 2.0.

#include "servers/core/error.h"
#include "servers/core/image.h"
#include "servers/core/math_types.h"
#include "servers/rendering/render_scene.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lucent {

struct GltfImage {
	std::string name;
	std::shared_ptr<const Image> image; // null: no material uses it, or it could not be read (a warning says so)
};

struct GltfTextureRef {
	int32_t image = -1; // in images; -1: none. images[image].image is never null
	uint8_t uv_set = 0; // 0 or 1
	TextureWrap wrap_u = TextureWrap::REPEAT;
	TextureWrap wrap_v = TextureWrap::REPEAT;
	TextureFilter filter = TextureFilter::LINEAR_MIPMAPS;
	// KHR_texture_transform: uv' = rotate(uv * scale) + offset
	Vector2 uv_offset{ 0.0f };
	Vector2 uv_scale{ 1.0f };
	float uv_rotation = 0.0f; // radians
};

// Factors are linear and in Godot's terms: see lucent::Material.
struct GltfMaterial {
	std::string name;
	Vector4 base_color{ 1.0f };
	float metallic = 1.0f;
	float roughness = 1.0f;
	float specular = 0.5f; // f0 = 0.16 * specular^2, from KHR_materials_specular and _ior
	Vector3 specular_tint{ 1.0f };
	Vector3 emission{ 0.0f }; // radiance, emissive strength multiplied in; multiplies its texture
	float normal_scale = 1.0f;
	float occlusion_strength = 1.0f;
	TransparencyMode transparency = TransparencyMode::OPAQUE;
	float alpha_cutoff = 0.5f;
	bool double_sided = false;
	bool unlit = false;
	bool uses_vertex_colors = false; // a primitive with COLOR_0 has this material
	GltfTextureRef base_color_texture; // sRGB, alpha
	GltfTextureRef metallic_roughness_texture; // roughness in G, metallic in B
	GltfTextureRef normal_texture;
	GltfTextureRef occlusion_texture; // R
	GltfTextureRef emission_texture; // sRGB
};

struct GltfPrimitive {
	MeshSurface surface; // normals are always there; tangents where the material has a normal texture. surface.material is unset
	int32_t material = -1; // in materials; -1: the viewer's default
};

struct GltfMesh {
	std::string name;
	std::vector<GltfPrimitive> primitives; // may be empty: points and lines are left out
};

struct GltfLight {
	std::string name;
	Light light; // linear colour; energy in Godot's pi convention
};

struct GltfCamera {
	std::string name;
	Camera camera; // transform unset
};

struct GltfNode {
	std::string name; // as in the file; may be empty or shared by siblings
	Transform3D transform; // to the parent
	int32_t parent = -1;
	std::vector<int32_t> children;
	int32_t mesh = -1;
	int32_t light = -1;
	int32_t camera = -1;
	int32_t skeleton = -1; // in skeletons: the node is a bone of it
	int32_t bone = -1; // its place in that skeleton's bones
	int32_t skin_skeleton = -1; // the node's mesh is posed by this skeleton and stands in its space, not in the node's
};

// The joints of skins that hang together, and the nodes between them.
struct GltfSkeleton {
	std::vector<int32_t> bones; // nodes, parents first
	int32_t parent = -1; // node whose space it stands in; -1: the scene's
};

struct GltfSceneRoots {
	std::string name;
	std::vector<int32_t> nodes;
	std::string environment_json; // extras.environment, as text; empty: none
};

struct GltfDocument {
	std::vector<GltfImage> images;
	std::vector<GltfMaterial> materials;
	std::vector<GltfMesh> meshes;
	std::vector<GltfLight> lights;
	std::vector<GltfCamera> cameras;
	std::vector<GltfNode> nodes;
	std::vector<GltfSkeleton> skeletons;
	bool has_single_root = false; // GODOT_single_root: a scene's only node is the root, not a child of it
	std::vector<GltfSceneRoots> scenes; // never empty: a file without scenes gets one with all root nodes
	int32_t default_scene = 0;
	std::vector<std::string> warnings; // "box.gltf: …", each once
	std::vector<std::string> errors; // parts that could not be read, as warnings
};

struct GltfLimits {
	uint64_t max_decoded_bytes = uint64_t(8) << 30; // of everything that is read or made, before it is allocated
	uint32_t max_depth = 256; // levels of nodes
	uint32_t max_nodes = 4000000;
};

// Gives the bytes behind a relative URI (percent-decoded: "textures/red brick.png").
using GltfFileReader = std::function<Result<std::vector<std::byte>>(const std::string &p_uri)>;

// Reads .gltf text or .glb. p_name stands for the file in messages: "box.gltf: /accessors/3/count: …". An empty p_reader refuses
// external files.
Result<GltfDocument> parse_gltf(std::span<const std::byte> p_bytes, const std::string &p_name, const GltfFileReader &p_reader, const GltfLimits &p_limits = {});

// External files are looked up in p_path's folder.
Result<GltfDocument> load_gltf(const std::string &p_path);

} // namespace lucent
