// SPDX-License-Identifier: MIT
#include "modules/reference/path_integrator.h"

#include "modules/reference/brdf_sampling.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr float PI = 3.14159265358979f;
// Bounds the loop; at a survival probability of 0.95 a path gets there once in 10^45.
constexpr uint32_t MAX_EVENTS = 2048;

float power_heuristic(float p_pdf, float p_other_pdf) {
	const float a = p_pdf * p_pdf;
	const float b = p_other_pdf * p_other_pdf;
	return std::isfinite(a) ? (a > 0.0f ? a / (a + b) : 0.0f) : 1.0f;
}

float max_component(const Vector3 &p_value) {
	return std::max(p_value.x, std::max(p_value.y, p_value.z));
}

bool is_black(const Vector3 &p_value) {
	return p_value.x == 0.0f && p_value.y == 0.0f && p_value.z == 0.0f;
}

} // namespace

CameraRays::CameraRays(const Camera &p_camera, uint32_t p_width, uint32_t p_height) :
		transform(p_camera.transform), near_m(p_camera.near_m), far_m(p_camera.far_m), orthogonal(p_camera.kind == Camera::Kind::ORTHOGONAL) {
	forward = -glm::normalize(transform.basis[2]);
	// As raster cameras, rigid: scale of the node is ignored.
	transform.basis = Basis(glm::normalize(transform.basis[0]), glm::normalize(transform.basis[1]), -forward);
	float half = 0.5f * p_camera.size_m;
	if (p_camera.kind == Camera::Kind::PERSPECTIVE) {
		half = std::tan(0.5f * glm::radians(p_camera.fov_degrees));
	} else if (p_camera.kind == Camera::Kind::FRUSTUM) {
		half /= near_m;
		shift = p_camera.frustum_offset / near_m;
	}
	const float aspect = float(p_width) / float(p_height);
	half_size = p_camera.keep_height ? Vector2(half * aspect, half) : Vector2(half, half / aspect);
	pixel_scale = 2.0f / Vector2(float(p_width), float(p_height));
}

Ray CameraRays::ray(float p_x, float p_y) const {
	const Vector2 plane = Vector2(p_x * pixel_scale.x - 1.0f, 1.0f - p_y * pixel_scale.y) * half_size + shift;
	if (orthogonal) {
		return { transform.xform(Vector3(plane, 0.0f)), forward, near_m, far_m };
	}
	const Vector3 direction(plane, -1.0f);
	const float length = glm::length(direction);
	return { transform.origin, transform.basis * (direction / length), near_m * length, far_m * length };
}

Vector3 PathIntegrator::trace(float p_x, float p_y, Random &r_random, PathLayers *r_layers) {
	Path path;
	path.first = r_layers;
	path.ray = camera_rays.ray(p_x, p_y);
	for (uint32_t event = 0; event < MAX_EVENTS; event++) {
		const RayHit hit = next_hit(path, r_random);
		if (!hit.is_hit()) {
			add_background(path);
			break;
		}
		const TraceMaterial &material = scene.material_of(hit.surface);
		Vertex vertex = { scene.shade(hit, path.ray.direction), -path.ray.direction, 0.0f, material.lambertian };
		const bool culled = path.bounce == 0 && !material.visible_from(vertex.point.front);
		if (culled || !resolve_blend(path, vertex, material.parameters, r_random)) {
			path.ray.near = hit.distance + vertex.point.offset_m; // the same ray goes on behind the surface
			continue;
		}
		if (path.first) {
			path.first->albedo = vertex.point.albedo;
			path.first->normal = vertex.point.normal;
			path.first->depth_m = camera_rays.depth_m(vertex.point.position);
		}
		add_emission(path, hit, vertex, material);
		if (material.parameters.unshaded) {
			break;
		}
		vertex.specular_share = material.lambertian ? 0.0f : brdf::specular_share(vertex.point.lobes, vertex.point.normal, vertex.view);
		add_emitter_light(path, vertex, r_random);
		add_sky_light(path, vertex, r_random);
		add_lamps_light(path, vertex, r_random);
		if (!sample_direction(path, vertex, r_random) || !survive(path, r_random)) {
			break;
		}
	}
	return path.radiance;
}

RayHit PathIntegrator::next_hit(Path &r_path, Random &r_random) {
	ray_count++;
	if (recording) {
		recording->push_back(r_path.ray);
	}
	return scene.intersect(r_path.ray, r_path.bounce == 0 ? RAY_CAMERA : RAY_BOUNCE, r_random.next_uint());
}

