// SPDX-License-Identifier: MIT
// Images, textures and materials. An image that cannot be read is a warning: the scene still renders without it.
#include "modules/gltf/gltf_loader.h"

#include "modules/gltf/gltf_specular_glossiness.h"

#include "modules/image/image_io.h"

namespace lucent {

namespace {

class MaterialLoader {
public:
	MaterialLoader(GltfContext &r_context, const GltfBuffers &p_buffers) :
			context(r_context), buffers(p_buffers), json_images(r_context.root.member("images")), json_textures(r_context.root.member("textures")), json_samplers(r_context.root.member("samplers")), tried(json_images.array_size()) {
		context.document.images.resize(json_images.array_size());
		for (size_t i = 0; i < json_images.array_size(); i++) {
			context.document.images[i].name = json_images.element(i).string_or("name", "");
		}
	}

	GltfMaterial load_material(const JsonView &p_json);

private:
	void load_image(size_t p_index);
	void load_sampler(const JsonView &p_texture, GltfTextureRef &r_ref);
	GltfTextureRef load_texture(const JsonView &p_info);
	void load_metallic_roughness(const JsonView &p_json, GltfMaterial &r_material);
	void load_specular(const JsonView &p_json, GltfMaterial &r_material);
	void load_alpha(const JsonView &p_json, GltfMaterial &r_material);
	void load_specular_glossiness(const JsonView &p_json, GltfMaterial &r_material);
	void warn_approximated(const JsonView &p_json);
	int32_t choose_image(const JsonView &p_texture);

