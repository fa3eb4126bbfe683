// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_tree.h"

#include "modules/scene/camera_3d.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/skeleton_3d.h"

#include <algorithm>
#include <map>
#include <set>

namespace lucent {

namespace {

using namespace scene;

// A node to be, so that it can still change its place and type.
struct Item {
	std::unique_ptr<Node3D> node;
	std::string name;
	std::string mesh_name;
	bool is_mesh = false;
	bool is_left_out = false;
	Item *parent = nullptr;
	std::vector<std::unique_ptr<Item>> children;

	Item *add(std::unique_ptr<Item> p_child) {
		p_child->parent = this;
		children.push_back(std::move(p_child));
		return children.back().get();
	}
	bool has_child(const std::string &p_name) const {
		return std::any_of(children.begin(), children.end(), [&](const std::unique_ptr<Item> &p_child) { return !p_child->is_left_out && p_child->name == p_name; });
	}
};

std::unique_ptr<Item> make_item(const std::string &p_name, std::unique_ptr<Node3D> p_node = std::make_unique<Node3D>()) {
	std::unique_ptr<Item> item = std::make_unique<Item>();
	item->name = p_name;
	item->node = std::move(p_node);
	return item;
}

Color encode_color(const Vector3 &p_linear) {
	return { linear_to_srgb(p_linear.x), linear_to_srgb(p_linear.y), linear_to_srgb(p_linear.z), 1.0f };
}

std::unique_ptr<Node3D> make_light(const GltfLight &p_light) {
	std::unique_ptr<Light3D> light;
	switch (p_light.light.type) {
		case LightType::DIRECTIONAL:
			light = std::make_unique<DirectionalLight3D>();
			break;
		case LightType::OMNI:
			light = std::make_unique<OmniLight3D>();
			break;
		case LightType::SPOT:
			light = std::make_unique<SpotLight3D>();
			break;
	}
	// The colour property ends at 1; the energy carries the rest.
	const Vector3 &color = p_light.light.color;
	const float brightest = std::max({ color.x, color.y, color.z, 1.0f });
	lucent::Light parameters = p_light.light;
	parameters.energy *= brightest;
	light->set_parameters(parameters);
	light->set_color(encode_color(color / brightest));
	return light;
}

std::unique_ptr<Node3D> make_camera(const GltfCamera &p_camera) {
	std::unique_ptr<Camera3D> camera = std::make_unique<Camera3D>();
	camera->parameters = p_camera.camera;
	camera->state_changed();
	return camera;
}

class TreeBuilder {
public:
	TreeBuilder(const GltfDocument &p_document, const GltfResources &p_resources, const GltfSceneRoots &p_scene, const GltfImportSettings &p_settings) :
			document(p_document), resources(p_resources), scene(p_scene), settings(p_settings), skeletons(p_document.skeletons.size(), nullptr) {}

	std::unique_ptr<Node> build(const std::string &p_fallback_name) {
		name_nodes(scene.name.empty() ? p_fallback_name : scene.name);
		std::unique_ptr<Item> root;
		if (document.has_single_root && scene.nodes.size() == 1 && document.nodes[size_t(scene.nodes[0])].skeleton < 0) {
			Item holder;
			add_node(holder, scene.nodes[0]);
			root = std::move(holder.children[0]);
			root->parent = nullptr;
		} else {
			root = make_item(root_name);
			for (const int32_t index : scene.nodes) {
				add_node(*root, index);
			}
		}
		move_skinned_meshes();
		if (settings.use_name_suffixes) {
			apply_hints(*root, true);
		}
		if (!settings.root_name.empty()) {
			root->name = settings.root_name;
		}
		return finish(std::move(root));
	}

private:
	std::string unique_name(const std::string &p_wanted) {
		std::string name = p_wanted;
		for (char &c : name) {
			c = std::string_view(".:@/\"%").find(c) == std::string_view::npos ? c : '_';
		}
		const std::string base = name;
		for (int number = next_numbers.count(base) ? next_numbers[base] : 2; !names.insert(name).second; number++) {
			name = base + std::to_string(number);
			next_numbers[base] = number + 1;
		}
		return name;
	}

