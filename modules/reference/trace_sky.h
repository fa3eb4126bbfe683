// SPDX-License-Identifier: MIT
#pragma once
// What rays that leave the scene see, and importance sampling of panoramas.

#include "servers/rendering/render_scene.h"

#include <vector>

namespace lucent {

struct DirectionSample {
	Vector3 direction; // towards the light, unit
	Vector3 radiance;
	float pdf = 0; // per steradian; 0: no sample
};

class TraceSky {
public:
	TraceSky() = default;
	TraceSky(const RenderScene &p_scene, ScenarioRid p_scenario, const Camera &p_camera);

	// Along a unit direction. The sun's disc, which ProceduralSkyMaterial paints, is for camera rays: lamps light everything else.
	Vector3 radiance(const Vector3 &p_direction, bool p_camera_ray) const;
	bool is_sampled() const { return !row_cdf.empty(); }
	DirectionSample sample(float p_random_u, float p_random_v) const;
	float pdf(const Vector3 &p_direction) const;

private:
	struct Sun {
		Vector3 direction; // towards it
		Vector3 radiance;
		float angular_radius = 0; // radians
	};
	Vector3 procedural(const Vector3 &p_direction, bool p_camera_ray) const;
	void build_panorama();
	Vector2 panorama_uv(const Vector3 &p_direction) const;

	bool has_sky = false;
	Vector3 color{ 0.0f };
	Sky sky;
	float energy = 1.0f;
	Basis sky_from_world = Basis(1.0f);
	Basis world_from_sky = Basis(1.0f);
	std::vector<Sun> suns;
	SceneTexture panorama;
	TextureRef panorama_ref;
	uint32_t width = 0;
	uint32_t height = 0;
	std::vector<float> row_cdf; // height + 1, ends at 1
	std::vector<float> texel_cdf; // by row: width + 1, ends at 1
};

} // namespace lucent
