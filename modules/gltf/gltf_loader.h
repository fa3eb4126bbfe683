// SPDX-License-Identifier: MIT
#pragma once
// The steps of parse_gltf(), in order. Each fails by GltfFailure.

#include "modules/gltf/gltf_buffers.h"

namespace lucent {

// Fills document.images and .materials.
void load_materials(GltfContext &r_context, const GltfBuffers &p_buffers);

// A primitive before its pose: what skins and morph targets need is still there.
struct GltfRawPrimitive {
	MeshSurface surface;
	int32_t material = -1;
	std::string path;
	std::vector<Vector4> joints; // indices, exact in a float; empty: not skinned
	std::vector<Vector4> weights; // sum 1
	struct MorphTarget {
		std::vector<Vector3> positions; // displacements; empty: none
		std::vector<Vector3> normals;
	};
	std::vector<MorphTarget> morph_targets;
};

struct GltfRawMesh {
	std::string name;
	std::vector<GltfRawPrimitive> primitives;
	std::vector<float> weights; // of the morph targets
};

std::vector<GltfRawMesh> load_meshes(GltfContext &r_context, const GltfBuffers &p_buffers);

struct GltfSkin {
	std::vector<int32_t> joints;
	std::vector<glm::mat4> inverse_binds; // as many
};

struct GltfNodePose {
	int32_t skin = -1;
	std::vector<float> weights; // empty: the mesh's
};

struct GltfPoses {
	std::vector<GltfSkin> skins;
	std::vector<GltfNodePose> nodes; // by node
};

// Fills document.nodes, .lights, .cameras and .scenes, and proves that the nodes are a forest.
GltfPoses load_nodes(GltfContext &r_context, const GltfBuffers &p_buffers, std::span<const GltfRawMesh> p_meshes);

// Part of load_nodes: document.lights, .cameras.
void load_lights(GltfContext &r_context);
void load_cameras(GltfContext &r_context);

// Fills document.skeletons, and what nodes say of them.
void find_skeletons(GltfContext &r_context, const GltfPoses &p_poses);

// Fills document.meshes; a node whose skin or weights change its mesh gets one of its own.
void pose_meshes(GltfContext &r_context, std::vector<GltfRawMesh> p_meshes, const GltfPoses &p_poses);

} // namespace lucent