	// By index, as the file lists them. Bones have names of their own.
	void name_nodes(const std::string &p_scene_name) {
		root_name = settings.naming_version < 2 ? unique_name(p_scene_name) : clean(p_scene_name);
		node_names.resize(document.nodes.size());
		for (size_t i = 0; i < document.nodes.size(); i++) {
			const GltfNode &node = document.nodes[i];
			if (node.skeleton < 0) {
				const char *fallback = node.mesh >= 0 ? "Mesh" : (node.camera >= 0 ? "Camera" : (node.light >= 0 ? "Light" : "Node"));
				node_names[i] = unique_name(node.name.empty() ? fallback : node.name);
			}
		}
		for (const GltfSkeleton &skeleton : document.skeletons) {
			std::set<std::string> bones;
			for (const int32_t bone : skeleton.bones) {
				std::string base = document.nodes[size_t(bone)].name.empty() ? "bone" : document.nodes[size_t(bone)].name;
				std::replace_if(
						base.begin(), base.end(), [](char p_c) { return p_c == ':' || p_c == '/'; }, '_');
				std::string name = base;
				for (int number = 1; !bones.insert(name).second; number++) {
					name = fmt::format("{}_{}", base, number);
				}
				node_names[size_t(bone)] = name;
			}
		}
	}

	static std::string clean(std::string p_name) {
		std::replace_if(
				p_name.begin(), p_name.end(), [](char p_c) { return std::string_view(".:@/\"%").find(p_c) != std::string_view::npos; }, '_');
		return p_name;
	}

	std::unique_ptr<Item> mesh_item(const GltfNode &p_node, const std::string &p_name) {
		std::unique_ptr<MeshInstance3D> instance = std::make_unique<MeshInstance3D>();
		instance->set_mesh(resources.meshes[size_t(p_node.mesh)]);
		std::unique_ptr<Item> item = make_item(p_name, std::move(instance));
		item->is_mesh = true;
		item->mesh_name = document.meshes[size_t(p_node.mesh)].name;
		return item;
	}

	// The node itself is the first of mesh, camera and light that it has; the others become children.
	Item *add_content(Item &r_parent, const GltfNode &p_node, const std::string &p_name) {
		std::vector<std::unique_ptr<Item>> parts;
		const bool mesh_moves = p_node.mesh >= 0 && p_node.skin_skeleton >= 0;
		if (mesh_moves && !p_node.children.empty() && p_node.skeleton < 0) {
			parts.push_back(make_item(p_name)); // keeps the place for the children; the skin's mesh goes to its skeleton
		}
		if (p_node.mesh >= 0) {
			parts.push_back(mesh_item(p_node, p_name));
		}
		if (p_node.camera >= 0) {
			parts.push_back(make_item(p_name, make_camera(document.cameras[size_t(p_node.camera)])));
		}
		if (p_node.light >= 0) {
			parts.push_back(make_item(p_name, make_light(document.lights[size_t(p_node.light)])));
		}
		if (parts.empty()) {
			parts.push_back(make_item(p_name));
		}
		Item *made = r_parent.add(std::move(parts[0]));
		Item *mesh = made->is_mesh ? made : nullptr;
		for (size_t i = 1; i < parts.size(); i++) {
			if (!parts[i]->is_mesh) {
				parts[i]->name = unique_name(p_name + "_" + parts[i]->node->get_class());
			}
			Item *part = made->add(std::move(parts[i]));
			mesh = part->is_mesh ? part : mesh;
		}
		if (mesh_moves && mesh != nullptr) {
			skinned.emplace_back(mesh, p_node.skin_skeleton);
		}
		return made;
	}

	Item &skeleton_item(Item &r_parent, int32_t p_skeleton) {
		if (skeletons[size_t(p_skeleton)] != nullptr) {
			return *skeletons[size_t(p_skeleton)];
		}
		std::unique_ptr<Skeleton3D> node = std::make_unique<Skeleton3D>();
		for (const int32_t bone : document.skeletons[size_t(p_skeleton)].bones) {
			const GltfNode &source = document.nodes[size_t(bone)];
			const bool has_parent = source.parent >= 0 && document.nodes[size_t(source.parent)].skeleton == p_skeleton;
			node->add_bone(node_names[size_t(bone)], has_parent ? document.nodes[size_t(source.parent)].bone : -1, source.transform);
		}
		Item *item = r_parent.add(make_item("Skeleton3D", std::move(node)));
		skeletons[size_t(p_skeleton)] = item;
		return *item;
	}

