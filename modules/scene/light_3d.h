// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/visual_instance_3d.h"

namespace lucent::scene {

// Base of all lights; shines along -z. Energies and attenuation are Godot's: see lucent::Light.
class Light3D : public VisualInstance3D {
	LUCENT_CLASS(Light3D, VisualInstance3D)
public:
	Light3D() = default;
	void set_color(const Color &p_srgb);
	Color get_color() const { return color; }
	void set_editor_only(bool p_editor_only);
	bool is_editor_only() const { return editor_only; }
	const lucent::Light &get_parameters() const { return parameters; }
	// The type stays, and the colour is not used: see set_color.
	void set_parameters(const lucent::Light &p_parameters);
	void state_changed();

protected:
	explicit Light3D(LightType p_type) { parameters.type = p_type; }
	void send_instance(RenderingServer &p_server) override;
	void free_base(RenderingServer &p_server) override;
	bool is_shown() const override { return !editor_only && is_visible_in_tree(); }

	lucent::Light parameters;

private:
	Color color{ 1, 1, 1, 1 }; // sRGB-encoded
	bool editor_only = false;
	LightRid light;
};

// A sun: parallel rays from far away.
class DirectionalLight3D : public Light3D {
	LUCENT_CLASS(DirectionalLight3D, Light3D)
public:
	DirectionalLight3D() :
			Light3D(LightType::DIRECTIONAL) {}
};

// A lamp that shines to all sides.
class OmniLight3D : public Light3D {
	LUCENT_CLASS(OmniLight3D, Light3D)
public:
	OmniLight3D();
};

// A lamp that shines in a cone around -z.
class SpotLight3D : public Light3D {
	LUCENT_CLASS(SpotLight3D, Light3D)
public:
	SpotLight3D();
};

} // namespace lucent::scene