// p_direction times p_distance ends at the light; the origin is pushed off the surface.
Vector3 PathIntegrator::visibility(const Vertex &p_vertex, const Vector3 &p_direction, float p_distance, RayMask p_mask) {
	ray_count++;
	const Ray ray = { p_vertex.point.position + p_vertex.point.geometric_normal * p_vertex.point.offset_m, p_direction, 0.0f, p_distance };
	if (recording) {
		recording->push_back(ray);
	}
	return scene.transmittance(ray, p_mask);
}

void PathIntegrator::add_emission(Path &r_path, const RayHit &p_hit, const Vertex &p_vertex, const TraceMaterial &p_material) {
	if (p_material.parameters.unshaded) {
		const Vector3 value = r_path.throughput * p_vertex.point.albedo;
		r_path.radiance += value;
		if (r_path.first) {
			r_path.first->emission += value;
		}
		return;
	}
	if (!p_material.shines || !p_material.visible_from(p_vertex.point.front)) {
		return;
	}
	Vector3 value = scene.emission(p_hit.surface, p_hit.primitive, p_hit.u, p_hit.v);
	if (is_black(value)) {
		return;
	}
	value *= r_path.throughput;
	if (r_path.bounce == 0) {
		if (r_path.first) {
			r_path.first->emission += value;
		}
	} else if (const float area_pdf = world.lights.emitter_area_pdf(scene.surfaces[p_hit.surface], p_hit.primitive); area_pdf > 0.0f) {
		const float cosine = glm::dot(p_vertex.point.geometric_normal, p_vertex.view);
		const float light_pdf = area_pdf * p_hit.distance * p_hit.distance / std::max(cosine, 1e-7f);
		value *= power_heuristic(r_path.pdf, light_pdf);
	}
	r_path.radiance += value;
}

void PathIntegrator::add_background(Path &r_path) {
	Vector3 value = r_path.throughput * world.sky.radiance(r_path.ray.direction, r_path.bounce == 0);
	if (r_path.bounce == 0) {
		if (r_path.first) {
			r_path.first->background += value;
		}
	} else if (world.sky.is_sampled()) {
		value *= power_heuristic(r_path.pdf, world.sky.pdf(r_path.ray.direction));
	}
	r_path.radiance += value;
}

void PathIntegrator::add_emitter_light(Path &r_path, const Vertex &p_vertex, Random &r_random) {
	if (!world.lights.has_emitters()) {
		return;
	}
	const SurfacePoint &point = p_vertex.point;
	const EmitterSample sample = world.lights.sample_emitter(scene, point.position, point.geometric_normal, r_random);
	if (sample.pdf <= 0.0f || is_black(sample.radiance)) {
		return;
	}
	const brdf::Evaluation evaluation = brdf::evaluate(point.lobes, p_vertex.specular_share, point.normal, p_vertex.view, sample.direction);
	if (is_black(evaluation.value_cos)) {
		return;
	}
	// To the pushed-off end, not along sample.direction: the two ends must not hide themselves.
	const Vector3 origin = point.position + point.geometric_normal * point.offset_m;
	const Vector3 segment = sample.position - origin;
	const Vector3 visible = visibility(p_vertex, segment, 1.0f, RAY_BOUNCE);
	r_path.radiance += r_path.throughput * evaluation.value_cos * sample.radiance * visible * (power_heuristic(sample.pdf, evaluation.pdf) / sample.pdf);
}

void PathIntegrator::add_sky_light(Path &r_path, const Vertex &p_vertex, Random &r_random) {
	if (!world.sky.is_sampled()) {
		return;
	}
	const SurfacePoint &point = p_vertex.point;
	const float u = r_random.next();
	const DirectionSample sample = world.sky.sample(u, r_random.next());
	if (!(sample.pdf > 0.0f) || glm::dot(point.geometric_normal, sample.direction) <= 0.0f) {
		return;
	}
	const brdf::Evaluation evaluation = brdf::evaluate(point.lobes, p_vertex.specular_share, point.normal, p_vertex.view, sample.direction);
	if (is_black(evaluation.value_cos)) {
		return;
	}
	const Vector3 visible = visibility(p_vertex, sample.direction, std::numeric_limits<float>::infinity(), RAY_BOUNCE);
	r_path.radiance += r_path.throughput * evaluation.value_cos * sample.radiance * visible * (power_heuristic(sample.pdf, evaluation.pdf) / sample.pdf);
}