	// p_bone: the node whose bone carries it.
	Item &attachment(Item &r_skeleton, int32_t p_bone, const std::string &p_name) {
		std::unique_ptr<BoneAttachment3D> node = std::make_unique<BoneAttachment3D>();
		node->set_bone_name(node_names[size_t(p_bone)]);
		node->set_bone_idx(document.nodes[size_t(p_bone)].bone);
		return *r_skeleton.add(make_item(p_name, std::move(node)));
	}

	void add_node(Item &r_parent, int32_t p_index) {
		const GltfNode &node = document.nodes[size_t(p_index)];
		const std::string &name = node_names[size_t(p_index)];
		Item *below = nullptr; // where children go
		if (node.skeleton >= 0) {
			below = &skeleton_item(r_parent, node.skeleton);
			if (node.mesh >= 0 || node.camera >= 0 || node.light >= 0) {
				Item &place = node.skin_skeleton >= 0 ? *below : attachment(*below, p_index, name);
				add_content(place, node, name);
			}
		} else {
			const bool on_bone = node.parent >= 0 && document.nodes[size_t(node.parent)].skeleton >= 0;
			Item &place = on_bone && node.skin_skeleton < 0 ? attachment(r_parent, node.parent, name) : r_parent;
			below = add_content(place, node, name);
			below->node->set_transform(node.transform);
		}
		for (const int32_t child : node.children) {
			add_node(*below, child);
		}
	}

	// A skin's mesh stands in its skeleton's space.
	void move_skinned_meshes() {
		for (const std::pair<Item *, int32_t> &entry : skinned) {
			const Item *item = entry.first;
			Item *target = skeletons[size_t(entry.second)];
			if (target == nullptr || item->parent == nullptr) { // the skeleton is in another scene of the file
				continue;
			}
			std::vector<std::unique_ptr<Item>> &siblings = item->parent->children;
			const auto found = std::find_if(siblings.begin(), siblings.end(), [&](const std::unique_ptr<Item> &p_other) { return p_other.get() == item; });
			std::unique_ptr<Item> moved = std::move(*found);
			siblings.erase(found);
			moved->node->set_transform(Transform3D());
			target->add(std::move(moved));
		}
	}

	// What Godot makes of the mesh: a node without one, of the same place.
	static void replace_mesh(Item &r_item, const std::string &p_name) {
		const Transform3D place = r_item.node->get_transform();
		r_item.node = std::make_unique<Node3D>();
		r_item.node->set_transform(place);
		r_item.name = p_name;
		r_item.is_mesh = false;
	}

	static void add_body(Item &r_item) {
		r_item.add(make_item("StaticBody3D"))->add(make_item("CollisionShape3D"));
	}

	static void rename(Item &r_item, const std::string &p_name) {
		if (!p_name.empty() && (r_item.parent == nullptr || !r_item.parent->has_child(p_name))) {
			r_item.name = p_name;
		}
	}

	// Puts a node of p_name between r_item and its parent, which takes its place.
	static void wrap(Item &r_item, const std::string &p_name) {
		std::unique_ptr<Item> inner = std::make_unique<Item>();
		inner->node = std::move(r_item.node);
		inner->name = r_item.name;
		inner->is_mesh = r_item.is_mesh;
		r_item.node = std::make_unique<Node3D>();
		r_item.node->set_transform(inner->node->get_transform());
		inner->node->set_transform(Transform3D());
		r_item.name = p_name;
		r_item.is_mesh = false;
		r_item.add(std::move(inner));
	}

