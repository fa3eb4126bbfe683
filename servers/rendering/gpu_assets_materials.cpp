// SPDX-License-Identifier: MIT
#include "servers/rendering/brdf_table.h"
#include "servers/rendering/gi_reflectance.h"
#include "servers/rendering/gpu_assets.h"
#include "servers/rendering/texture_mips.h"

#include <algorithm>
#include <cstring>

#include <glm/gtc/packing.hpp>

namespace lucent {

namespace {
// Godot's default level of anisotropic filtering.
constexpr float MAX_ANISOTROPY = 4.0f;

template <typename T>
T read_as(const std::vector<std::byte> &p_bytes) {
	T value{};
	std::memcpy(&value, p_bytes.data(), std::min(sizeof(T), p_bytes.size()));
	return value;
}

AddressMode address_mode(TextureWrap p_wrap) {
	switch (p_wrap) {
		case TextureWrap::MIRRORED_REPEAT:
			return AddressMode::MIRRORED_REPEAT;
		case TextureWrap::CLAMP:
			return AddressMode::CLAMP_TO_EDGE;
		default:
			return AddressMode::REPEAT;
	}
}

SamplerDesc sampler_desc(const TextureRef &p_ref) {
	SamplerDesc desc;
	const bool nearest = p_ref.filter == TextureFilter::NEAREST || p_ref.filter == TextureFilter::NEAREST_MIPMAPS || p_ref.filter == TextureFilter::NEAREST_MIPMAPS_ANISOTROPIC;
	const bool mips = p_ref.filter >= TextureFilter::NEAREST_MIPMAPS;
	const bool anisotropic = p_ref.filter >= TextureFilter::NEAREST_MIPMAPS_ANISOTROPIC;
	desc.mag_filter = desc.min_filter = nearest ? Filter::NEAREST : Filter::LINEAR;
	desc.address_u = address_mode(p_ref.wrap_u);
	desc.address_v = address_mode(p_ref.wrap_v);
	desc.max_lod = mips ? 1000.0f : 0.0f;
	desc.max_anisotropy = anisotropic ? MAX_ANISOTROPY : 1.0f;
	return desc;
}

shader::UvTransform uv_transform(const TextureRef &p_ref) {
	const float c = std::cos(p_ref.uv_rotation);
	const float s = std::sin(p_ref.uv_rotation);
	return { Vector3(c * p_ref.uv_scale.x, s * p_ref.uv_scale.y, p_ref.uv_offset.x), Vector3(-s * p_ref.uv_scale.x, c * p_ref.uv_scale.y, p_ref.uv_offset.y) };
}

uint32_t material_flags(const Material &p_material) {
	uint32_t flags = 0;
	flags |= p_material.unshaded ? MATERIAL_FLAG_UNSHADED : 0;
	flags |= p_material.vertex_color_use_as_albedo ? MATERIAL_FLAG_VERTEX_COLOR : 0;
	flags |= p_material.transparency == TransparencyMode::ALPHA_SCISSOR ? MATERIAL_FLAG_ALPHA_SCISSOR : 0;
	flags |= p_material.transparency == TransparencyMode::ALPHA_BLEND ? MATERIAL_FLAG_ALPHA_BLEND : 0;
	flags |= p_material.cull == MaterialCull::DISABLED ? MATERIAL_FLAG_DOUBLE_SIDED : 0;
	flags |= p_material.cull == MaterialCull::FRONT ? MATERIAL_FLAG_CULL_FRONT : 0;
	flags |= p_material.emission_on_texture_multiplies ? 0 : MATERIAL_FLAG_EMISSION_ADD;
	return flags;
}
} // namespace

OwnedTexture GpuAssets::make_pixel(uint32_t p_rgba, const char *p_name) {
	OwnedTexture texture = device.create_texture({ .format = Format::RGBA8_UNORM, .name = p_name });
	device.upload_texture(texture, 0, 0, std::as_bytes(std::span(&p_rgba, 1)));
	return texture;
}

OwnedTexture GpuAssets::make_environment_brdf() {
	std::vector<uint32_t> texels;
	for (const Vector2 &value : BrdfTable::get().values()) {
		texels.push_back(glm::packHalf2x16(value));
	}
	TextureDesc desc;
	desc.format = Format::RG16_FLOAT;
	desc.width = desc.height = BrdfTable::SIZE;
	desc.name = "scene.environment_brdf";
	OwnedTexture texture = device.create_texture(desc);
	device.upload_texture(texture, 0, 0, std::as_bytes(std::span(texels)));
	return texture;
}

OwnedTexture GpuAssets::make_texture(const SceneTexture &p_texture, const std::string &p_name, Vector4 &r_mean) {
	const Image &image = *p_texture.image;
	const uint32_t limit = device.info().max_texture_2d_texels;
	if (image.width > limit || image.height > limit) {
		log_warning("a texture of {}x{} exceeds the device's limit of {} texels, it is drawn white", image.width, image.height, limit);
		r_mean = Vector4(1.0f);
		return make_pixel(0xFFFFFFFFu, "scene.too_large");
	}
	const std::vector<std::vector<std::byte>> levels = make_mip_chain(image, p_texture.srgb);
	TextureDesc desc;
	desc.format = image.format == ImageFormat::RGBA32F ? Format::RGBA16_FLOAT : p_texture.srgb ? Format::RGBA8_SRGB
																							   : Format::RGBA8_UNORM;
	desc.width = image.width;
	desc.height = image.height;
	desc.mips = uint32_t(levels.size());
	r_mean = desc.format == Format::RGBA16_FLOAT ? glm::unpackHalf4x16(read_as<uint64_t>(levels.back())) : glm::unpackUnorm4x8(read_as<uint32_t>(levels.back()));
	desc.name = p_name;
	OwnedTexture texture = device.create_texture(desc);
	for (uint32_t mip = 0; mip < levels.size(); mip++) {
		device.upload_texture(texture, mip, 0, levels[mip]);
	}
	return texture;
}

void GpuAssets::update_textures(const RenderScene &p_scene) {
	std::vector<bool> alive(textures.size(), false);
	p_scene.textures.for_each([&](TextureRid p_rid, const SceneTexture &p_texture) {
		if (p_rid.index >= textures.size()) {
			textures.resize(p_rid.index + 1);
			alive.resize(p_rid.index + 1);
		}
		alive[p_rid.index] = true;
		GpuTexture &texture = textures[p_rid.index];
		if (texture.version != p_texture.version) {
			texture.texture = make_texture(p_texture, fmt::format("scene.texture{}", p_rid.index), texture.mean);
			texture.version = p_texture.version;
		}
	});
	for (size_t i = 0; i < textures.size(); i++) {
		if (!alive[i]) {
			textures[i] = GpuTexture();
		}
	}
}

TextureHandle GpuAssets::texture(TextureRid p_texture) const {
	const bool exists = p_texture.index < textures.size() && textures[p_texture.index].texture.is_valid();
	return exists ? textures[p_texture.index].texture : white_texture;
}

void GpuAssets::update_gi_textures(const RenderScene &p_scene) {
	std::vector<std::pair<TextureRid, uint64_t>> layers;
	p_scene.materials.for_each([&](MaterialRid, const Material &p_material) {
		for (const TextureSlot slot : { TextureSlot::ALBEDO, TextureSlot::EMISSION }) {
			const TextureRid rid = p_material.textures[size_t(slot)].texture;
			const SceneTexture *texture = p_scene.textures.get(rid);
			if (texture != nullptr && std::none_of(layers.begin(), layers.end(), [&](const auto &p_layer) { return p_layer.first == rid; })) {
				layers.emplace_back(rid, texture->version);
			}
		}
	});
	if (gi_array.is_valid() && layers == gi_layers) {
		return;
	}
	gi_layers = layers;
	TextureDesc desc;
	desc.type = TextureType::TEXTURE_2D_ARRAY;
	desc.format = Format::RGBA8_SRGB;
	desc.width = desc.height = GI_TEXTURE_SIZE_TEXELS;
	desc.layers = uint32_t(std::max<size_t>(layers.size(), 1));
	desc.name = "scene.gi_textures";
	gi_array = device.create_texture(desc);
	for (uint32_t i = 0; i < layers.size(); i++) {
		const SceneTexture &texture = *p_scene.textures.get(layers[i].first);
		device.upload_texture(gi_array, 0, i, make_square_copy(*texture.image, texture.srgb, GI_TEXTURE_SIZE_TEXELS));
	}
	if (layers.empty()) {
		device.upload_texture(gi_array, 0, 0, std::vector<std::byte>(size_t(GI_TEXTURE_SIZE_TEXELS) * GI_TEXTURE_SIZE_TEXELS * 4, std::byte(255)));
	}
}

float GpuAssets::mean_of(const Material &p_material, TextureSlot p_slot, float p_factor) const {
	const TextureRef &ref = p_material.textures[size_t(p_slot)];
	if (ref.texture.index >= textures.size() || !textures[ref.texture.index].texture.is_valid()) {
		return p_factor;
	}
	const Vector4 &mean = textures[ref.texture.index].mean;
	return p_factor * (ref.channel == TextureChannel::GRAYSCALE ? (mean.x + mean.y + mean.z) / 3.0f : mean[int(ref.channel)]);
}

shader::MaterialData GpuAssets::material_data(const Material &p_material) const {
	shader::MaterialData data{};
	data.albedo = p_material.albedo;
	data.emission = p_material.emission;
	data.emission_energy = p_material.emission_energy;
	data.specular_tint = p_material.specular_tint;
	data.specular = p_material.specular;
	data.metallic = p_material.metallic;
	data.roughness = p_material.roughness;
	data.normal_scale = p_material.normal_scale;
	data.occlusion_strength = p_material.occlusion_strength;
	data.alpha_scissor_threshold = p_material.alpha_scissor_threshold;
	data.flags = material_flags(p_material);
	data.gi_albedo_layer = data.gi_emission_layer = -1;
	const GiReflectance reflectance = gi_reflectance(p_material, mean_of(p_material, TextureSlot::METALLIC, p_material.metallic), mean_of(p_material, TextureSlot::ROUGHNESS, p_material.roughness));
	data.gi_of_albedo = reflectance.of_albedo;
	data.gi_added = reflectance.added;
	for (uint32_t i = 0; i < MATERIAL_SLOT_COUNT; i++) {
		const TextureRef &ref = p_material.textures[i];
		data.uv2_mask |= ref.uv_set == 1 ? 1u << i : 0u;
		data.channels |= uint32_t(ref.channel) << (4 * i);
		data.uv_transforms[i] = uv_transform(ref);
	}
	for (size_t i = 0; i < gi_layers.size(); i++) {
		if (gi_layers[i].first == p_material.textures[MATERIAL_SLOT_ALBEDO].texture) {
			data.gi_albedo_layer = int(i);
		}
		if (gi_layers[i].first == p_material.textures[MATERIAL_SLOT_EMISSION].texture) {
			data.gi_emission_layer = int(i);
		}
	}
	return data;
}

OwnedBindingSet GpuAssets::make_material_set(const Material &p_material) const {
	std::vector<SetBinding> bindings(MATERIAL_SLOT_COUNT);
	for (uint32_t i = 0; i < MATERIAL_SLOT_COUNT; i++) {
		const TextureRef &ref = p_material.textures[i];
		bindings[i].binding = i;
		bindings[i].sampler = device.sampler(sampler_desc(ref));
		bindings[i].texture = texture(ref.texture);
		if (bindings[i].texture == white_texture.handle()) {
			if (i == MATERIAL_SLOT_NORMAL) {
				bindings[i].texture = flat_normal_texture;
			} else if (i == MATERIAL_SLOT_EMISSION && !p_material.emission_on_texture_multiplies) {
				bindings[i].texture = black_texture;
			}
		}
	}
	return device.create_binding_set(bindings, "scene.material");
}

void GpuAssets::update_materials(const RenderScene &p_scene) {
	std::vector<shader::MaterialData> values = { material_data(Material()) };
	if (materials.empty()) {
		materials.emplace_back();
		materials[DEFAULT_MATERIAL].set = make_material_set(Material());
	}
	p_scene.materials.for_each([&](MaterialRid p_rid, const Material &p_material) {
		const uint32_t index = material_index(p_rid);
		if (index >= materials.size()) {
			materials.resize(index + 1);
		}
		if (index >= values.size()) {
			values.resize(index + 1, values[DEFAULT_MATERIAL]);
		}
		values[index] = material_data(p_material);
		if (materials[index].version != p_material.version) {
			materials[index].set = make_material_set(p_material);
			materials[index].version = p_material.version;
		}
	});
	const uint64_t size_bytes = values.size() * sizeof(shader::MaterialData);
	const bool same = values.size() == material_values.size() && std::memcmp(values.data(), material_values.data(), size_bytes) == 0;
	const bool remade = materials_buffer.reserve(device, size_bytes, BUFFER_STORAGE, "scene.materials");
	if (remade || !same) {
		device.upload_buffer(materials_buffer.buffer, values);
		material_values = std::move(values);
	}
}

} // namespace lucent
