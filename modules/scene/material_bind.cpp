// SPDX-License-Identifier: MIT
// The properties of BaseMaterial3D.
#include "modules/scene/material.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

static void bind_enums(ClassBuilder<BaseMaterial3D> &r_class) {
	r_class.enumeration("TextureFilter", { { "TEXTURE_FILTER_NEAREST", 0 }, { "TEXTURE_FILTER_LINEAR", 1 }, { "TEXTURE_FILTER_NEAREST_WITH_MIPMAPS", 2 }, { "TEXTURE_FILTER_LINEAR_WITH_MIPMAPS", 3 }, { "TEXTURE_FILTER_NEAREST_WITH_MIPMAPS_ANISOTROPIC", 4 }, { "TEXTURE_FILTER_LINEAR_WITH_MIPMAPS_ANISOTROPIC", 5 } });
	r_class.enumeration("TextureChannel", { { "TEXTURE_CHANNEL_RED", TextureChannel::RED }, { "TEXTURE_CHANNEL_GREEN", TextureChannel::GREEN }, { "TEXTURE_CHANNEL_BLUE", TextureChannel::BLUE }, { "TEXTURE_CHANNEL_ALPHA", TextureChannel::ALPHA }, { "TEXTURE_CHANNEL_GRAYSCALE", TextureChannel::GRAYSCALE } });
	r_class.enumeration("Transparency", { { "TRANSPARENCY_DISABLED", MaterialTransparency::DISABLED }, { "TRANSPARENCY_ALPHA", MaterialTransparency::ALPHA }, { "TRANSPARENCY_ALPHA_SCISSOR", MaterialTransparency::ALPHA_SCISSOR }, { "TRANSPARENCY_ALPHA_HASH", MaterialTransparency::ALPHA_HASH }, { "TRANSPARENCY_ALPHA_DEPTH_PRE_PASS", MaterialTransparency::ALPHA_DEPTH_PRE_PASS } });
	r_class.enumeration("ShadingMode", { { "SHADING_MODE_UNSHADED", MaterialShading::UNSHADED }, { "SHADING_MODE_PER_PIXEL", MaterialShading::PER_PIXEL }, { "SHADING_MODE_PER_VERTEX", MaterialShading::PER_VERTEX } });
	r_class.enumeration("BlendMode", { { "BLEND_MODE_MIX", MaterialBlend::MIX }, { "BLEND_MODE_ADD", MaterialBlend::ADD }, { "BLEND_MODE_SUB", MaterialBlend::SUB }, { "BLEND_MODE_MUL", MaterialBlend::MUL }, { "BLEND_MODE_PREMULT_ALPHA", MaterialBlend::PREMULTIPLIED } });
	r_class.enumeration("CullMode", { { "CULL_BACK", MaterialCull::BACK }, { "CULL_FRONT", MaterialCull::FRONT }, { "CULL_DISABLED", MaterialCull::DISABLED } });
	r_class.enumeration("SpecularMode", { { "SPECULAR_SCHLICK_GGX", SpecularMode::SCHLICK_GGX }, { "SPECULAR_TOON", SpecularMode::TOON }, { "SPECULAR_DISABLED", SpecularMode::DISABLED } });
	r_class.enumeration("EmissionOperator", { { "EMISSION_OP_ADD", EmissionOperator::ADD }, { "EMISSION_OP_MULTIPLY", EmissionOperator::MULTIPLY } });
}