// At the first surface each of a few lamps has its own ray: the picture's sharpest edges are their shadows. So has each of all lamps where
// some are negative: a surface that is seen shows their sum, but where light bounces they take no more than the others give.
void PathIntegrator::add_lamps_light(Path &r_path, const Vertex &p_vertex, Random &r_random) {
	constexpr uint32_t MAX_SEPARATE = 8;
	const uint32_t count = world.lights.lamp_count();
	const Vector3 &position = p_vertex.point.position;
	const bool indirect = r_path.bounce > 0;
	Vector3 sum(0.0f);
	if (world.lights.has_negative_lamps() || (!indirect && count <= MAX_SEPARATE)) {
		for (uint32_t lamp = 0; lamp < count; lamp++) {
			sum += lamp_light(p_vertex, world.lights.sample_lamp(lamp, position, indirect, r_random), indirect);
		}
		sum = indirect ? glm::max(sum, Vector3(0.0f)) : sum;
	} else {
		float probability = 1.0f;
		const uint32_t lamp = count > 0 ? world.lights.choose_lamp(position, p_vertex.point.normal, indirect, r_random, probability) : UINT32_MAX;
		if (lamp != UINT32_MAX) {
			sum = lamp_light(p_vertex, world.lights.sample_lamp(lamp, position, indirect, r_random), indirect) / probability;
		}
	}
	sum *= r_path.throughput;
	r_path.radiance += sum;
	if (r_path.first) {
		r_path.first->direct += sum;
	}
}

Vector3 PathIntegrator::lamp_light(const Vertex &p_vertex, const LampSample &p_sample, bool p_indirect) {
	const SurfacePoint &point = p_vertex.point;
	const float cosine = glm::dot(point.normal, p_sample.direction);
	if (cosine <= 0.0f || glm::dot(point.geometric_normal, p_sample.direction) <= 0.0f || is_black(p_sample.power)) {
		return Vector3(0.0f);
	}
	Vector3 value = brdf::brdf_diffuse(point.lobes);
	if (!p_vertex.lambertian) {
		value += brdf::brdf_specular(point.lobes, point.normal, p_vertex.view, p_sample.direction) * p_sample.specular;
	}
	value *= p_sample.power * (PI * cosine);
	if (p_sample.shadow_opacity > 0.0f) {
		const RayMask mask = p_indirect ? RAY_BOUNCE : RAY_LAMP_SHADOW;
		value *= glm::mix(Vector3(1.0f), visibility(p_vertex, p_sample.direction, p_sample.distance_m, mask), p_sample.shadow_opacity);
	}
	return value;
}

// Blend equations that are not a mixture: the surface is seen and what is behind it is too, half of the paths each.
bool PathIntegrator::resolve_blend(Path &r_path, const Vertex &p_vertex, const Material &p_material, Random &r_random) {
	if (p_material.transparency != TransparencyMode::ALPHA_BLEND || p_material.blend == MaterialBlend::MIX) {
		return true; // TraceScene chose
	}
	const float alpha = p_vertex.point.alpha;
	if (p_material.blend == MaterialBlend::MUL) {
		r_path.throughput *= p_vertex.point.albedo;
		return false;
	}
	if (r_random.next() < 0.5f) {
		r_path.throughput *= 2.0f * (p_material.blend == MaterialBlend::PREMULTIPLIED ? 1.0f - alpha : 1.0f);
		return false;
	}
	const float sign = p_material.blend == MaterialBlend::SUB ? -1.0f : 1.0f;
	r_path.throughput *= 2.0f * sign * (p_material.blend == MaterialBlend::PREMULTIPLIED ? 1.0f : alpha);
	return true;
}

bool PathIntegrator::sample_direction(Path &r_path, const Vertex &p_vertex, Random &r_random) {
	const SurfacePoint &point = p_vertex.point;
	const Vector3 direction = brdf::sample(point.lobes, p_vertex.specular_share, point.normal, p_vertex.view, r_random);
	if (glm::dot(point.geometric_normal, direction) <= 0.0f) {
		return false;
	}
	if (p_vertex.lambertian) {
		r_path.throughput *= point.lobes.diffuse;
		r_path.pdf = glm::dot(point.normal, direction) / PI;
	} else {
		const brdf::Evaluation evaluation = brdf::evaluate(point.lobes, p_vertex.specular_share, point.normal, p_vertex.view, direction);
		if (!(evaluation.pdf > 0.0f)) {
			return false;
		}
		r_path.throughput *= evaluation.value_cos / evaluation.pdf;
		r_path.pdf = evaluation.pdf;
	}
	start_ray(r_path, point, direction);
	return r_path.pdf > 0.0f && !is_black(r_path.throughput);
}

void PathIntegrator::start_ray(Path &r_path, const SurfacePoint &p_point, const Vector3 &p_direction) {
	r_path.ray = { p_point.position + p_point.geometric_normal * p_point.offset_m, p_direction };
	r_path.bounce++;
	r_path.first = nullptr;
}

// Russian roulette from the third bounce on.
bool PathIntegrator::survive(Path &r_path, Random &r_random) {
	if (r_path.bounce < 3) {
		return true;
	}
	const float probability = std::min(0.95f, max_component(glm::abs(r_path.throughput)));
	if (r_random.next() >= probability) {
		return false;
	}
	r_path.throughput /= probability;
	return true;
}

} // namespace lucent
