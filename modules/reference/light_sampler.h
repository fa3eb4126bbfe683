// SPDX-License-Identifier: MIT
#pragma once
// Chooses lights to connect to: emissive triangles by power, lamps by what they would do at the point.

#include "modules/reference/random.h"
#include "modules/reference/trace_scene.h"

#include <vector>

namespace lucent {

// A point on an emissive triangle, seen from the shaded point.
struct EmitterSample {
	Vector3 position; // pushed off the emitter, on the side that faces the shaded point
	Vector3 direction; // towards it, unit
	Vector3 radiance; // with the emitter's own alpha
	float pdf = 0; // per steradian; 0: no sample
};

struct LampSample {
	Vector3 direction; // towards it, unit
	float distance_m = 0; // infinity for directional lights
	Vector3 power{ 0.0f }; // colour * energy * attenuation: a Lambertian surface reflects albedo * cos * power
	float specular = 1.0f;
	float shadow_opacity = 0.0f; // 0: casts no shadow
};

class LightSampler {
public:
	LightSampler() = default;
	// Sets first_emitter of r_trace's surfaces.
	LightSampler(const RenderScene &p_scene, ScenarioRid p_scenario, const RenderOrigin &p_origin, TraceScene &r_trace);

	bool has_emitters() const { return !emitters.empty(); }
	bool has_negative_lamps() const { return negative; }
	// pdf 0 where the point is below p_horizon, the surface's geometric normal.
	EmitterSample sample_emitter(const TraceScene &p_trace, const Vector3 &p_position, const Vector3 &p_horizon, Random &r_random) const;
	// Density over area (1 / m^2) with which sample_emitter chooses points of this triangle.
	float emitter_area_pdf(const TraceSurface &p_surface, uint32_t p_primitive) const {
		return p_surface.first_emitter == UINT32_MAX ? 0.0f : area_pdfs[p_surface.first_emitter + p_primitive];
	}
	uint32_t lamp_count() const { return uint32_t(lamps.size()); }
	// Chooses a lamp by what it would do unshadowed; UINT32_MAX: none reaches the point. p_indirect: after the first bounce, where
	// bake_mode and indirect_energy count.
	uint32_t choose_lamp(const Vector3 &p_position, const Vector3 &p_normal, bool p_indirect, Random &r_random, float &r_probability) const;
	LampSample sample_lamp(uint32_t p_lamp, const Vector3 &p_position, bool p_indirect, Random &r_random) const;

private:
	struct Emitter { // a triangle, gathered for one look-up
		uint32_t surface;
		uint32_t primitive;
		Vector3 corner;
		Vector3 edge1;
		Vector3 edge2;
		Vector3 normal; // unit, of the front
		float area_pdf; // 1 / m^2, choice included
		float offset_m; // that keeps a ray's end off the triangle
		Vector3 radiance; // where it is the same everywhere
		bool constant;
		bool shines[2]; // to the back, to the front
		// Alias table (Walker 1977; Vose, IEEE TSE 17(9) 1991): of this entry's draws, which part goes to the other emitter.
		uint32_t keep; // in units of 2^-32
		uint32_t alias;
	};
	struct Lamp {
		Light parameters;
		Vector3 position;
		Vector3 direction; // that it shines along
		Vector3 color; // times energy; negative for negative lamps
		float weight = 0; // mean of |color|
		float spot_cos = 0;
		float sun_cos = 1; // cosine of the sun's angular radius
	};
	void add_emitters(TraceScene &r_trace, uint32_t p_surface, std::vector<double> &r_weights);
	void build_alias_table(const std::vector<double> &p_weights, double p_total);
	const Emitter &choose_emitter(Random &r_random) const;
	void add_lamp(const Light &p_light, const Transform3D &p_transform);
	float attenuation(const Lamp &p_lamp, const Vector3 &p_to_lamp, float p_distance) const;
	float lamp_weight(const Lamp &p_lamp, const Vector3 &p_position, const Vector3 &p_normal, bool p_indirect) const;

	std::vector<Emitter> emitters;
	std::vector<float> area_pdfs; // by first_emitter + primitive; 0: never chosen
	bool negative = false; // one of the lamps is
	std::vector<Lamp> lamps;
};

} // namespace lucent