	// Children first. False: the node goes, with all below it.
	bool apply_hints(Item &r_item, bool p_is_root) {
		for (const std::unique_ptr<Item> &child : r_item.children) { // all first: they look at their siblings' names
			child->is_left_out = !apply_hints(*child, false);
		}
		std::erase_if(r_item.children, [](const std::unique_ptr<Item> &p_child) { return p_child->is_left_out; });
		const std::string name = r_item.name;
		if (!p_is_root && has_name_hint(name, "noimp")) {
			return false;
		}
		if (!settings.use_node_type_suffixes) {
			return true;
		}
		for (const char *hint : { "colonly", "convcolonly" }) {
			if (has_name_hint(name, hint)) {
				const std::string fixed = without_name_hint(name, hint);
				if (!p_is_root && r_item.is_mesh && !fixed.empty()) {
					replace_mesh(r_item, fixed);
					r_item.add(make_item("CollisionShape3D"));
				}
				return p_is_root || !fixed.empty();
			}
		}
		if (r_item.is_mesh && has_name_hint(name, "rigid")) {
			if (!p_is_root) {
				wrap(r_item, name);
				r_item.add(make_item("CollisionShape3D"));
			}
		} else if (r_item.is_mesh && (has_name_hint(name, "col") || has_name_hint(name, "convcol"))) {
			rename(r_item, without_name_hint(name, has_name_hint(name, "col") ? "col" : "convcol"));
			add_body(r_item);
		} else if (r_item.is_mesh && has_name_hint(name, "navmesh")) {
			if (!p_is_root) {
				replace_mesh(r_item, without_name_hint(name, "navmesh"));
			}
		} else if (has_name_hint(name, "occ") || has_name_hint(name, "occonly")) {
			if (!p_is_root && r_item.is_mesh) {
				if (!has_name_hint(name, "occ")) {
					return false;
				}
				rename(r_item, without_name_hint(name, "occ"));
			}
		} else if (has_name_hint(name, "vehicle") || has_name_hint(name, "wheel")) {
			const std::string fixed = without_name_hint(name, has_name_hint(name, "vehicle") ? "vehicle" : "wheel");
			if (!p_is_root) {
				r_item.name = fixed;
				wrap_with_children(r_item, fixed);
			}
		} else if (r_item.is_mesh && (has_name_hint(r_item.mesh_name, "col") || has_name_hint(r_item.mesh_name, "convcol"))) {
			add_body(r_item);
		}
		return true;
	}

	// As wrap(), and what is below stays below the inner one.
	static void wrap_with_children(Item &r_item, const std::string &p_name) {
		std::vector<std::unique_ptr<Item>> children = std::move(r_item.children);
		r_item.children.clear();
		wrap(r_item, p_name);
		for (std::unique_ptr<Item> &child : children) {
			r_item.children[0]->add(std::move(child));
		}
	}

	std::unique_ptr<Node> finish(std::unique_ptr<Item> p_root) {
		Node3D *root = p_root->node.get();
		root->set_name(p_root->name);
		for (std::unique_ptr<Item> &child : p_root->children) {
			if (settings.root_scale != 1.0f) {
				Transform3D place = child->node->get_transform();
				place.basis *= settings.root_scale;
				place.origin *= settings.root_scale;
				child->node->set_transform(place);
			}
			emit(*root, *root, *child);
		}
		return std::move(p_root->node);
	}

	static void emit(Node3D &r_root, Node3D &r_parent, Item &r_item) {
		r_item.node->set_name(r_item.name);
		Node3D *made = r_parent.add(std::move(r_item.node));
		made->set_owner(&r_root);
		for (std::unique_ptr<Item> &child : r_item.children) {
			emit(r_root, *made, *child);
		}
	}

	const GltfDocument &document;
	const GltfResources &resources;
	const GltfSceneRoots &scene;
	const GltfImportSettings &settings;
	std::string root_name;
	std::vector<std::string> node_names; // by node
	std::vector<Item *> skeletons;
	std::vector<std::pair<Item *, int32_t>> skinned;
	std::set<std::string> names;
	std::map<std::string, int> next_numbers;
};

} // namespace

std::unique_ptr<scene::Node> build_gltf_tree(const GltfDocument &p_document, const GltfResources &p_resources, const GltfSceneRoots &p_scene, const std::string &p_fallback_name, const GltfImportSettings &p_settings) {
	return TreeBuilder(p_document, p_resources, p_scene, p_settings).build(p_fallback_name);
}

} // namespace lucent
