// SPDX-License-Identifier: MIT
#pragma once
// One path from the camera: the estimator. Unbiased; next-event estimation and BRDF sampling are combined with the power
// heuristic (Veach 1997, section 9.2).

#include "modules/reference/light_sampler.h"
#include "modules/reference/trace_scene.h"
#include "modules/reference/trace_sky.h"

#include <vector>

namespace lucent {

// Everything that paths read, immutable while they are traced.
struct TraceWorld {
	std::unique_ptr<TraceScene> scene;
	LightSampler lights;
	TraceSky sky;
	Camera camera;
};

// What the first surface shows, apart.
struct PathLayers {
	Vector3 direct{ 0.0f };
	Vector3 emission{ 0.0f };
	Vector3 background{ 0.0f };
	Vector3 albedo{ 0.0f };
	Vector3 normal{ 0.0f };
	float depth_m = 0; // along the camera's axis; 0: no surface
};

// Pixels to rays for a picture's size; clip planes are the ray's near and far.
class CameraRays {
public:
	CameraRays(const Camera &p_camera, uint32_t p_width, uint32_t p_height);
	Ray ray(float p_x, float p_y) const; // in pixels from the top left
	float depth_m(const Vector3 &p_position) const { return glm::dot(p_position - transform.origin, forward); }

private:
	Transform3D transform;
	Vector3 forward;
	Vector2 half_size; // of the picture at distance 1, or in metres (orthogonal)
	Vector2 shift{ 0.0f };
	Vector2 pixel_scale;
	float near_m, far_m;
	bool orthogonal;
};

class PathIntegrator {
public:
	PathIntegrator(const TraceWorld &p_world, const CameraRays &p_camera_rays) :
			world(p_world), scene(*p_world.scene), camera_rays(p_camera_rays) {}

	// Radiance through a point of the picture. r_layers: empty ones, or null.
	Vector3 trace(float p_x, float p_y, Random &r_random, PathLayers *r_layers);

	uint64_t ray_count = 0;
	std::vector<Ray> *recording = nullptr; // each traced ray is added, for measure_throughput()

private:
	struct Path {
		Ray ray;
		Vector3 throughput{ 1.0f };
		float pdf = 0; // of the BRDF sample that made the ray
		uint32_t bounce = 0;
		Vector3 radiance{ 0.0f };
		PathLayers *first = nullptr; // until the first bounce, where layers are asked for
	};
	// What a bounce or a connection needs of the surface.
	struct Vertex {
		SurfacePoint point;
		Vector3 view; // towards where the path came from
		float specular_share = 0; // probability of sampling the specular lobe
		bool lambertian = false;
	};
	RayHit next_hit(Path &r_path, Random &r_random);
	Vector3 visibility(const Vertex &p_vertex, const Vector3 &p_direction, float p_distance, RayMask p_mask);
	void add_emission(Path &r_path, const RayHit &p_hit, const Vertex &p_vertex, const TraceMaterial &p_material);
	void add_background(Path &r_path);
	void add_emitter_light(Path &r_path, const Vertex &p_vertex, Random &r_random);
	void add_sky_light(Path &r_path, const Vertex &p_vertex, Random &r_random);
	void add_lamps_light(Path &r_path, const Vertex &p_vertex, Random &r_random);
	// What the surface sends towards the view of a lamp's light.
	Vector3 lamp_light(const Vertex &p_vertex, const LampSample &p_sample, bool p_indirect);
	// False: the surface let the path through, which goes on behind it.
	bool resolve_blend(Path &r_path, const Vertex &p_vertex, const Material &p_material, Random &r_random);
	bool sample_direction(Path &r_path, const Vertex &p_vertex, Random &r_random);
	bool survive(Path &r_path, Random &r_random);
	void start_ray(Path &r_path, const SurfacePoint &p_point, const Vector3 &p_direction);

	const TraceWorld &world;
	const TraceScene &scene;
	const CameraRays &camera_rays;
};

} // namespace lucent
