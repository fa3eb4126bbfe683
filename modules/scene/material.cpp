// SPDX-License-Identifier: MIT
#include "modules/scene/material.h"

#include "servers/core/class_builder.h"

namespace lucent::scene {

void Material::set_render_priority(int p_priority) {
	render_priority = p_priority;
	state_changed();
}

void BaseMaterial3D::set_state(const State &p_state) {
	state = p_state;
	state_changed();
}

MaterialRid BaseMaterial3D::get_rid(SceneContext &p_context) {
	return attach(p_context) ? rid : MaterialRid();
}

TextureRef BaseMaterial3D::texture_ref(SceneContext &p_context, TextureSlot p_slot, const Ref<Texture2D> &p_texture, TextureChannel p_channel, bool p_uv2) const {
	TextureRef ref;
	const std::optional<TextureRef> &sampling = state.sampling[size_t(p_slot)];
	if (sampling) {
		ref = *sampling;
	} else {
		const Vector3 &offset = p_uv2 ? state.uv2_offset : state.uv1_offset;
		const Vector3 &scale = p_uv2 ? state.uv2_scale : state.uv1_scale;
		ref.uv_set = p_uv2 ? 1 : 0;
		ref.uv_offset = Vector2(offset.x, offset.y);
		ref.uv_scale = Vector2(scale.x, scale.y);
		ref.filter = state.texture_filter;
		ref.wrap_u = ref.wrap_v = state.texture_repeat ? TextureWrap::REPEAT : TextureWrap::CLAMP;
	}
	ref.channel = p_channel;
	const bool srgb = p_slot == TextureSlot::ALBEDO || p_slot == TextureSlot::EMISSION;
	ref.texture = p_texture ? p_texture->get_rid(p_context, srgb) : TextureRid();
	return ref;
}

static TransparencyMode resolve_transparency(MaterialTransparency p_mode) {
	switch (p_mode) {
		case MaterialTransparency::DISABLED:
			return TransparencyMode::OPAQUE;
		case MaterialTransparency::ALPHA:
		case MaterialTransparency::ALPHA_DEPTH_PRE_PASS:
			return TransparencyMode::ALPHA_BLEND;
		case MaterialTransparency::ALPHA_SCISSOR:
		case MaterialTransparency::ALPHA_HASH:
			break;
	}
	return TransparencyMode::ALPHA_SCISSOR;
}

lucent::Material BaseMaterial3D::resolve(SceneContext &p_context) const {
	lucent::Material material;
	material.albedo = Vector4(srgb_to_linear(state.albedo_color), state.albedo_color.a);
	material.metallic = glm::clamp(state.metallic, 0.0f, 1.0f); // files may have any
	material.roughness = glm::clamp(state.roughness, 0.0f, 1.0f);
	material.specular = state.specular_mode == SpecularMode::DISABLED ? 0.0f : glm::clamp(state.metallic_specular, 0.0f, 1.0f);
	material.specular_tint = state.specular_tint;
	if (state.emission_enabled) {
		material.emission = srgb_to_linear(state.emission) * state.emission_energy_multiplier;
		material.emission_energy = state.emission_energy_multiplier;
		material.emission_on_texture_multiplies = state.emission_operator == EmissionOperator::MULTIPLY;
	}
	material.normal_scale = state.normal_scale;
	material.occlusion_strength = state.occlusion_strength;
	material.transparency = resolve_transparency(state.transparency);
	// Hashed alpha keeps half of the texels at one half.
	material.alpha_scissor_threshold = state.transparency == MaterialTransparency::ALPHA_HASH ? 0.5f : state.alpha_scissor_threshold;
	material.blend = state.blend_mode;
	material.cull = state.cull_mode;
	material.unshaded = state.shading_mode == MaterialShading::UNSHADED;
	material.vertex_color_use_as_albedo = state.vertex_color_use_as_albedo;
	material.render_priority = get_render_priority();
	const auto set_texture = [&](TextureSlot p_slot, const Ref<Texture2D> &p_texture, TextureChannel p_channel, bool p_uv2) {
		material.textures[size_t(p_slot)] = texture_ref(p_context, p_slot, p_texture, p_channel, p_uv2);
	};
	set_texture(TextureSlot::ALBEDO, state.albedo_texture, TextureChannel::RED, false);
	set_texture(TextureSlot::NORMAL, state.normal_enabled ? state.normal_texture : nullptr, TextureChannel::RED, false);
	if (is_orm()) {
		material.metallic = material.roughness = 1.0f;
		set_texture(TextureSlot::METALLIC, state.orm_texture, TextureChannel::BLUE, false);
		set_texture(TextureSlot::ROUGHNESS, state.orm_texture, TextureChannel::GREEN, false);
		set_texture(TextureSlot::OCCLUSION, state.ao_enabled ? state.orm_texture : nullptr, TextureChannel::RED, state.ao_on_uv2);
	} else {
		set_texture(TextureSlot::METALLIC, state.metallic_texture, state.metallic_texture_channel, false);
		set_texture(TextureSlot::ROUGHNESS, state.roughness_texture, state.roughness_texture_channel, false);
		set_texture(TextureSlot::OCCLUSION, state.ao_enabled ? state.ao_texture : nullptr, state.ao_texture_channel, state.ao_on_uv2);
	}
	set_texture(TextureSlot::EMISSION, state.emission_enabled ? state.emission_texture : nullptr, TextureChannel::RED, state.emission_on_uv2);
	return material;
}

void BaseMaterial3D::send(SceneContext &p_context) {
	if (!rid.is_valid()) {
		rid = p_context.server().material_create();
	}
	p_context.server().material_set(rid, resolve(p_context));
}

void BaseMaterial3D::free_server_objects(RenderingServer &p_server) {
	p_server.free(rid);
	rid = {};
}

void Material::bind(ClassBuilder<Material> &r_class) {
	r_class.doc("How something is coloured.");
	r_class.property("render_priority", &Material::set_render_priority, &Material::get_render_priority).range(-128, 127, 1).enforced().doc("Blended surfaces of higher priority are drawn later.");
}

void ORMMaterial3D::bind(ClassBuilder<ORMMaterial3D> &r_class) {
	r_class.doc("As StandardMaterial3D, but that one texture holds occlusion, roughness and metallic; their own textures and factors have no effect.");
}

void StandardMaterial3D::bind(ClassBuilder<StandardMaterial3D> &r_class) {
	r_class.doc("A physically based material with a texture for each parameter.");
}

} // namespace lucent::scene