void BaseMaterial3D::bind(ClassBuilder<BaseMaterial3D> &r_class) {
	r_class.doc("Metallic-roughness material with a texture for each parameter. Colours are sRGB-encoded.");
	bind_enums(r_class);
	constexpr auto S = &BaseMaterial3D::state;
	r_class.field("transparency", S, &State::transparency).enum_of("Transparency").doc("How alpha acts; hashed alpha is cut at one half, depth pre-pass blends.");
	r_class.field("alpha_scissor_threshold", S, &State::alpha_scissor_threshold).range(0, 1, 0.001).doc("Alpha below this is cut away, with TRANSPARENCY_ALPHA_SCISSOR.");
	r_class.field("blend_mode", S, &State::blend_mode).enum_of("BlendMode").doc("How a blended surface meets what is behind it.");
	r_class.field("cull_mode", S, &State::cull_mode).enum_of("CullMode").doc("Which side of a triangle is not drawn.");
	r_class.field("shading_mode", S, &State::shading_mode).enum_of("ShadingMode").doc("Whether light acts; per-vertex shading is done per pixel.");
	r_class.field("specular_mode", S, &State::specular_mode).enum_of("SpecularMode").doc("The specular lobe; toon is drawn as Schlick-GGX.");
	r_class.field("vertex_color_use_as_albedo", S, &State::vertex_color_use_as_albedo).doc("Multiplies albedo by the vertex colour.");
	r_class.field("albedo_color", S, &State::albedo_color).doc("The base colour; its alpha acts by transparency.");
	r_class.field("albedo_texture", S, &State::albedo_texture).doc("Multiplies albedo_color.");
	r_class.field("metallic", S, &State::metallic).range(0, 1, 0.01).doc("0 is a dielectric, 1 is a metal.");
	r_class.field("metallic_specular", S, &State::metallic_specular).range(0, 1, 0.01).doc("Reflectance of a dielectric along the normal is 0.16 times its square; 0.5 gives 4 %.");
	r_class.field("metallic_texture", S, &State::metallic_texture).doc("Multiplies metallic.");
	r_class.field("metallic_texture_channel", S, &State::metallic_texture_channel).enum_of("TextureChannel").doc("The channel of metallic_texture that counts.");
	r_class.field("roughness", S, &State::roughness).range(0, 1, 0.01).doc("Perceptual roughness; its square is the GGX alpha.");
	r_class.field("roughness_texture", S, &State::roughness_texture).doc("Multiplies roughness.");
	r_class.field("roughness_texture_channel", S, &State::roughness_texture_channel).enum_of("TextureChannel").doc("The channel of roughness_texture that counts.");
	r_class.field("emission_enabled", S, &State::emission_enabled).doc("Whether the surface shines by itself.");
	r_class.field("emission", S, &State::emission).doc("The colour of the emitted light.");
	r_class.field("emission_energy_multiplier", S, &State::emission_energy_multiplier).range(0, 16, 0.01).or_greater().doc("Multiplies the emitted light.");
	r_class.field("emission_operator", S, &State::emission_operator).enum_of("EmissionOperator").doc("How emission and emission_texture combine.");
	r_class.field("emission_on_uv2", S, &State::emission_on_uv2).doc("Reads emission_texture with the second texture coordinates.");
	r_class.field("emission_texture", S, &State::emission_texture).doc("The pattern of the emitted light.");
	r_class.field("normal_enabled", S, &State::normal_enabled).doc("Whether normal_texture acts.");
	r_class.field("normal_scale", S, &State::normal_scale).range(-16, 16, 0.01).doc("Strength of normal_texture.");
	r_class.field("normal_texture", S, &State::normal_texture).doc("Tangent-space normals, y up (OpenGL).");
	r_class.field("ao_enabled", S, &State::ao_enabled).doc("Whether ao_texture acts.");
	r_class.field("ao_on_uv2", S, &State::ao_on_uv2).doc("Reads ao_texture with the second texture coordinates.");
	r_class.field("ao_texture", S, &State::ao_texture).doc("Dims indirect light.");
	r_class.field("ao_texture_channel", S, &State::ao_texture_channel).enum_of("TextureChannel").doc("The channel of ao_texture that counts.");
	r_class.field("orm_texture", S, &State::orm_texture).doc("Of ORMMaterial3D: occlusion in red, roughness in green, metallic in blue; without one all are 1.");
	r_class.field("texture_filter", S, &State::texture_filter).enum_of("TextureFilter").doc("How textures are magnified and minified.");
	r_class.field("texture_repeat", S, &State::texture_repeat).doc("Whether textures repeat outside of 0 to 1, or clamp.");
	r_class.field("uv1_offset", S, &State::uv1_offset).doc("Added to the first texture coordinates, after the scale.");
	r_class.field("uv1_scale", S, &State::uv1_scale).doc("Multiplies the first texture coordinates.");
	r_class.field("uv2_offset", S, &State::uv2_offset).doc("Added to the second texture coordinates, after the scale.");
	r_class.field("uv2_scale", S, &State::uv2_scale).doc("Multiplies the second texture coordinates.");
}

} // namespace lucent::scene