	GltfContext &context;
	const GltfBuffers &buffers;
	JsonView json_images;
	JsonView json_textures;
	JsonView json_samplers;
	std::vector<bool> tried;
};

void MaterialLoader::load_image(size_t p_index) {
	if (tried[p_index]) {
		return;
	}
	tried[p_index] = true;
	const JsonView json = json_images.element(p_index);
	std::vector<std::byte> storage;
	std::span<const std::byte> bytes;
	const JsonView uri = json.member("uri");
	try {
		if (uri.present()) {
			storage = context.read_uri(uri);
			bytes = storage;
		} else {
			bytes = buffers.view(json.member("bufferView").to_index(buffers.view_count())).bytes;
		}
	} catch (const GltfFailure &failure) {
		context.report_error("{}; the texture is left out", failure.message);
		return;
	}
	Result<Image> image = load_image_from_memory(bytes, uri.present() && !uri.to_string().starts_with("data:") ? uri.to_string() : json.get_path());
	if (!image) {
		context.report_error("{}; the texture is left out", image.error().message);
		return;
	}
	context.charge(image.value().texels.size(), 1, json);
	context.document.images[p_index].image = std::make_shared<const Image>(image.take());
}

TextureWrap to_wrap(uint64_t p_value) {
	return p_value == 33071 ? TextureWrap::CLAMP : p_value == 33648 ? TextureWrap::MIRRORED_REPEAT
																	: TextureWrap::REPEAT;
}

void MaterialLoader::load_sampler(const JsonView &p_texture, GltfTextureRef &r_ref) {
	const int32_t index = p_texture.index_or_none("sampler", json_samplers.array_size());
	if (index < 0) {
		return;
	}
	const JsonView sampler = json_samplers.element(size_t(index));
	r_ref.wrap_u = to_wrap(sampler.uint_or("wrapS", 10497, UINT32_MAX));
	r_ref.wrap_v = to_wrap(sampler.uint_or("wrapT", 10497, UINT32_MAX));
	const bool nearest = sampler.uint_or("magFilter", 9729, UINT32_MAX) == 9728;
	const uint64_t min_filter = sampler.uint_or("minFilter", 9987, UINT32_MAX);
	const bool mipmaps = min_filter != 9728 && min_filter != 9729;
	r_ref.filter = nearest ? (mipmaps ? TextureFilter::NEAREST_MIPMAPS : TextureFilter::NEAREST) : (mipmaps ? TextureFilter::LINEAR_MIPMAPS : TextureFilter::LINEAR);
}

// The first that can be read, loaded: the WebP, else what every reader knows. -1: none.
int32_t MaterialLoader::choose_image(const JsonView &p_texture) {
	const JsonView basis = p_texture.extension("KHR_texture_basisu");
	const int32_t sources[] = { p_texture.extension("EXT_texture_webp").index_or_none("source", json_images.array_size()), p_texture.index_or_none("source", json_images.array_size()) };
	for (const int32_t source : sources) {
		if (source >= 0) {
			load_image(size_t(source));
			if (context.document.images[size_t(source)].image) {
				return source;
			}
		}
	}
	if (basis.present()) {
		context.warn("textures of KHR_texture_basisu are not read; factors alone give the colour where a texture has no other source");
	} else if (sources[0] < 0 && sources[1] < 0) {
		context.warn("{}: the texture has no source and is left out", p_texture.get_path());
	}
	return -1;
}

GltfTextureRef MaterialLoader::load_texture(const JsonView &p_info) {
	GltfTextureRef ref;
	if (!p_info.present()) {
		return ref;
	}
	const JsonView texture = json_textures.element(size_t(p_info.member("index").to_index(json_textures.array_size())));
	load_sampler(texture, ref);
	const int32_t image = choose_image(texture);
	if (image < 0) {
		return {};
	}
	if (!context.document.images[size_t(image)].image) {
		return {};
	}
	ref.image = image;
	const JsonView transform = p_info.extension("KHR_texture_transform");
	uint64_t uv_set = p_info.uint_or("texCoord", 0, UINT32_MAX);
	uv_set = transform.uint_or("texCoord", uv_set, UINT32_MAX);
	if (uv_set > 1) {
		context.warn("{}: TEXCOORD_{} is not supported; TEXCOORD_0 is used", p_info.get_path(), uv_set);
		uv_set = 0;
	}
	ref.uv_set = uint8_t(uv_set);
	float pair[2];
	if (transform.floats("offset", pair)) {
		ref.uv_offset = Vector2(pair[0], pair[1]);
	}
	if (transform.floats("scale", pair)) {
		ref.uv_scale = Vector2(pair[0], pair[1]);
	}
	ref.uv_rotation = transform.float_or("rotation", 0.0f);
	return ref;
}

void MaterialLoader::load_metallic_roughness(const JsonView &p_json, GltfMaterial &r_material) {
	float color[4];
	if (p_json.floats("baseColorFactor", color)) {
		r_material.base_color = glm::clamp(Vector4(color[0], color[1], color[2], color[3]), Vector4(0.0f), Vector4(1.0f));
	}
	r_material.metallic = p_json.float_in("metallicFactor", 1.0f, 0.0f, 1.0f);
	r_material.roughness = p_json.float_in("roughnessFactor", 1.0f, 0.0f, 1.0f);
	r_material.base_color_texture = load_texture(p_json.member("baseColorTexture"));
	r_material.metallic_roughness_texture = load_texture(p_json.member("metallicRoughnessTexture"));
}

void MaterialLoader::load_specular(const JsonView &p_json, GltfMaterial &r_material) {
	// KHR_materials_ior: f0 = ((ior - 1) / (ior + 1))^2, and 0 stands for f0 = 1. KHR_materials_specular scales it. Godot:
	// f0 = 0.16 * specular^2, at most 0.16.
	const float ior = p_json.extension("KHR_materials_ior").float_in("ior", 1.5f, 0.0f, 1e6f);
	const float ratio = ior == 0.0f ? 1.0f : (ior - 1.0f) / (ior + 1.0f);
	const JsonView specular = p_json.extension("KHR_materials_specular");
	const float factor = specular.float_in("specularFactor", 1.0f, 0.0f, 1.0f);
	r_material.specular = std::min(std::abs(ratio) * std::sqrt(factor / 0.16f), 1.0f);
	r_material.specular_tint = glm::max(specular.vector3_or("specularColorFactor", Vector3(1.0f)), Vector3(0.0f));
	for (const char *key : { "specularTexture", "specularColorTexture" }) {
		if (specular.member(key).present()) {
			context.warn("{}: is not supported and left out", specular.member(key).get_path());
		}
	}
}

void MaterialLoader::load_alpha(const JsonView &p_json, GltfMaterial &r_material) {
	const std::string mode = p_json.string_or("alphaMode", "OPAQUE");
	r_material.alpha_cutoff = p_json.float_or("alphaCutoff", 0.5f);
	if (mode == "MASK") {
		r_material.transparency = TransparencyMode::ALPHA_SCISSOR;
	} else if (mode == "BLEND") {
		r_material.transparency = TransparencyMode::ALPHA_BLEND;
	} else if (mode != "OPAQUE") {
		p_json.member("alphaMode").fail("expected OPAQUE, MASK or BLEND, found '{}'", mode);
	}
	const float transmission = p_json.extension("KHR_materials_transmission").float_in("transmissionFactor", 0.0f, 0.0f, 1.0f);
	if (transmission > 0.0f) {
		context.warn("KHR_materials_transmission is shown as alpha");
		// A tenth is left, so that clear glass can still be seen.
		r_material.base_color.a *= 1.0f - 0.9f * transmission;
		r_material.transparency = TransparencyMode::ALPHA_BLEND;
	}
}

void MaterialLoader::load_specular_glossiness(const JsonView &p_json, GltfMaterial &r_material) {
	if (!p_json.present()) {
		return;
	}
	SpecularGlossiness source;
	float color[4];
	if (p_json.floats("diffuseFactor", color)) {
		source.diffuse = glm::clamp(Vector4(color[0], color[1], color[2], color[3]), Vector4(0.0f), Vector4(1.0f));
	}
	source.specular = glm::clamp(p_json.vector3_or("specularFactor", Vector3(1.0f)), Vector3(0.0f), Vector3(1.0f));
	source.glossiness = p_json.float_in("glossinessFactor", 1.0f, 0.0f, 1.0f);
	r_material.base_color_texture = load_texture(p_json.member("diffuseTexture"));
	const GltfTextureRef specular = load_texture(p_json.member("specularGlossinessTexture"));
	if (specular.image < 0) {
		const MetallicRoughness made = to_metallic_roughness(source.diffuse, source.specular, source.glossiness);
		r_material.base_color = Vector4(made.base_color, source.diffuse.a);
		r_material.metallic = r_material.base_color_texture.image < 0 ? made.metallic : 0.0f; // the texture is the diffuse colour
		r_material.roughness = made.roughness;
		r_material.base_color = r_material.base_color_texture.image < 0 ? r_material.base_color : source.diffuse;
		return;
	}
	std::vector<GltfImage> &images = context.document.images;
	const std::shared_ptr<const Image> diffuse = r_material.base_color_texture.image < 0 ? nullptr : images[size_t(r_material.base_color_texture.image)].image;
	const Image &packed = *images[size_t(specular.image)].image;
	context.charge(uint64_t(std::max(packed.width, diffuse ? diffuse->width : 0)) * std::max(packed.height, diffuse ? diffuse->height : 0), 8, p_json);
	MetallicRoughnessImages made = to_metallic_roughness_images(source, diffuse, packed);
	r_material.base_color_texture = r_material.base_color_texture.image < 0 ? specular : r_material.base_color_texture;
	r_material.metallic_roughness_texture = specular;
	r_material.base_color_texture.image = int32_t(images.size());
	images.push_back({ r_material.name + " base colour", std::make_shared<const Image>(std::move(made.base_color)) });
	r_material.metallic_roughness_texture.image = int32_t(images.size());
	images.push_back({ r_material.name + " metallic roughness", std::make_shared<const Image>(std::move(made.metallic_roughness)) });
	r_material.base_color = Vector4(1.0f);
	r_material.metallic = 1.0f;
	r_material.roughness = 1.0f;
}

void MaterialLoader::warn_approximated(const JsonView &p_json) {
	static constexpr const char *EXTENSIONS[] = { "KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy", "KHR_materials_iridescence", "KHR_materials_volume", "KHR_materials_dispersion", "KHR_materials_diffuse_transmission" };
	for (const char *extension : EXTENSIONS) {
		if (p_json.extension(extension).present()) {
			context.warn("{} is left out: its materials show their base layer", extension);
		}
	}
}

GltfMaterial MaterialLoader::load_material(const JsonView &p_json) {
	GltfMaterial material;
	material.name = p_json.string_or("name", "");
	load_metallic_roughness(p_json.member("pbrMetallicRoughness"), material);
	load_specular(p_json, material);
	load_specular_glossiness(p_json.extension("KHR_materials_pbrSpecularGlossiness"), material);
	warn_approximated(p_json);
	load_alpha(p_json, material);
	const JsonView normal = p_json.member("normalTexture");
	material.normal_texture = load_texture(normal);
	material.normal_scale = normal.float_or("scale", 1.0f);
	const JsonView occlusion = p_json.member("occlusionTexture");
	material.occlusion_texture = load_texture(occlusion);
	material.occlusion_strength = occlusion.float_in("strength", 1.0f, 0.0f, 1.0f);
	material.emission_texture = load_texture(p_json.member("emissiveTexture"));
	const float strength = p_json.extension("KHR_materials_emissive_strength").float_in("emissiveStrength", 1.0f, 0.0f, 1e12f);
	material.emission = glm::clamp(p_json.vector3_or("emissiveFactor", Vector3(0.0f)), Vector3(0.0f), Vector3(1e12f)) * strength;
	material.double_sided = p_json.bool_or("doubleSided", false);
	material.unlit = p_json.extension("KHR_materials_unlit").present();
	return material;
}

} // namespace

void load_materials(GltfContext &r_context, const GltfBuffers &p_buffers) {
	MaterialLoader loader(r_context, p_buffers);
	const JsonView materials = r_context.root.member("materials");
	for (size_t i = 0; i < materials.array_size(); i++) {
		r_context.document.materials.push_back(loader.load_material(materials.element(i)));
	}
}

} // namespace lucent
