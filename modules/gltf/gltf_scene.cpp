// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_scene.h"

#include "modules/gltf/gltf_tree.h"
#include "modules/scene/load_report.h"
#include "modules/scene/resource_loader.h"
#include "servers/core/file_io.h"

namespace lucent {

namespace {

using namespace scene;

Color encode_color(const Vector3 &p_linear, float p_alpha = 1.0f) {
	return { linear_to_srgb(p_linear.x), linear_to_srgb(p_linear.y), linear_to_srgb(p_linear.z), p_alpha };
}

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
	if (has_name_hint(p_material.name, "alpha")) {
		state.transparency = MaterialTransparency::ALPHA;
		material->set_name(without_name_hint(p_material.name, "alpha"));
	}
	if (has_name_hint(p_material.name, "vcol")) {
		state.vertex_color_use_as_albedo = true;
		material->set_name(without_name_hint(p_material.name, "vcol"));
	}
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

} // namespace

Result<Ref<scene::PackedScene>> gltf_to_scene(GltfDocument p_document, const std::string &p_name, int32_t p_scene, const GltfImportSettings &p_settings) {
	const int32_t index = p_scene < 0 ? p_document.default_scene : p_scene;
	if (size_t(index) >= p_document.scenes.size()) {
		return make_error("{}: expected a scene from 0 to {}, found {}", p_name, p_document.scenes.size() - 1, index);
	}
	const std::shared_ptr<GltfDocument> document = std::make_shared<GltfDocument>(std::move(p_document));
	const std::shared_ptr<const GltfResources> resources = std::make_shared<const GltfResources>(make_resources(*document));
	const Ref<PackedScene> packed = std::make_shared<PackedScene>([document, resources, index, p_name, p_settings]() -> Result<std::unique_ptr<Node>> {
		return build_gltf_tree(*document, *resources, document->scenes[size_t(index)], p_name, p_settings);
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
	for (const std::string &error : document.value().errors) {
		LoadReport::error(error);
	}
	std::string name = p_path.substr(path_folder(p_path).size());
	name = name.substr(0, name.rfind('.'));
	Result<Ref<PackedScene>> packed = gltf_to_scene(document.take(), name, p_scene, load_gltf_import_settings(p_path));
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
