// SPDX-License-Identifier: MIT
#include "modules/reference/trace_scene.h"

#include "modules/reference/random.h"

#include <embree3/rtcore.h>

#include <cstring>

namespace lucent {

namespace {

struct RayContext {
	RTCIntersectContext embree;
	const TraceScene *scene;
	Vector3 transmittance;
	uint32_t noise;
	bool shadow;
};

// Called for hits on surfaces that aren't simply opaque. Blend modes other than MIX are resolved by the path, as surfaces.
void filter_hit(const RTCFilterFunctionNArguments *p_arguments) {
	RayContext &context = *reinterpret_cast<RayContext *>(p_arguments->context);
	const RTCHit &hit = *reinterpret_cast<const RTCHit *>(p_arguments->hit);
	const TraceScene &scene = *context.scene;
	const Material &material = scene.material_of(hit.geomID).parameters;
	const Vector4 albedo = scene.albedo(scene.surfaces[hit.geomID], hit.primID, hit.u, hit.v);
	if (material.transparency == TransparencyMode::ALPHA_SCISSOR) {
		p_arguments->valid[0] = albedo.w >= material.alpha_scissor_threshold ? -1 : 0;
		return;
	}
	if (!context.shadow) {
		const uint64_t bits = mix_bits(uint64_t(context.noise) << 32 ^ uint64_t(hit.geomID) << 24 ^ hit.primID);
		p_arguments->valid[0] = material.blend != MaterialBlend::MIX || float(bits >> 40) * 0x1p-24f < albedo.w ? -1 : 0;
		return;
	}
	switch (material.blend) {
		case MaterialBlend::MIX:
		case MaterialBlend::PREMULTIPLIED:
			context.transmittance *= 1.0f - albedo.w;
			break;
		case MaterialBlend::MUL:
			context.transmittance *= Vector3(albedo);
			break;
		case MaterialBlend::ADD:
		case MaterialBlend::SUB:
			break;
	}
	p_arguments->valid[0] = context.transmittance == Vector3(0.0f) ? -1 : 0;
}

RayContext make_context(const TraceScene *p_scene, bool p_shadow, uint32_t p_noise) {
	RayContext context;
	rtcInitIntersectContext(&context.embree);
	context.scene = p_scene;
	context.transmittance = Vector3(1.0f);
	context.noise = p_noise;
	context.shadow = p_shadow;
	return context;
}

RTCRayHit make_query(const Ray &p_ray, uint32_t p_mask) {
	RTCRayHit query;
	query.ray = { p_ray.origin.x, p_ray.origin.y, p_ray.origin.z, p_ray.near, p_ray.direction.x, p_ray.direction.y, p_ray.direction.z, 0.0f, p_ray.far, p_mask, 0, 0 };
	query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
	query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
	return query;
}

bool needs_filter(const TraceMaterial &p_material, const TraceSurface &p_surface) {
	return p_material.parameters.transparency != TransparencyMode::OPAQUE || p_surface.opacity < 1.0f;
}

} // namespace

TraceScene::~TraceScene() {
	if (embree_scene) {
		rtcReleaseScene(embree_scene);
	}
	if (device) {
		rtcReleaseDevice(device);
	}
}

Result<std::unique_ptr<TraceScene>> TraceScene::create(const RenderScene &p_scene, ScenarioRid p_scenario, const Camera &p_camera, const RenderOrigin &p_origin) {
	std::unique_ptr<TraceScene> scene(new TraceScene);
	scene->device = rtcNewDevice(nullptr);
	if (!scene->device) {
		return make_error("Embree could not start: error {}", int(rtcGetDeviceError(nullptr)));
	}
	scene->embree_scene = rtcNewScene(scene->device);
	// Robust: no ray slips between the triangles of a sealed room.
	rtcSetSceneFlags(scene->embree_scene, RTC_SCENE_FLAG_ROBUST);
	p_scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
		const Mesh *mesh = p_scene.meshes.get(p_instance.mesh);
		if (mesh && p_instance.scenario == p_scenario && p_instance.visible) {
			scene->add_instance(p_scene, p_instance, p_origin.render_from_world(p_instance.transform), *mesh, p_camera.cull_mask);
		}
	});
	scene->material_indices.clear();
	rtcCommitScene(scene->embree_scene);
	if (const RTCError error = rtcGetDeviceError(scene->device); error != RTC_ERROR_NONE) {
		return make_error("Embree could not build the scene: error {}", int(error));
	}
	return scene;
}

