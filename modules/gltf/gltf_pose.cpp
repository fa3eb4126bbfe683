// SPDX-License-Identifier: MIT
// Skins and morph targets in the pose that the file stands in.
#include "modules/gltf/gltf_loader.h"

#include "modules/gltf/gltf_geometry.h"

#include <map>

namespace lucent {

namespace {

void apply_morph_targets(const GltfRawPrimitive &p_raw, std::span<const float> p_weights, MeshSurface &r_surface) {
	for (size_t t = 0; t < p_raw.morph_targets.size() && t < p_weights.size(); t++) {
		const GltfRawPrimitive::MorphTarget &target = p_raw.morph_targets[t];
		for (size_t i = 0; p_weights[t] != 0.0f && i < target.positions.size(); i++) {
			r_surface.positions[i] += p_weights[t] * target.positions[i];
		}
		for (size_t i = 0; p_weights[t] != 0.0f && i < std::min(target.normals.size(), r_surface.normals.size()); i++) {
			r_surface.normals[i] += p_weights[t] * target.normals[i];
		}
	}
}

// Skin matrices (glTF 2.0, 3.7.3.3) relative to the node that p_space is of, or the scene (-1). Empty when they cannot be made.
std::vector<glm::mat4> skin_matrices(const std::vector<Transform3D> &p_globals, const GltfSkin &p_skin, int32_t p_space) {
	const Transform3D node = p_space < 0 ? Transform3D() : p_globals[size_t(p_space)];
	if (!(std::abs(glm::determinant(node.basis)) > 1e-20f)) {
		return {};
	}
	const glm::mat4 node_from_world = node.affine_inverse().to_matrix();
	std::vector<glm::mat4> matrices;
	for (size_t j = 0; j < p_skin.joints.size(); j++) {
		matrices.push_back(node_from_world * p_globals[size_t(p_skin.joints[j])].to_matrix() * p_skin.inverse_binds[j]);
	}
	return matrices;
}

void apply_skin(const GltfRawPrimitive &p_raw, std::span<const glm::mat4> p_matrices, MeshSurface &r_surface) {
	for (size_t i = 0; i < p_raw.joints.size(); i++) {
		glm::mat4 matrix(0.0f);
		for (int c = 0; c < 4; c++) {
			const float joint = p_raw.joints[i][c];
			const float weight = p_raw.weights[i][c];
			if (weight > 0.0f && joint >= 0.0f && joint < float(p_matrices.size())) {
				matrix += p_matrices[size_t(joint)] * weight;
			}
		}
		r_surface.positions[i] = Vector3(matrix * Vector4(r_surface.positions[i], 1.0f));
		if (!r_surface.normals.empty()) {
			// The cofactor matrix turns normals right under any scale, mirroring included.
			const Vector3 x = Vector3(matrix[0]), y = Vector3(matrix[1]), z = Vector3(matrix[2]);
			r_surface.normals[i] = Basis(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)) * r_surface.normals[i];
		}
		if (!r_surface.tangents.empty()) {
			r_surface.tangents[i] = Vector4(Basis(matrix) * Vector3(r_surface.tangents[i]), r_surface.tangents[i].w);
		}
	}
}

void complete_tangents(const GltfContext &p_context, const GltfRawPrimitive &p_raw, MeshSurface &r_surface) {
	const GltfTextureRef *texture = p_raw.material >= 0 ? &p_context.document.materials[size_t(p_raw.material)].normal_texture : nullptr;
	if (!texture || texture->image < 0 || (texture->uv_set == 0 ? r_surface.uvs : r_surface.uv2s).empty()) {
		r_surface.tangents.clear();
		return;
	}
	bool complete = r_surface.tangents.size() == r_surface.positions.size();
	for (Vector4 &tangent : r_surface.tangents) {
		const float length = glm::length(Vector3(tangent));
		complete = complete && length > 1e-6f && std::isfinite(length);
		tangent = Vector4(Vector3(tangent) / std::max(length, 1e-6f), tangent.w < 0.0f ? -1.0f : 1.0f);
	}
	if (!complete) {
		make_tangents(r_surface, texture->uv_set == 1);
	}
}

void require_finite(const GltfRawPrimitive &p_raw, const MeshSurface &p_surface) {
	for (size_t i = 0; i < p_surface.positions.size(); i++) {
		const Vector3 &position = p_surface.positions[i];
		if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
			throw GltfFailure{ fmt::format("{}: vertex {} is not finite after its skin or morph targets", p_raw.path, i) };
		}
	}
}

