// SPDX-License-Identifier: MIT
// Surface attributes at a hit: normals, textures, BRDF, emission.
#include "modules/reference/texture_sampling.h"
#include "modules/reference/trace_scene.h"

namespace lucent {

namespace {

struct Corners {
	const TraceVertex &a, &b, &c;
};

const uint32_t *triangle(const TraceSurface &p_surface, uint32_t p_primitive) {
	return p_surface.mesh->indices.data() + 3 * size_t(p_primitive);
}

Corners corners_of(const TraceSurface &p_surface, uint32_t p_primitive) {
	const uint32_t *indices = triangle(p_surface, p_primitive);
	return { p_surface.vertices[indices[0]], p_surface.vertices[indices[1]], p_surface.vertices[indices[2]] };
}

template <typename T>
T barycentric(const T &p_a, const T &p_b, const T &p_c, float p_u, float p_v) {
	return p_a * (1.0f - p_u - p_v) + p_b * p_u + p_c * p_v;
}

TexelFootprint footprint_at(const TexelGroup &p_group, const Corners &p_corners, float p_u, float p_v) {
	const uint8_t set = p_group.uv_set();
	return p_group.footprint(barycentric(p_corners.a.uvs[set], p_corners.b.uvs[set], p_corners.c.uvs[set], p_u, p_v));
}

// One slot alone.
Vector4 fetch(const TraceSurface &p_surface, const TraceMaterial &p_material, TextureSlot p_slot, uint32_t p_primitive, float p_u, float p_v) {
	const TraceMaterial::TextureRead read = p_material.reads[size_t(p_slot)];
	const TexelGroup &group = p_material.groups[read.group];
	return group.read(footprint_at(group, corners_of(p_surface, p_primitive), p_u, p_v), read.member);
}

// All textures of a material at one hit.
class HitTextures {
public:
	HitTextures(const TraceMaterial &p_material, const Corners &p_corners, const RayHit &p_hit) :
			material(p_material) {
		for (size_t i = 0; i < material.groups.size(); i++) {
			footprints[i] = footprint_at(material.groups[i], p_corners, p_hit.u, p_hit.v);
		}
	}
	Vector4 read(TextureSlot p_slot) const {
		const TraceMaterial::TextureRead read = material.reads[size_t(p_slot)];
		return material.has_texture(p_slot) ? material.groups[read.group].read(footprints[read.group], read.member) : Vector4(1.0f);
	}

private:
	const TraceMaterial &material;
	TexelFootprint footprints[TraceMaterial::MAX_GROUPS];
};

float max_component(const Vector3 &p_value) {
	return std::max(p_value.x, std::max(p_value.y, p_value.z));
}

// World-space tangent and handedness; from the texture coordinates where the mesh has none.
Vector4 tangent_at(const TraceSurface &p_surface, const Corners &p_corners, uint8_t p_uv_set, const RayHit &p_hit) {
	if (p_corners.a.tangent.w != 0.0f) {
		return Vector4(barycentric(Vector3(p_corners.a.tangent), Vector3(p_corners.b.tangent), Vector3(p_corners.c.tangent), p_hit.u, p_hit.v), barycentric(p_corners.a.tangent.w, p_corners.b.tangent.w, p_corners.c.tangent.w, p_hit.u, p_hit.v) < 0.0f ? -1.0f : 1.0f);
	}
	const Vector3 edge1 = p_corners.b.position - p_corners.a.position;
	const Vector3 edge2 = p_corners.c.position - p_corners.a.position;
	const Vector2 uv1 = p_corners.b.uvs[p_uv_set] - p_corners.a.uvs[p_uv_set];
	const Vector2 uv2 = p_corners.c.uvs[p_uv_set] - p_corners.a.uvs[p_uv_set];
	const float determinant = uv1.x * uv2.y - uv2.x * uv1.y;
	// v points down in glTF and Godot, the bitangent up: hence the sign.
	return Vector4((edge1 * uv2.y - edge2 * uv1.y) * (determinant < 0.0f ? -1.0f : 1.0f), (determinant < 0.0f ? 1.0f : -1.0f) * p_surface.orientation);
}

Vector3 mapped_normal(const TraceMaterial &p_material, const Vector3 &p_texel, const Vector4 &p_tangent, const Vector3 &p_normal) {
	const Vector3 along = Vector3(p_tangent) - p_normal * glm::dot(p_normal, Vector3(p_tangent));
	const float square = glm::dot(along, along);
	if (!(square > 1e-36f)) {
		return p_normal;
	}
	const Vector3 t = along * (1.0f / std::sqrt(square));
	const Vector3 b = glm::cross(p_normal, t) * p_tangent.w;
	const Vector2 slope = Vector2(p_texel) * 2.0f - 1.0f;
	const float z = std::sqrt(std::max(0.0f, 1.0f - glm::dot(slope, slope)));
	return glm::normalize((t * slope.x + b * slope.y) * p_material.parameters.normal_scale + p_normal * std::max(z, 1e-3f));
}

Vector4 albedo_of(const TraceSurface &p_surface, const TraceMaterial &p_material, const Vector4 &p_texel, uint32_t p_primitive, float p_u, float p_v) {
	Vector4 value = p_material.parameters.albedo * p_texel;
	if (const std::vector<Vector4> &colors = p_surface.mesh->colors; p_material.parameters.vertex_color_use_as_albedo && !colors.empty()) {
		const uint32_t *indices = triangle(p_surface, p_primitive);
		value *= barycentric(colors[indices[0]], colors[indices[1]], colors[indices[2]], p_u, p_v);
	}
	if (p_material.parameters.transparency == TransparencyMode::OPAQUE) {
		value.w = 1.0f;
	}
	value.w = glm::clamp(value.w * p_surface.opacity, 0.0f, 1.0f);
	return value;
}

brdf::BrdfLobes lobes_of(const TraceMaterial &p_material, const HitTextures &p_textures, const Vector3 &p_albedo) {
	const Material &parameters = p_material.parameters;
	const auto factor = [&](TextureSlot p_slot) { return select_channel(p_textures.read(p_slot), parameters.textures[size_t(p_slot)].channel); };
	const float metallic = parameters.metallic == 0.0f ? 0.0f : parameters.metallic * factor(TextureSlot::METALLIC);
	return brdf::brdf_lobes(p_albedo, metallic, parameters.roughness * factor(TextureSlot::ROUGHNESS), parameters.specular, parameters.specular_tint);
}

} // namespace

Vector4 TraceScene::albedo(const TraceSurface &p_surface, uint32_t p_primitive, float p_u, float p_v) const {
	const TraceMaterial &material = materials[p_surface.material];
	const Vector4 texel = material.has_texture(TextureSlot::ALBEDO) ? fetch(p_surface, material, TextureSlot::ALBEDO, p_primitive, p_u, p_v) : Vector4(1.0f);
	return albedo_of(p_surface, material, texel, p_primitive, p_u, p_v);
}

float TraceScene::alpha(uint32_t p_surface, uint32_t p_primitive, float p_u, float p_v) const {
	const TraceSurface &surface = surfaces[p_surface];
	const Material &material = materials[surface.material].parameters;
	if (material.transparency == TransparencyMode::OPAQUE) {
		return surface.opacity;
	}
	const float value = albedo(surface, p_primitive, p_u, p_v).w;
	if (material.transparency == TransparencyMode::ALPHA_SCISSOR) {
		return value >= material.alpha_scissor_threshold ? 1.0f : 0.0f;
	}
	return value;
}

Vector3 TraceScene::emission(uint32_t p_surface, uint32_t p_primitive, float p_u, float p_v) const {
	const TraceSurface &surface = surfaces[p_surface];
	const TraceMaterial &material = materials[surface.material];
	if (!material.has_texture(TextureSlot::EMISSION)) {
		return material.parameters.emission;
	}
	const Vector3 texture = Vector3(fetch(surface, material, TextureSlot::EMISSION, p_primitive, p_u, p_v));
	return material.parameters.emission_on_texture_multiplies ? material.parameters.emission * texture
															  : material.parameters.emission + texture * material.parameters.emission_energy;
}

SurfacePoint TraceScene::shade(const RayHit &p_hit, const Vector3 &p_ray_direction) const {
	const TraceSurface &surface = surfaces[p_hit.surface];
	const TraceMaterial &material = materials[surface.material];
	const Corners corners = corners_of(surface, p_hit.primitive);
	const HitTextures textures(material, corners, p_hit);
	const Vector3 &p0 = corners.a.position;
	const Vector3 edge1 = corners.b.position - p0;
	const Vector3 edge2 = corners.c.position - p0;

	SurfacePoint point;
	point.position = p0 + edge1 * p_hit.u + edge2 * p_hit.v;
	// Rounding of the interpolation: a few units in the last place of the largest coordinate involved.
	point.offset_m = 1e-6f + 2e-6f * (max_component(glm::abs(p0)) + max_component(glm::abs(edge1)) + max_component(glm::abs(edge2)));
	point.geometric_normal = glm::normalize(glm::cross(edge1, edge2)) * surface.orientation;
	point.front = glm::dot(point.geometric_normal, p_ray_direction) < 0.0f;
	point.normal = point.geometric_normal;
	const Vector3 normal = barycentric(corners.a.normal, corners.b.normal, corners.c.normal, p_hit.u, p_hit.v);
	if (const float square = glm::dot(normal, normal); square > 1e-30f) {
		point.normal = normal * (1.0f / std::sqrt(square));
	}
	if (material.has_texture(TextureSlot::NORMAL)) {
		const uint8_t uv_set = material.parameters.textures[size_t(TextureSlot::NORMAL)].uv_set;
		point.normal = mapped_normal(material, Vector3(textures.read(TextureSlot::NORMAL)), tangent_at(surface, corners, uv_set, p_hit), point.normal);
	}
	if (!point.front) {
		point.geometric_normal = -point.geometric_normal;
		point.normal = -point.normal;
	}
	// Seen from below its shading normal: bend the normal until it is seen edge-on.
	const float facing = -glm::dot(point.normal, p_ray_direction);
	if (facing < 1e-3f) {
		point.normal = glm::normalize(point.normal - p_ray_direction * (1e-3f - facing));
	}
	if (material.constant && material.parameters.transparency == TransparencyMode::OPAQUE) {
		point.albedo = Vector3(material.parameters.albedo);
		point.lobes = material.lobes;
	} else {
		const Vector4 value = albedo_of(surface, material, textures.read(TextureSlot::ALBEDO), p_hit.primitive, p_hit.u, p_hit.v);
		point.albedo = Vector3(value);
		point.alpha = value.w;
		point.lobes = lobes_of(material, textures, point.albedo);
	}
	return point;
}

} // namespace lucent
