// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/material.h"

namespace lucent::scene {

// A material for skies: fills in the server's description.
class SkyMaterial : public Material {
public:
	virtual void fill_sky(SceneContext &p_context, lucent::Sky &r_sky) const = 0;
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

private:
	Ref<Material> material;
	ConnectionID material_connection = 0;
	SkyRid rid;
};

} // namespace lucent::scene
