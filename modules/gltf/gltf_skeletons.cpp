// SPDX-License-Identifier: MIT
// Which nodes are bones, as Godot's importer decides: the joints of each skin with what lies between them, and skins whose bones
// touch share one skeleton.
#include "modules/gltf/gltf_loader.h"

#include <algorithm>
#include <map>
#include <set>

namespace lucent {

namespace {

using NodeSet = std::set<int32_t>;

// Members whose parent is none.
std::vector<int32_t> roots_of(const std::vector<GltfNode> &p_nodes, const NodeSet &p_set) {
	std::vector<int32_t> roots;
	for (const int32_t node : p_set) {
		if (!p_set.contains(p_nodes[size_t(node)].parent)) {
			roots.push_back(node);
		}
	}
	return roots;
}

// From the topmost one down to p_node, which is the last.
std::vector<int32_t> path_to(const std::vector<GltfNode> &p_nodes, int32_t p_node) {
	std::vector<int32_t> path;
	for (int32_t node = p_node; node >= 0; node = p_nodes[size_t(node)].parent) {
		path.push_back(node);
	}
	std::reverse(path.begin(), path.end());
	return path;
}

// Adds nodes until all roots have the same parent: a skeleton has one place in the tree.
void join_roots(const std::vector<GltfNode> &p_nodes, NodeSet &r_set) {
	const std::vector<int32_t> roots = roots_of(p_nodes, r_set);
	if (roots.size() < 2) {
		return;
	}
	std::vector<int32_t> common = path_to(p_nodes, p_nodes[size_t(roots[0])].parent);
	for (const int32_t root : roots) {
		const std::vector<int32_t> path = path_to(p_nodes, p_nodes[size_t(root)].parent);
		const size_t length = std::min(common.size(), path.size());
		common.resize(size_t(std::mismatch(common.begin(), common.begin() + ptrdiff_t(length), path.begin()).first - common.begin()));
	}
	const int32_t shared_parent = common.empty() ? -1 : common.back();
	for (const int32_t root : roots) {
		for (int32_t node = root; node >= 0 && node != shared_parent; node = p_nodes[size_t(node)].parent) {
			r_set.insert(node);
		}
	}
}

bool touch(const std::vector<GltfNode> &p_nodes, const NodeSet &p_a, const NodeSet &p_b) {
	const auto reaches = [&](const NodeSet &p_from, const NodeSet &p_to) {
		return std::any_of(p_from.begin(), p_from.end(), [&](int32_t p_node) { return p_to.contains(p_node) || p_to.contains(p_nodes[size_t(p_node)].parent); });
	};
	return reaches(p_a, p_b) || reaches(p_b, p_a);
}

// Depth first, roots and children in the file's order: the order of Godot's bones.
void add_bones(std::vector<GltfNode> &r_nodes, const NodeSet &p_set, int32_t p_skeleton, GltfSkeleton &r_skeleton) {
	std::vector<int32_t> stack = roots_of(r_nodes, p_set);
	r_skeleton.parent = r_nodes[size_t(stack[0])].parent;
	std::reverse(stack.begin(), stack.end());
	while (!stack.empty()) {
		const int32_t node = stack.back();
		stack.pop_back();
		r_nodes[size_t(node)].skeleton = p_skeleton;
		r_nodes[size_t(node)].bone = int32_t(r_skeleton.bones.size());
		r_skeleton.bones.push_back(node);
		std::vector<int32_t> children = r_nodes[size_t(node)].children;
		std::sort(children.begin(), children.end(), std::greater<>());
		std::copy_if(children.begin(), children.end(), std::back_inserter(stack), [&](int32_t p_child) { return p_set.contains(p_child); });
	}
}

} // namespace

void find_skeletons(GltfContext &r_context, const GltfPoses &p_poses) {
	std::vector<GltfNode> &nodes = r_context.document.nodes;
	std::vector<NodeSet> sets;
	for (const GltfSkin &skin : p_poses.skins) {
		NodeSet set(skin.joints.begin(), skin.joints.end());
		join_roots(nodes, set);
		r_context.charge(set.size(), 64, r_context.root);
		for (bool merged = true; merged && !set.empty();) { // a merged set may touch one that came before
			merged = false;
			for (NodeSet &other : sets) {
				if (!other.empty() && touch(nodes, set, other)) {
					set.merge(other);
					other.clear();
					join_roots(nodes, set);
					merged = true;
				}
			}
		}
		sets.push_back(std::move(set));
	}
	for (const NodeSet &set : sets) {
		if (!set.empty()) {
			GltfSkeleton &skeleton = r_context.document.skeletons.emplace_back();
			add_bones(nodes, set, int32_t(r_context.document.skeletons.size()) - 1, skeleton);
		}
	}
	for (size_t i = 0; i < nodes.size(); i++) {
		const int32_t skin = p_poses.nodes[i].skin;
		if (skin >= 0 && !p_poses.skins[size_t(skin)].joints.empty()) {
			nodes[i].skin_skeleton = nodes[size_t(p_poses.skins[size_t(skin)].joints[0])].skeleton;
		}
	}
}

} // namespace lucent
