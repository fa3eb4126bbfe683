// SPDX-License-Identifier: MIT
// Surface attributes at a hit: normals, textures, BRDF, emission.
#include "modules/reference/texture_sampling.h"
#include "modules/reference/trace_scene.h"

namespace lucent {

namespace {

// Barycentric mean of a vertex array.
template <typename T>
T interpolate(const std::vector<T> &p_values, const uint32_t *p_indices, float p_u, float p_v) {
	return p_values[p_indices[0]] * (1.0f - p_u - p_v) + p_values[p_indices[1]] * p_u + p_values[p_indices[2]] * p_v;
}

const uint32_t *triangle(const TraceSurface &p_surface, uint32_t p_primitive) {
	return p_surface.mesh->indices.data() + 3 * size_t(p_primitive);
}

const std::vector<Vector2> &uv_array(const MeshSurface &p_mesh, uint8_t p_set) {
	return p_set == 1 && !p_mesh.uv2s.empty() ? p_mesh.uv2s : p_mesh.uvs;
}

Vector4 fetch(const TraceSurface &p_surface, const TraceMaterial &p_material, TextureSlot p_slot, uint32_t p_primitive, float p_u, float p_v) {
	const TextureRef &ref = p_material.parameters.textures[size_t(p_slot)];
	const std::vector<Vector2> &uvs = uv_array(*p_surface.mesh, ref.uv_set);
	const Vector2 uv = uvs.empty() ? Vector2(0.0f) : interpolate(uvs, triangle(p_surface, p_primitive), p_u, p_v);
	return sample_texture(p_material.textures[size_t(p_slot)], ref, uv);
}

float max_component(const Vector3 &p_value) {
	return std::max(p_value.x, std::max(p_value.y, p_value.z));
}

// World-space tangent and handedness; from the texture coordinates where the mesh has none.
Vector4 tangent_at(const TraceSurface &p_surface, const TextureRef &p_ref, const RayHit &p_hit) {
	const MeshSurface &mesh = *p_surface.mesh;
	const uint32_t *indices = triangle(p_surface, p_hit.primitive);
	if (!mesh.tangents.empty()) {
		const Vector4 local = interpolate(mesh.tangents, indices, p_hit.u, p_hit.v);
		return Vector4(p_surface.basis * Vector3(local), (local.w < 0.0f ? -1.0f : 1.0f) * p_surface.orientation);
	}
	const std::vector<Vector2> &uvs = uv_array(mesh, p_ref.uv_set);
	if (uvs.empty()) {
		return Vector4(0.0f);
	}
	const Vector3 edge1 = p_surface.positions[indices[1]] - p_surface.positions[indices[0]];
	const Vector3 edge2 = p_surface.positions[indices[2]] - p_surface.positions[indices[0]];
	const Vector2 uv1 = uvs[indices[1]] - uvs[indices[0]];
	const Vector2 uv2 = uvs[indices[2]] - uvs[indices[0]];
	const float determinant = uv1.x * uv2.y - uv2.x * uv1.y;
	// v points down in glTF and Godot, the bitangent up: hence the sign.
	return Vector4((edge1 * uv2.y - edge2 * uv1.y) * (determinant < 0.0f ? -1.0f : 1.0f), (determinant < 0.0f ? 1.0f : -1.0f) * p_surface.orientation);
}

} // namespace

Vector4 TraceScene::albedo(const TraceSurface &p_surface, uint32_t p_primitive, float p_u, float p_v) const {
	const TraceMaterial &material = materials[p_surface.material];
	Vector4 value = material.parameters.albedo;
	if (material.has_texture(TextureSlot::ALBEDO)) {
		value *= fetch(p_surface, material, TextureSlot::ALBEDO, p_primitive, p_u, p_v);
	}
	if (material.parameters.vertex_color_use_as_albedo && !p_surface.mesh->colors.empty()) {
		value *= interpolate(p_surface.mesh->colors, triangle(p_surface, p_primitive), p_u, p_v);
	}
	if (material.parameters.transparency == TransparencyMode::OPAQUE) {
		value.w = 1.0f;
	}
	value.w = glm::clamp(value.w * p_surface.opacity, 0.0f, 1.0f);
	return value;
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

brdf::BrdfLobes TraceScene::lobes_at(const TraceSurface &p_surface, const TraceMaterial &p_material, const RayHit &p_hit, const Vector3 &p_albedo) const {
	const Material &parameters = p_material.parameters;
	const auto texel = [&](TextureSlot p_slot) {
		return p_material.has_texture(p_slot) ? fetch(p_surface, p_material, p_slot, p_hit.primitive, p_hit.u, p_hit.v) : Vector4(1.0f);
	};
	const auto channel = [&](TextureSlot p_slot, const Vector4 &p_texel) { return select_channel(p_texel, parameters.textures[size_t(p_slot)].channel); };
	const Vector4 metallic_texel = texel(TextureSlot::METALLIC);
	const Vector4 roughness_texel = p_material.one_fetch ? metallic_texel : texel(TextureSlot::ROUGHNESS);
	const float metallic = parameters.metallic * channel(TextureSlot::METALLIC, metallic_texel);
	const float roughness = parameters.roughness * channel(TextureSlot::ROUGHNESS, roughness_texel);
	return brdf::brdf_lobes(p_albedo, metallic, roughness, parameters.specular, parameters.specular_tint);
}

Vector3 TraceScene::mapped_normal(const TraceSurface &p_surface, const TraceMaterial &p_material, const RayHit &p_hit, const Vector3 &p_normal) const {
	const TextureRef &ref = p_material.parameters.textures[size_t(TextureSlot::NORMAL)];
	const Vector4 tangent = tangent_at(p_surface, ref, p_hit);
	const Vector3 along = Vector3(tangent) - p_normal * glm::dot(p_normal, Vector3(tangent));
	const float length = glm::length(along);
	if (!(length > 1e-20f)) {
		return p_normal;
	}
	const Vector3 t = along / length;
	const Vector3 b = glm::cross(p_normal, t) * tangent.w;
	const Vector3 texel = Vector3(fetch(p_surface, p_material, TextureSlot::NORMAL, p_hit.primitive, p_hit.u, p_hit.v)) * 2.0f - 1.0f;
	const float z = std::sqrt(std::max(0.0f, 1.0f - texel.x * texel.x - texel.y * texel.y));
	return glm::normalize((t * texel.x + b * texel.y) * p_material.parameters.normal_scale + p_normal * std::max(z, 1e-3f));
}

SurfacePoint TraceScene::shade(const RayHit &p_hit, const Vector3 &p_ray_direction) const {
	const TraceSurface &surface = surfaces[p_hit.surface];
	const TraceMaterial &material = materials[surface.material];
	const uint32_t *indices = triangle(surface, p_hit.primitive);
	const Vector3 &p0 = surface.positions[indices[0]];
	const Vector3 edge1 = surface.positions[indices[1]] - p0;
	const Vector3 edge2 = surface.positions[indices[2]] - p0;

	SurfacePoint point;
	point.position = p0 + edge1 * p_hit.u + edge2 * p_hit.v;
	// Rounding of the interpolation: a few units in the last place of the largest coordinate involved.
	point.offset_m = 1e-6f + 2e-6f * (max_component(glm::abs(p0)) + max_component(glm::abs(edge1)) + max_component(glm::abs(edge2)));
	point.geometric_normal = glm::normalize(glm::cross(edge1, edge2)) * surface.orientation;
	point.front = glm::dot(point.geometric_normal, p_ray_direction) < 0.0f;
	point.normal = point.geometric_normal;
	if (!surface.mesh->normals.empty()) {
		const Vector3 normal = surface.normal_basis * interpolate(surface.mesh->normals, indices, p_hit.u, p_hit.v);
		const float square = glm::dot(normal, normal);
		point.normal = square > 1e-30f ? normal / std::sqrt(square) : point.normal;
	}
	if (material.has_texture(TextureSlot::NORMAL)) {
		point.normal = mapped_normal(surface, material, p_hit, point.normal);
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
		const Vector4 value = albedo(surface, p_hit.primitive, p_hit.u, p_hit.v);
		point.albedo = Vector3(value);
		point.alpha = value.w;
		point.lobes = lobes_at(surface, material, p_hit, point.albedo);
	}
	return point;
}

} // namespace lucent