void TraceScene::add_instance(const RenderScene &p_scene, const Instance &p_instance, const Transform3D &p_transform, const Mesh &p_mesh, uint32_t p_cull_mask) {
	uint32_t mask = 0;
	if (p_instance.shadow_casting != ShadowCasting::SHADOWS_ONLY) {
		mask |= RAY_BOUNCE | ((p_instance.layers & p_cull_mask) ? uint32_t(RAY_CAMERA) : 0u);
	}
	if (p_instance.shadow_casting != ShadowCasting::OFF) {
		mask |= RAY_LAMP_SHADOW;
	}
	for (uint32_t i = 0; i < p_mesh.surfaces.size(); i++) {
		TraceSurface surface;
		surface.mesh = p_mesh.surfaces[i];
		surface.orientation = glm::determinant(p_instance.transform.basis) < 0.0f ? -1.0f : 1.0f;
		surface.opacity = 1.0f - glm::clamp(p_instance.transparency, 0.0f, 1.0f);
		surface.material = add_material(p_scene, p_scene.surface_material(p_instance, p_mesh, i));
		add_geometry(std::move(surface), p_transform, mask);
	}
}

uint32_t TraceScene::add_material(const RenderScene &p_scene, const Material *p_material) {
	for (const auto &[known, index] : material_indices) {
		if (known == p_material) {
			return index;
		}
	}
	TraceMaterial material;
	if (p_material) {
		material.parameters = *p_material;
	}
	const Material &parameters = material.parameters;
	add_textures(p_scene, material);
	material.lobes = brdf::brdf_lobes(Vector3(parameters.albedo), parameters.metallic, parameters.roughness, parameters.specular, parameters.specular_tint);
	material.constant = !material.has_texture(TextureSlot::ALBEDO) && !material.has_texture(TextureSlot::METALLIC) &&
			!material.has_texture(TextureSlot::ROUGHNESS) && !parameters.vertex_color_use_as_albedo;
	// metallic multiplies its texture, so 0 stays 0.
	material.lambertian = parameters.metallic == 0.0f && (parameters.specular == 0.0f || parameters.specular_tint == Vector3(0.0f));
	const bool emission_texture = material.has_texture(TextureSlot::EMISSION) && !parameters.emission_on_texture_multiplies && parameters.emission_energy != 0.0f;
	material.shines = parameters.emission != Vector3(0.0f) || material.has_texture(TextureSlot::EMISSION);
	material.emissive = !parameters.unshaded && parameters.blend == MaterialBlend::MIX && (parameters.emission != Vector3(0.0f) || emission_texture);
	materials.push_back(material);
	material_indices.emplace_back(p_material, uint32_t(materials.size() - 1));
	return uint32_t(materials.size() - 1);
}

// Slots that read the same texels share a group, materials with the same textures share their memory.
void TraceScene::add_textures(const RenderScene &p_scene, TraceMaterial &r_material) {
	const Material &parameters = r_material.parameters;
	for (const TextureSlot slot : { TextureSlot::ALBEDO, TextureSlot::NORMAL, TextureSlot::METALLIC, TextureSlot::ROUGHNESS, TextureSlot::EMISSION }) {
		const TextureRef &ref = parameters.textures[size_t(slot)];
		const SceneTexture *texture = p_scene.textures.get(ref.texture);
		if (!texture || !texture->image || texture->image->is_empty()) {
			continue;
		}
		uint32_t group = 0, member = 0;
		while (group < r_material.groups.size() && !r_material.groups[group].add(*texture, ref, member)) {
			group++;
		}
		if (group == r_material.groups.size()) {
			r_material.groups.emplace_back().add(*texture, ref, member);
		}
		r_material.reads[size_t(slot)] = { uint8_t(group), uint8_t(member) };
		r_material.texture_mask |= 1u << uint32_t(slot);
	}
	for (TexelGroup &group : r_material.groups) {
		const TexelGroup *same = nullptr;
		for (const TraceMaterial &other : materials) {
			for (const TexelGroup &candidate : other.groups) {
				same = group.holds_same_texels(candidate) ? &candidate : same;
			}
		}
		if (same) {
			group.share(*same);
		} else {
			group.build(arena);
		}
	}
}