GltfMesh pose_mesh(GltfContext &r_context, const GltfRawMesh &p_mesh, std::span<const float> p_weights, std::span<const glm::mat4> p_matrices) {
	GltfMesh mesh;
	mesh.name = p_mesh.name;
	for (const GltfRawPrimitive &raw : p_mesh.primitives) {
		// Position, normal, tangent, two texture coordinates and a colour at most: 72 bytes.
		r_context.charge(raw.surface.positions.size(), 72, JsonView(nullptr, raw.path));
		r_context.charge(raw.surface.indices.size(), 4, JsonView(nullptr, raw.path));
		GltfPrimitive &primitive = mesh.primitives.emplace_back(GltfPrimitive{ raw.surface, raw.material });
		apply_morph_targets(raw, p_weights, primitive.surface);
		if (!p_matrices.empty()) {
			apply_skin(raw, p_matrices, primitive.surface);
		}
		require_finite(raw, primitive.surface);
		complete_normals(primitive.surface);
		complete_tangents(r_context, raw, primitive.surface);
	}
	return mesh;
}

std::vector<Transform3D> global_transforms(const GltfDocument &p_document) {
	std::vector<Transform3D> globals(p_document.nodes.size());
	std::vector<int32_t> stack;
	for (size_t i = 0; i < p_document.nodes.size(); i++) {
		if (p_document.nodes[i].parent < 0) {
			stack.push_back(int32_t(i));
		}
	}
	while (!stack.empty()) {
		const size_t index = size_t(stack.back());
		stack.pop_back();
		const GltfNode &node = p_document.nodes[index];
		globals[index] = node.parent < 0 ? node.transform : globals[size_t(node.parent)] * node.transform;
		stack.insert(stack.end(), node.children.begin(), node.children.end());
	}
	return globals;
}

} // namespace

void pose_meshes(GltfContext &r_context, std::vector<GltfRawMesh> p_meshes, const GltfPoses &p_poses) {
	GltfDocument &document = r_context.document;
	std::vector<bool> is_plain(p_meshes.size(), false); // some node shows it as it is
	const auto needs_copy = [&](size_t p_node) {
		const GltfNodePose &pose = p_poses.nodes[p_node];
		return pose.skin >= 0 || !pose.weights.empty();
	};
	for (size_t i = 0; i < document.nodes.size(); i++) {
		if (document.nodes[i].mesh >= 0 && !needs_copy(i)) {
			is_plain[size_t(document.nodes[i].mesh)] = true;
		}
	}
	for (size_t i = 0; i < p_meshes.size(); i++) {
		document.meshes.push_back(is_plain[i] ? pose_mesh(r_context, p_meshes[i], p_meshes[i].weights, {}) : GltfMesh{ p_meshes[i].name, {} });
	}
	const std::vector<Transform3D> globals = global_transforms(document);
	for (size_t i = 0; i < p_poses.nodes.size(); i++) {
		GltfNode &node = document.nodes[i];
		if (node.mesh < 0 || !needs_copy(i)) {
			continue;
		}
		const GltfNodePose &pose = p_poses.nodes[i];
		const GltfRawMesh &mesh = p_meshes[size_t(node.mesh)];
		std::vector<glm::mat4> matrices;
		if (pose.skin >= 0) {
			r_context.warn("skins are shown in the pose that the file stands in");
			r_context.charge(p_poses.skins[size_t(pose.skin)].joints.size(), sizeof(glm::mat4), JsonView(nullptr, fmt::format("/nodes/{}", i)));
			matrices = skin_matrices(globals, p_poses.skins[size_t(pose.skin)], node.skin_skeleton < 0 ? int32_t(i) : document.skeletons[size_t(node.skin_skeleton)].parent);
		}
		document.meshes.push_back(pose_mesh(r_context, mesh, pose.weights.empty() ? mesh.weights : pose.weights, matrices));
		node.mesh = int32_t(document.meshes.size()) - 1;
	}
}

} // namespace lucent
