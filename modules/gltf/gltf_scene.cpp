// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_scene.h"

#include "modules/scene/camera_3d.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/resource_loader.h"
#include "servers/core/file_io.h"

#include <map>
#include <set>

namespace lucent {

namespace {

using namespace scene;

Color encode_color(const Vector3 &p_linear, float p_alpha = 1.0f) {
	return { linear_to_srgb(p_linear.x), linear_to_srgb(p_linear.y), linear_to_srgb(p_linear.z), p_alpha };
}

// What copies of a scene share.
struct GltfResources {
	std::vector<Ref<Texture2D>> textures; // by image
	std::vector<Ref<scene::Material>> materials;
	std::vector<Ref<ArrayMesh>> meshes;
};

void set_texture(const GltfResources &p_resources, const GltfTextureRef &p_ref, TextureSlot p_slot, BaseMaterial3D::State &r_state, Ref<Texture2D> &r_texture) {
	if (p_ref.image < 0) {
		return;
	}
	TextureRef sampling;
	sampling.uv_set = p_ref.uv_set;
	sampling.wrap_u = p_ref.wrap_u;
	sampling.wrap_v = p_ref.wrap_v;
	sampling.filter = p_ref.filter;
	sampling.uv_offset = p_ref.uv_offset;
	sampling.uv_scale = p_ref.uv_scale;
	sampling.uv_rotation = p_ref.uv_rotation;
	r_state.sampling[size_t(p_slot)] = sampling;
	r_texture = p_resources.textures[size_t(p_ref.image)];
}

void set_textures(const GltfResources &p_resources, const GltfMaterial &p_material, BaseMaterial3D::State &r_state) {
	set_texture(p_resources, p_material.base_color_texture, TextureSlot::ALBEDO, r_state, r_state.albedo_texture);
	set_texture(p_resources, p_material.metallic_roughness_texture, TextureSlot::METALLIC, r_state, r_state.metallic_texture);
	r_state.metallic_texture_channel = TextureChannel::BLUE;
	set_texture(p_resources, p_material.metallic_roughness_texture, TextureSlot::ROUGHNESS, r_state, r_state.roughness_texture);
	r_state.roughness_texture_channel = TextureChannel::GREEN;
	set_texture(p_resources, p_material.normal_texture, TextureSlot::NORMAL, r_state, r_state.normal_texture);
	r_state.normal_enabled = r_state.normal_texture != nullptr;
	r_state.normal_scale = p_material.normal_scale;
	set_texture(p_resources, p_material.occlusion_texture, TextureSlot::OCCLUSION, r_state, r_state.ao_texture);
	r_state.ao_enabled = r_state.ao_texture != nullptr;
	r_state.ao_on_uv2 = p_material.occlusion_texture.uv_set == 1;
	r_state.ao_texture_channel = TextureChannel::RED;
	r_state.occlusion_strength = p_material.occlusion_strength;
	set_texture(p_resources, p_material.emission_texture, TextureSlot::EMISSION, r_state, r_state.emission_texture);
	r_state.emission_on_uv2 = p_material.emission_texture.uv_set == 1;
}

Ref<scene::Material> make_material(const GltfResources &p_resources, const GltfMaterial &p_material) {
	BaseMaterial3D::State state;
	set_textures(p_resources, p_material, state);
	state.albedo_color = encode_color(Vector3(p_material.base_color), p_material.base_color.a);
	state.metallic = p_material.metallic;
	state.metallic_specular = p_material.specular;
	state.specular_tint = p_material.specular_tint;
	state.roughness = p_material.roughness;
	const float brightest = std::max({ p_material.emission.x, p_material.emission.y, p_material.emission.z });
	state.emission_enabled = brightest > 0.0f;
	if (state.emission_enabled) {
		// A colour property ends at 1; the energy carries the rest.
		state.emission_energy_multiplier = std::max(brightest, 1.0f);
		state.emission = encode_color(p_material.emission / state.emission_energy_multiplier);
		state.emission_operator = EmissionOperator::MULTIPLY;
	}
	switch (p_material.transparency) {
		case TransparencyMode::OPAQUE:
			break;
		case TransparencyMode::ALPHA_BLEND:
			state.transparency = MaterialTransparency::ALPHA;
			break;
		case TransparencyMode::ALPHA_SCISSOR:
			state.transparency = MaterialTransparency::ALPHA_SCISSOR;
			break;
	}
	state.alpha_scissor_threshold = p_material.alpha_cutoff;
	state.cull_mode = p_material.double_sided ? MaterialCull::DISABLED : MaterialCull::BACK;
	state.shading_mode = p_material.unlit ? MaterialShading::UNSHADED : MaterialShading::PER_PIXEL;
	state.vertex_color_use_as_albedo = p_material.uses_vertex_colors;
	const Ref<StandardMaterial3D> material = std::make_shared<StandardMaterial3D>();
	material->set_name(p_material.name);
	material->set_state(state);
	return material;
}

GltfResources make_resources(GltfDocument &r_document) {
	GltfResources resources;
	for (const GltfImage &image : r_document.images) {
		resources.textures.push_back(image.image ? std::make_shared<ImageTexture>(image.image) : nullptr);
		if (resources.textures.back()) {
			resources.textures.back()->set_name(image.name);
		}
	}
	for (const GltfMaterial &material : r_document.materials) {
		resources.materials.push_back(make_material(resources, material));
	}
	for (GltfMesh &source : r_document.meshes) {
		const Ref<ArrayMesh> mesh = std::make_shared<ArrayMesh>();
		mesh->set_name(source.name);
		for (GltfPrimitive &primitive : source.primitives) {
			mesh->add_surface(std::move(primitive.surface), primitive.material >= 0 ? resources.materials[size_t(primitive.material)] : nullptr);
		}
		source.primitives.clear();
		resources.meshes.push_back(mesh);
	}
	return resources;
}

std::unique_ptr<Light3D> make_light(const GltfLight &p_light) {
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

std::unique_ptr<Camera3D> make_camera(const GltfCamera &p_camera) {
	std::unique_ptr<Camera3D> camera = std::make_unique<Camera3D>();
	camera->parameters = p_camera.camera;
	camera->state_changed();
	return camera;
}

// Makes one copy of the scene.
class NodeBuilder {
public:
	NodeBuilder(const GltfDocument &p_document, const GltfResources &p_resources) :
			document(p_document), resources(p_resources) {}

	std::unique_ptr<Node> build(const GltfSceneRoots &p_scene, const std::string &p_name) {
		std::unique_ptr<Node3D> root = std::make_unique<Node3D>();
		root->set_name(unique_name(p_scene.name.empty() ? p_name : p_scene.name));
		for (const int32_t index : p_scene.nodes) {
			add_node(*root, *root, index);
		}
		return root;
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

	// The node itself is the first of mesh, camera and light that it has; the others become children.
	void add_node(Node3D &r_root, Node3D &r_parent, int32_t p_index) {
		const GltfNode &node = document.nodes[size_t(p_index)];
		std::vector<std::unique_ptr<Node3D>> parts;
		const char *fallback = "Node";
		if (node.light >= 0) {
			parts.push_back(make_light(document.lights[size_t(node.light)]));
			fallback = "Light";
		}
		if (node.camera >= 0) {
			parts.push_back(make_camera(document.cameras[size_t(node.camera)]));
			fallback = "Camera";
		}
		if (node.mesh >= 0) {
			std::unique_ptr<MeshInstance3D> instance = std::make_unique<MeshInstance3D>();
			instance->set_mesh(resources.meshes[size_t(node.mesh)]);
			parts.push_back(std::move(instance));
			fallback = "Mesh";
		}
		if (parts.empty()) {
			parts.push_back(std::make_unique<Node3D>());
		}
		const std::string name = unique_name(node.name.empty() ? fallback : node.name);
		parts.back()->set_name(name);
		parts.back()->set_transform(node.transform);
		Node3D *made = r_parent.add(std::move(parts.back()));
		made->set_owner(&r_root);
		parts.pop_back();
		for (std::unique_ptr<Node3D> &part : parts) {
			part->set_name(unique_name(name + "_" + part->get_class()));
			made->add(std::move(part))->set_owner(&r_root);
		}
		for (const int32_t child : node.children) {
			add_node(r_root, *made, child);
		}
	}

	const GltfDocument &document;
	const GltfResources &resources;
	std::set<std::string> names;
	std::map<std::string, int> next_numbers;
};

} // namespace

Result<Ref<scene::PackedScene>> gltf_to_scene(GltfDocument p_document, const std::string &p_name, int32_t p_scene) {
	const int32_t index = p_scene < 0 ? p_document.default_scene : p_scene;
	if (size_t(index) >= p_document.scenes.size()) {
		return make_error("{}: expected a scene from 0 to {}, found {}", p_name, p_document.scenes.size() - 1, index);
	}
	const std::shared_ptr<GltfDocument> document = std::make_shared<GltfDocument>(std::move(p_document));
	const std::shared_ptr<const GltfResources> resources = std::make_shared<const GltfResources>(make_resources(*document));
	const Ref<PackedScene> packed = std::make_shared<PackedScene>([document, resources, index, p_name]() -> Result<std::unique_ptr<Node>> {
		return NodeBuilder(*document, *resources).build(document->scenes[size_t(index)], p_name);
	});
	return packed;
}

Result<Ref<scene::PackedScene>> load_gltf_scene(const std::string &p_path, int32_t p_scene) {
	Result<GltfDocument> document = load_gltf(p_path);
	if (!document) {
		return document.error();
	}
	for (const std::string &warning : document.value().warnings) {
		log_message(LogLevel::WARNING, warning);
	}
	std::string name = p_path.substr(path_folder(p_path).size());
	name = name.substr(0, name.rfind('.'));
	Result<Ref<PackedScene>> packed = gltf_to_scene(document.take(), name, p_scene);
	if (packed) {
		packed.value()->set_path(p_path);
	}
	return packed;
}

void register_gltf_loaders() {
	const auto load = [](const std::string &p_path) -> Result<Ref<Resource>> {
		const Result<Ref<PackedScene>> packed = load_gltf_scene(p_path);
		return packed ? Result<Ref<Resource>>(packed.value()) : Result<Ref<Resource>>(packed.error());
	};
	scene::ResourceLoader::register_loader("gltf", load);
	scene::ResourceLoader::register_loader("glb", load);
}

} // namespace lucent