static void fill_vertices(const MeshSurface &p_mesh, const Transform3D &p_transform, float p_orientation, TraceVertex *r_vertices) {
	const Basis &basis = p_transform.basis;
	// The cofactor matrix: inverse transpose times the determinant, defined for flattened bases too.
	const Basis normal_basis = Basis(glm::cross(basis[1], basis[2]), glm::cross(basis[2], basis[0]), glm::cross(basis[0], basis[1])) * p_orientation;
	const std::vector<Vector2> &uv2s = p_mesh.uv2s.empty() ? p_mesh.uvs : p_mesh.uv2s;
	for (size_t i = 0; i < p_mesh.positions.size(); i++) {
		TraceVertex vertex = { p_transform.xform(p_mesh.positions[i]), Vector3(0.0f), Vector4(0.0f), { Vector2(0.0f), Vector2(0.0f) } };
		if (!p_mesh.normals.empty()) {
			vertex.normal = normal_basis * p_mesh.normals[i];
		}
		if (!p_mesh.tangents.empty()) {
			vertex.tangent = Vector4(basis * Vector3(p_mesh.tangents[i]), (p_mesh.tangents[i].w < 0.0f ? -1.0f : 1.0f) * p_orientation);
		}
		vertex.uvs[0] = p_mesh.uvs.empty() ? Vector2(0.0f) : p_mesh.uvs[i];
		vertex.uvs[1] = uv2s.empty() ? Vector2(0.0f) : uv2s[i];
		r_vertices[i] = vertex;
	}
}

void TraceScene::add_geometry(TraceSurface p_surface, const Transform3D &p_transform, uint32_t p_mask) {
	const MeshSurface &mesh = *p_surface.mesh;
	auto *const vertices = reinterpret_cast<TraceVertex *>(arena.allocate(mesh.positions.size() * sizeof(TraceVertex)));
	fill_vertices(mesh, p_transform, p_surface.orientation, vertices);
	const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
	rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, offsetof(TraceVertex, position), sizeof(TraceVertex), mesh.positions.size());
	rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0, 3 * sizeof(uint32_t), mesh.indices.size() / 3);
	if (needs_filter(materials[p_surface.material], p_surface)) {
		rtcSetGeometryIntersectFilterFunction(geometry, filter_hit);
		rtcSetGeometryOccludedFilterFunction(geometry, filter_hit);
	}
	rtcSetGeometryMask(geometry, p_mask);
	rtcCommitGeometry(geometry);
	p_surface.vertices = vertices;
	rtcAttachGeometryByID(embree_scene, geometry, uint32_t(surfaces.size()));
	surfaces.push_back(std::move(p_surface));
	rtcReleaseGeometry(geometry);
}

RayHit TraceScene::intersect(const Ray &p_ray, RayMask p_mask, uint32_t p_noise) const {
	RayContext context = make_context(this, false, p_noise);
	RTCRayHit query = make_query(p_ray, p_mask);
	rtcIntersect1(embree_scene, &context.embree, &query);
	return { query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar };
}

Vector3 TraceScene::transmittance(const Ray &p_ray, RayMask p_mask) const {
	RayContext context = make_context(this, true, 0);
	RTCRay query = make_query(p_ray, p_mask).ray;
	rtcOccluded1(embree_scene, &context.embree, &query);
	return query.tfar < 0.0f ? Vector3(0.0f) : context.transmittance;
}

uint64_t TraceScene::count_hits(const std::vector<Ray> &p_rays) const {
	RayContext context = make_context(this, false, 0);
	uint64_t hits = 0;
	for (const Ray &ray : p_rays) {
		RTCRayHit query = make_query(ray, RAY_BOUNCE);
		rtcIntersect1(embree_scene, &context.embree, &query);
		hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
	}
	return hits;
}

} // namespace lucent
