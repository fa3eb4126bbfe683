// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_loader.h"

namespace lucent {

namespace {

class NodeLoader {
public:
	NodeLoader(GltfContext &r_context, const GltfBuffers &p_buffers, std::span<const GltfRawMesh> p_meshes) :
			context(r_context), buffers(p_buffers), meshes(p_meshes), json_nodes(r_context.root.member("nodes")) {}

	GltfPoses load();

private:
	void load_node(size_t p_index);
	void load_weights(const JsonView &p_json, const GltfNode &p_node, GltfNodePose &r_pose);
	void load_instances(size_t p_index);
	void check_hierarchy();
	void load_skins();
	void load_scenes();

	GltfContext &context;
	const GltfBuffers &buffers;
	std::span<const GltfRawMesh> meshes;
	const JsonView json_nodes;
	GltfPoses poses;
};

Quaternion unit_quaternion(float p_x, float p_y, float p_z, float p_w) {
	const float length = std::sqrt(p_x * p_x + p_y * p_y + p_z * p_z + p_w * p_w);
	if (!(length > 1e-6f) || !std::isfinite(length)) {
		return Quaternion(1.0f, 0.0f, 0.0f, 0.0f);
	}
	return Quaternion(p_w / length, p_x / length, p_y / length, p_z / length);
}

Transform3D compose(const Vector3 &p_translation, const Quaternion &p_rotation, const Vector3 &p_scale) {
	Basis basis = glm::mat3_cast(p_rotation);
	for (int c = 0; c < 3; c++) {
		basis[c] *= p_scale[c];
	}
	return { basis, p_translation };
}

Transform3D load_transform(GltfContext &r_context, const JsonView &p_json) {
	float m[16];
	if (p_json.floats("matrix", m)) {
		if (m[3] != 0.0f || m[7] != 0.0f || m[11] != 0.0f || m[15] != 1.0f) {
			r_context.warn("{}: expected an affine matrix; its last row is left out", p_json.member("matrix").get_path());
		}
		return { Basis(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]), Vector3(m[12], m[13], m[14]) };
	}
	float r[4] = { 0.0f, 0.0f, 0.0f, 1.0f };
	p_json.floats("rotation", r);
	return compose(p_json.vector3_or("translation", Vector3(0.0f)), unit_quaternion(r[0], r[1], r[2], r[3]), p_json.vector3_or("scale", Vector3(1.0f)));
}

void NodeLoader::load_weights(const JsonView &p_json, const GltfNode &p_node, GltfNodePose &r_pose) {
	const JsonView weights = p_json.member("weights");
	for (size_t i = 0; i < weights.array_size(); i++) {
		r_pose.weights.push_back(weights.element(i).to_float());
	}
	if (p_node.mesh < 0 || r_pose.weights == meshes[size_t(p_node.mesh)].weights) {
		r_pose.weights.clear();
	}
}

void NodeLoader::load_node(size_t p_index) {
	const JsonView json = json_nodes.element(p_index);
	GltfNode &node = context.document.nodes[p_index];
	GltfNodePose &pose = poses.nodes[p_index];
	node.name = json.string_or("name", "");
	node.transform = load_transform(context, json);
	node.mesh = json.index_or_none("mesh", meshes.size());
	node.camera = json.index_or_none("camera", context.document.cameras.size());
	node.light = json.extension("KHR_lights_punctual").index_or_none("light", context.document.lights.size());
	pose.skin = json.index_or_none("skin", poses.skins.size());
	if (node.mesh < 0) {
		pose.skin = -1;
	}
	load_weights(json, node, pose);
	const JsonView children = json.member("children");
	for (size_t i = 0; i < children.array_size(); i++) {
		const int32_t child = children.element(i).to_index(json_nodes.array_size());
		GltfNode &child_node = context.document.nodes[size_t(child)];
		if (child_node.parent >= 0) {
			children.element(i).fail("node {} already has the parent {}", child, child_node.parent);
		}
		child_node.parent = int32_t(p_index);
		node.children.push_back(child);
	}
}

// Breadth first from the roots: what is not reached is on a cycle or below one.
void NodeLoader::check_hierarchy() {
	const std::vector<GltfNode> &nodes = context.document.nodes;
	std::vector<int32_t> level;
	for (size_t i = 0; i < nodes.size(); i++) {
		if (nodes[i].parent < 0) {
			level.push_back(int32_t(i));
		}
	}
	size_t reached = 0;
	for (uint32_t depth = 0; !level.empty(); depth++) {
		if (depth >= context.limits.max_depth) {
			json_nodes.element(size_t(level[0])).fail("the nodes are nested deeper than {} levels", context.limits.max_depth);
		}
		reached += level.size();
		std::vector<int32_t> next;
		for (const int32_t index : level) {
			next.insert(next.end(), nodes[size_t(index)].children.begin(), nodes[size_t(index)].children.end());
		}
		level = std::move(next);
	}
	if (reached == nodes.size()) {
		return;
	}
	// Every node on a cycle has a parent, so walking up from any unreached one ends on it.
	std::vector<bool> seen(nodes.size(), false);
	for (size_t i = 0; i < nodes.size(); i++) {
		int32_t index = int32_t(i);
		std::vector<int32_t> walk;
		while (index >= 0 && !seen[size_t(index)]) {
			seen[size_t(index)] = true;
			walk.push_back(index);
			index = nodes[size_t(index)].parent;
		}
		if (index >= 0 && std::find(walk.begin(), walk.end(), index) != walk.end()) {
			json_nodes.element(size_t(index)).fail("the node is its own ancestor");
		}
	}
}

void NodeLoader::load_skins() {
	const JsonView skins = context.root.member("skins");
	for (size_t s = 0; s < skins.array_size(); s++) {
		const JsonView json = skins.element(s);
		GltfSkin &skin = poses.skins.emplace_back();
		const JsonView joints = json.member("joints");
		for (size_t j = 0; j < joints.array_size(); j++) {
			skin.joints.push_back(joints.element(j).to_index(json_nodes.array_size()));
		}
		skin.inverse_binds.assign(skin.joints.size(), glm::mat4(1.0f));
		const int32_t index = json.index_or_none("inverseBindMatrices", buffers.accessor_count());
		if (index < 0) {
			continue;
		}
		const GltfAccessor &accessor = buffers.accessor(index);
		if (accessor.components != 16 || accessor.component_type != 5126 || accessor.count < skin.joints.size()) {
			json.member("inverseBindMatrices").fail("expected a MAT4 of floats for each of {} joints", skin.joints.size());
		}
		std::vector<uint32_t> elements;
		for (uint32_t j = 0; j < skin.joints.size(); j++) {
			elements.push_back(j);
		}
		const std::vector<float> values = read_floats(context, accessor, elements);
		for (size_t i = 0; i < values.size(); i++) {
			skin.inverse_binds[i / 16][int(i / 4 % 4)][int(i % 4)] = values[i];
		}
	}
}

// EXT_mesh_gpu_instancing: the node's mesh is shown once for each element, as children.
void NodeLoader::load_instances(size_t p_index) {
	const JsonView attributes = json_nodes.element(p_index).extension("EXT_mesh_gpu_instancing").member("attributes");
	if (!attributes.present() || context.document.nodes[p_index].mesh < 0) {
		return;
	}
	std::vector<float> values[3]; // translation, rotation, scale
	const char *keys[] = { "TRANSLATION", "ROTATION", "SCALE" };
	uint32_t count = 0;
	for (int k = 0; k < 3; k++) {
		const JsonView json = attributes.member(keys[k]);
		if (!json.present()) {
			continue;
		}
		const GltfAccessor &accessor = buffers.accessor(json.to_index(buffers.accessor_count()));
		if (accessor.components != (k == 1 ? 4 : 3) || (count != 0 && accessor.count != count)) {
			json.fail("expected {} components and as many elements as the others", k == 1 ? 4 : 3);
		}
		count = accessor.count;
		if (context.document.nodes.size() + count > context.limits.max_nodes) {
			json.fail("more than the limit of {} nodes", context.limits.max_nodes);
		}
		std::vector<uint32_t> elements(count);
		for (uint32_t i = 0; i < count; i++) {
			elements[i] = i;
		}
		values[k] = read_floats(context, accessor, elements);
	}
	std::vector<GltfNode> &nodes = context.document.nodes;
	for (size_t i = 0; i < count; i++) {
		const float *t = values[0].empty() ? nullptr : &values[0][i * 3];
		const float *r = values[1].empty() ? nullptr : &values[1][i * 4];
		const float *s = values[2].empty() ? nullptr : &values[2][i * 3];
		GltfNode child;
		child.name = fmt::format("{}_{}", nodes[p_index].name, i);
		child.parent = int32_t(p_index);
		child.mesh = nodes[p_index].mesh;
		child.transform = compose(t ? Vector3(t[0], t[1], t[2]) : Vector3(0.0f), r ? unit_quaternion(r[0], r[1], r[2], r[3]) : unit_quaternion(0, 0, 0, 1), s ? Vector3(s[0], s[1], s[2]) : Vector3(1.0f));
		nodes[p_index].children.push_back(int32_t(nodes.size()));
		nodes.push_back(std::move(child));
		poses.nodes.push_back({ -1, poses.nodes[p_index].weights });
	}
	if (count > 0) {
		nodes[p_index].mesh = -1;
		poses.nodes[p_index] = {};
	}
}

void NodeLoader::load_scenes() {
	GltfDocument &document = context.document;
	const JsonView scenes = context.root.member("scenes");
	for (size_t s = 0; s < scenes.array_size(); s++) {
		const JsonView json = scenes.element(s);
		GltfSceneRoots &scene = document.scenes.emplace_back();
		scene.name = json.string_or("name", "");
		const JsonView environment = json.member("extras");
		scene.environment_json = environment.is_object() ? environment.member("environment").to_text() : "";
		const JsonView roots = json.member("nodes");
		std::vector<bool> listed(document.nodes.size(), false);
		for (size_t i = 0; i < roots.array_size(); i++) {
			const int32_t node = roots.element(i).to_index(json_nodes.array_size());
			if (document.nodes[size_t(node)].parent >= 0) {
				roots.element(i).fail("node {} is not a root: it is a child of {}", node, document.nodes[size_t(node)].parent);
			}
			if (listed[size_t(node)]) {
				roots.element(i).fail("node {} is listed twice", node);
			}
			listed[size_t(node)] = true;
			scene.nodes.push_back(node);
		}
	}
	document.default_scene = std::max(0, context.root.index_or_none("scene", scenes.array_size()));
	if (document.scenes.empty()) {
		GltfSceneRoots &scene = document.scenes.emplace_back();
		for (size_t i = 0; i < document.nodes.size(); i++) {
			if (document.nodes[i].parent < 0) {
				scene.nodes.push_back(int32_t(i));
			}
		}
	}
}

GltfPoses NodeLoader::load() {
	const size_t count = json_nodes.array_size();
	if (count > context.limits.max_nodes) {
		json_nodes.fail("{} nodes are more than the limit of {}", count, context.limits.max_nodes);
	}
	load_skins();
	context.document.nodes.resize(count);
	poses.nodes.resize(count);
	for (size_t i = 0; i < count; i++) {
		load_node(i);
	}
	check_hierarchy();
	for (size_t i = 0; i < count; i++) {
		load_instances(i);
	}
	load_scenes();
	return std::move(poses);
}

} // namespace

GltfPoses load_nodes(GltfContext &r_context, const GltfBuffers &p_buffers, std::span<const GltfRawMesh> p_meshes) {
	load_lights(r_context);
	load_cameras(r_context);
	return NodeLoader(r_context, p_buffers, p_meshes).load();
}

} // namespace lucent
