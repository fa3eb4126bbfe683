// SPDX-License-Identifier: MIT
#pragma once
// A scenario flattened for tracing: one Embree geometry for each surface of each visible instance, in world space.

#include "modules/reference/texel_group.h"
#include "servers/core/error.h"
#include "servers/rendering/render_origin.h"
#include "servers/rendering/render_scene.h"
#include "servers/rendering/shaders/brdf.h"

#include <memory>
#include <vector>

struct RTCSceneTy;
struct RTCDeviceTy;

namespace lucent {

// Which rays find a surface; Embree's geometry masks.
enum RayMask : uint32_t {
	RAY_CAMERA = 1,
	RAY_BOUNCE = 2, // and shadow rays to emissive surfaces and the sky, so that both ways of finding them agree
	RAY_LAMP_SHADOW = 4,
};

struct TraceMaterial {
	static constexpr uint32_t MAX_GROUPS = 5; // albedo, normal, metallic, roughness, emission: each apart at worst
	Material parameters;
	struct TextureRead {
		uint8_t group = 0;
		uint8_t member = 0;
	};
	std::vector<TexelGroup> groups; // at most MAX_GROUPS
	TextureRead reads[size_t(TextureSlot::COUNT)]; // where each texture is
	uint32_t texture_mask = 0; // bit: slot; without textures that transport ignores
	brdf::BrdfLobes lobes; // where no texture or vertex colour changes them
	bool constant = false; // lobes and albedo hold everywhere
	bool lambertian = false; // no specular lobe anywhere
	bool shines = false; // has an emission or a texture of it
	bool emissive = false; // emits somewhere, and light sampling may find it

	bool has_texture(TextureSlot p_slot) const { return (texture_mask >> uint32_t(p_slot)) & 1; }
	bool visible_from(bool p_front) const {
		return parameters.cull == MaterialCull::DISABLED || p_front == (parameters.cull == MaterialCull::BACK);
	}
};

// A vertex in world space, within one cache line: meshes keep their attributes in arrays of their own, which a hit would miss one by one.
struct alignas(64) TraceVertex {
	Vector3 position;
	Vector3 normal; // of any length; 0: the mesh has none
	Vector4 tangent; // xyz: of any length; w: handedness, 0: the mesh has none
	Vector2 uvs[2];
};

struct TraceSurface {
	std::shared_ptr<const MeshSurface> mesh;
	const TraceVertex *vertices = nullptr; // also Embree's buffer
	float orientation = 1.0f; // -1: mirrored, front faces are clockwise in world space
	float opacity = 1.0f; // 1 - the instance's transparency
	uint32_t material = 0;
	uint32_t first_emitter = UINT32_MAX; // of its triangles in LightSampler; set there
};

struct RayHit {
	uint32_t surface = UINT32_MAX;
	uint32_t primitive = 0;
	float u = 0; // weight of the triangle's second vertex
	float v = 0; // … third
	float distance = 0; // in units of the direction's length

	bool is_hit() const { return surface != UINT32_MAX; }
};

// What shading needs of a hit. Normals point to the side that the ray came from.
struct SurfacePoint {
	Vector3 position;
	Vector3 geometric_normal;
	Vector3 normal;
	Vector3 albedo;
	brdf::BrdfLobes lobes;
	float alpha = 1.0f;
	float offset_m = 0; // that keeps the next ray off this surface
	bool front = true;
};

struct Ray {
	Vector3 origin;
	Vector3 direction;
	float near = 0;
	float far = std::numeric_limits<float>::infinity();
};

class TraceScene {
public:
	// All positions are relative to p_origin. p_camera's layers decide what camera rays see.
	static Result<std::unique_ptr<TraceScene>> create(const RenderScene &p_scene, ScenarioRid p_scenario, const Camera &p_camera, const RenderOrigin &p_origin);
	~TraceScene();

	// p_noise: any bits that differ from ray to ray; they decide stochastic transparency.
	RayHit intersect(const Ray &p_ray, RayMask p_mask, uint32_t p_noise) const;
	// What part of light gets along the ray: 1 nothing in the way, 0 all blocked, between: through blended surfaces.
	Vector3 transmittance(const Ray &p_ray, RayMask p_mask) const;

	// rtcIntersect1 with nothing around it, the yardstick for throughput. Returns how many rays hit.
	uint64_t count_hits(const std::vector<Ray> &p_rays) const;

	SurfacePoint shade(const RayHit &p_hit, const Vector3 &p_ray_direction) const;
	// Radiance that the surface emits on its visible sides.
	Vector3 emission(uint32_t p_surface, uint32_t p_primitive, float p_u, float p_v) const;
	float alpha(uint32_t p_surface, uint32_t p_primitive, float p_u, float p_v) const;
	// Albedo with textures and vertex colour; alpha with the instance's transparency.
	Vector4 albedo(const TraceSurface &p_surface, uint32_t p_primitive, float p_u, float p_v) const;

	const TraceMaterial &material_of(uint32_t p_surface) const { return materials[surfaces[p_surface].material]; }

	std::vector<TraceSurface> surfaces; // by Embree's geometry id
	std::vector<TraceMaterial> materials;

private:
	TraceScene() = default;
	// p_transform: the instance's, relative to the origin.
	void add_instance(const RenderScene &p_scene, const Instance &p_instance, const Transform3D &p_transform, const Mesh &p_mesh, uint32_t p_cull_mask);
	uint32_t add_material(const RenderScene &p_scene, const Material *p_material);
	void add_textures(const RenderScene &p_scene, TraceMaterial &r_material);
	void add_geometry(TraceSurface p_surface, const Transform3D &p_transform, uint32_t p_mask);

	RTCDeviceTy *device = nullptr;
	RTCSceneTy *embree_scene = nullptr;
	HugeArena arena; // vertices and texels
	std::vector<std::pair<const Material *, uint32_t>> material_indices;
};

} // namespace lucent
