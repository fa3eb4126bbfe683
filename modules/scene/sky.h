// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/material.h"

namespace lucent::scene {

// A material for skies: fills in the server's description.
class SkyMaterial : public Material {
public:
	virtual void fill_sky(SceneContext &p_context, lucent::Sky &r_sky) const = 0;
	// Whether fill_sky would answer otherwise though no property changed.
	virtual bool is_stale(SceneContext &) const { return false; }
};

// A gradient from horizon to zenith, another below, and a disc for each sun.
class ProceduralSkyMaterial : public SkyMaterial {
	LUCENT_CLASS(ProceduralSkyMaterial, Material)
public:
	struct State {
		Color sky_top_color{ 0.385f, 0.454f, 0.55f, 1.0f }; // sRGB-encoded, as all four
		Color sky_horizon_color{ 0.6463f, 0.6558f, 0.6708f, 1.0f };
		Color ground_bottom_color{ 0.2f, 0.169f, 0.133f, 1.0f };
		Color ground_horizon_color{ 0.6463f, 0.6558f, 0.6708f, 1.0f };
	} state;
	lucent::Sky curves; // and energies; its colours are not used
	void fill_sky(SceneContext &p_context, lucent::Sky &r_sky) const override;
};

// An equirectangular picture.
class PanoramaSkyMaterial : public SkyMaterial {
	LUCENT_CLASS(PanoramaSkyMaterial, Material)
public:
	struct State {
		Ref<Texture2D> panorama;
		float energy_multiplier = 1.0f;
	} state;
	void fill_sky(SceneContext &p_context, lucent::Sky &r_sky) const override;
};

// Scattering of the first sun in the sky by air and haze: Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight" (1999) with
// the simplifications and the look of Godot's material of this name. It is drawn into a panorama when the sun or a property changes;
// the sun's disc is left out, for the sun itself lights the scene.
class PhysicalSkyMaterial : public SkyMaterial {
	LUCENT_CLASS(PhysicalSkyMaterial, Material)
public:
	struct State {
		float rayleigh_coefficient = 2.0f;
		Color rayleigh_color{ 0.3f, 0.405f, 0.6f, 1.0f }; // sRGB-encoded, as all colours here
		float mie_coefficient = 0.005f;
		float mie_eccentricity = 0.8f;
		Color mie_color{ 0.69f, 0.729f, 0.812f, 1.0f };
		float turbidity = 10.0f;
		float sun_disk_scale = 1.0f;
		Color ground_color{ 0.1f, 0.07f, 0.034f, 1.0f };
		float energy_multiplier = 1.0f;
		bool use_debanding = true;
		Ref<Texture2D> night_sky;
	} state;
	struct Sun {
		Vector3 direction{ 0.0f }; // towards it; 0: there is none
		float energy = 0.0f;
		bool operator==(const Sun &) const = default;
	};
	void fill_sky(SceneContext &p_context, lucent::Sky &r_sky) const override;
	bool is_stale(SceneContext &p_context) const override { return !(find_sun(p_context) == drawn_sun); }
	// Linear light from p_direction (a unit vector).
	Vector3 radiance(const Vector3 &p_direction, const Sun &p_sun) const;

private:
	static Sun find_sun(SceneContext &p_context);

	Ref<ImageTexture> panorama = std::make_shared<ImageTexture>();
	mutable Sun drawn_sun;
};

class Sky : public ServerResource {
	LUCENT_CLASS(Sky, Resource)
public:
	~Sky() override;
	// A material that is not for skies draws none.
	void set_material(const Ref<Material> &p_material);
	Ref<Material> get_material() const { return material; }
	SkyRid get_rid(SceneContext &p_context);

protected:
	void send(SceneContext &p_context) override;
	void free_server_objects(RenderingServer &p_server) override;
	bool is_stale(SceneContext &p_context) const override;

private:
	Ref<Material> material;
	ConnectionID material_connection = 0;
	SkyRid rid;
};

} // namespace lucent::scene
