// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/texture.h"

#include <array>
#include <optional>

namespace lucent::scene {

// How something is coloured. A surface can only be drawn with a BaseMaterial3D; skies have materials of their own.
class Material : public ServerResource {
	LUCENT_CLASS(Material, Resource)
public:
	~Material() override { leave_context(); }
	// Invalid: not a material for surfaces.
	virtual MaterialRid get_rid(SceneContext &) { return {}; }
	// -128 to 127; blended surfaces of higher priority are drawn later.
	void set_render_priority(int p_priority);
	int get_render_priority() const { return render_priority; }

protected:
	void send(SceneContext &) override {}
	void free_server_objects(RenderingServer &) override {}

private:
	int render_priority = 0;
};

enum class MaterialShading : uint8_t {
	UNSHADED,
	PER_PIXEL,
	PER_VERTEX
};
enum class MaterialTransparency : uint8_t {
	DISABLED,
	ALPHA,
	ALPHA_SCISSOR,
	ALPHA_HASH,
	ALPHA_DEPTH_PRE_PASS
};
enum class EmissionOperator : uint8_t {
	ADD,
	MULTIPLY
};
enum class SpecularMode : uint8_t {
	SCHLICK_GGX,
	TOON,
	DISABLED
};

// Godot's standard material: metallic-roughness with textures. Colours are sRGB-encoded.
class BaseMaterial3D : public Material {
	LUCENT_CLASS(BaseMaterial3D, Material)
public:
	struct State {
		Color albedo_color{ 1, 1, 1, 1 };
		Ref<Texture2D> albedo_texture;
		float metallic = 0.0f;
		float metallic_specular = 0.5f;
		Ref<Texture2D> metallic_texture;
		TextureChannel metallic_texture_channel = TextureChannel::RED;
		float roughness = 1.0f;
		Ref<Texture2D> roughness_texture;
		TextureChannel roughness_texture_channel = TextureChannel::RED;
		bool emission_enabled = false;
		Color emission{ 0, 0, 0, 1 };
		float emission_energy_multiplier = 1.0f;
		EmissionOperator emission_operator = EmissionOperator::ADD;
		bool emission_on_uv2 = false;
		Ref<Texture2D> emission_texture;
		bool normal_enabled = false;
		float normal_scale = 1.0f;
		Ref<Texture2D> normal_texture;
		bool ao_enabled = false;
		bool ao_on_uv2 = false;
		Ref<Texture2D> ao_texture;
		TextureChannel ao_texture_channel = TextureChannel::RED;
		Ref<Texture2D> orm_texture; // of ORMMaterial3D alone, where it takes the place of the three above it and of their factors
		MaterialTransparency transparency = MaterialTransparency::DISABLED;
		float alpha_scissor_threshold = 0.5f;
		MaterialBlend blend_mode = MaterialBlend::MIX;
		MaterialCull cull_mode = MaterialCull::BACK;
		MaterialShading shading_mode = MaterialShading::PER_PIXEL;
		SpecularMode specular_mode = SpecularMode::SCHLICK_GGX;
		bool vertex_color_use_as_albedo = false;
		TextureFilter texture_filter = TextureFilter::LINEAR_MIPMAPS;
		bool texture_repeat = true;
		Vector3 uv1_offset{ 0.0f };
		Vector3 uv1_scale{ 1.0f };
		Vector3 uv2_offset{ 0.0f };
		Vector3 uv2_scale{ 1.0f };

		// What glTF has beyond Godot's properties; not in the registry.
		Vector3 specular_tint{ 1.0f }; // KHR_materials_specular's colour, linear
		float occlusion_strength = 1.0f;
		// Where set: the slot's wrap, filter and transform, in place of texture_* and uv*; texture and channel still come from above.
		std::array<std::optional<TextureRef>, size_t(TextureSlot::COUNT)> sampling;
	};

	~BaseMaterial3D() override { leave_context(); }
	const State &get_state() const { return state; }
	void set_state(const State &p_state);
	MaterialRid get_rid(SceneContext &p_context) override;
	// As the server takes it.
	lucent::Material resolve(SceneContext &p_context) const;

protected:
	void send(SceneContext &p_context) override;
	void free_server_objects(RenderingServer &p_server) override;

private:
	virtual bool is_orm() const { return false; }
	TextureRef texture_ref(SceneContext &p_context, TextureSlot p_slot, const Ref<Texture2D> &p_texture, TextureChannel p_channel, bool p_uv2) const;

	State state;
	MaterialRid rid;
};

class StandardMaterial3D : public BaseMaterial3D {
	LUCENT_CLASS(StandardMaterial3D, BaseMaterial3D)
};

// One texture for occlusion (red), roughness (green) and metallic (blue); white without it.
class ORMMaterial3D : public BaseMaterial3D {
	LUCENT_CLASS(ORMMaterial3D, BaseMaterial3D)
	bool is_orm() const override { return true; }
};

} // namespace lucent::scene
