// SPDX-License-Identifier: MIT
#pragma once
// Small scenes for the path tracer's tests, filled by hand.

#include "modules/reference/path_tracer.h"

#include <doctest/doctest.h>

namespace lucent::test {

struct TraceTestScene {
	RenderScene scene;
	ScenarioRid scenario;
	EnvironmentRid environment;
	CameraRid camera;

	TraceTestScene() {
		Environment settings;
		settings.background = BackgroundMode::COLOR;
		environment = scene.environments.make(settings);
		Scenario made;
		made.environment = environment;
		scenario = scene.scenarios.make(made);
		camera = scene.cameras.make(Camera());
		// Looks down at the origin, 2 cm of it: close to a point.
		Camera &view = *scene.cameras.get(camera);
		view.kind = Camera::Kind::ORTHOGONAL;
		view.size_m = 0.02f;
		view.near_m = 0.001f;
		view.transform = { Basis(Vector3(1, 0, 0), Vector3(0, 0, -1), Vector3(0, 1, 0)), Vector3(0, 0.5f, 0) };
	}

	void set_sky_color(const Vector3 &p_color) { scene.environments.get(environment)->background_color = p_color; }

	static Material lambertian(const Vector3 &p_albedo) {
		Material material;
		material.albedo = Vector4(p_albedo, 1.0f);
		material.specular = 0.0f;
		return material;
	}

	InstanceRid add_mesh(MeshSurface p_surface, const Material &p_material, const Transform3D &p_transform = {}) {
		p_surface.material = scene.materials.make(p_material);
		Mesh mesh;
		mesh.surfaces.push_back(std::make_shared<const MeshSurface>(std::move(p_surface)));
		Instance instance;
		instance.mesh = scene.meshes.make(mesh);
		instance.scenario = scenario;
		instance.transform = p_transform;
		return scene.instances.make(instance);
	}

	InstanceRid add_light(const Light &p_light, const Transform3D &p_transform) {
		Instance instance;
		instance.light = scene.lights.make(p_light);
		instance.scenario = scenario;
		instance.transform = p_transform;
		return scene.instances.make(instance);
	}

	// A square in the plane y = 0 around the origin, its front up; texture coordinates 0 to 1.
	static MeshSurface square(float p_half_size) {
		MeshSurface surface;
		surface.positions = { { -p_half_size, 0, p_half_size }, { p_half_size, 0, p_half_size }, { p_half_size, 0, -p_half_size }, { -p_half_size, 0, -p_half_size } };
		surface.uvs = { { 0, 1 }, { 1, 1 }, { 1, 0 }, { 0, 0 } };
		surface.indices = { 0, 1, 2, 0, 2, 3 };
		return surface;
	}

	// An icosphere-like sphere of p_steps bands, smooth normals; p_inward turns its front to the inside.
	static MeshSurface sphere(float p_radius, uint32_t p_steps, bool p_inward = false) {
		MeshSurface surface;
		const uint32_t columns = 2 * p_steps;
		for (uint32_t y = 0; y <= p_steps; y++) {
			for (uint32_t x = 0; x <= columns; x++) {
				const float theta = 3.14159265f * float(y) / float(p_steps);
				const float phi = 2.0f * 3.14159265f * float(x) / float(columns);
				const Vector3 normal(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
				surface.positions.push_back(normal * p_radius);
				surface.normals.push_back(p_inward ? -normal : normal);
			}
		}
		for (uint32_t y = 0; y < p_steps; y++) {
			for (uint32_t x = 0; x < columns; x++) {
				const uint32_t a = y * (columns + 1) + x;
				const uint32_t b = a + columns + 1;
				for (uint32_t i : { a, a + 1, b, b, a + 1, b + 1 }) {
					surface.indices.push_back(i);
				}
			}
		}
		if (p_inward) {
			for (size_t i = 0; i < surface.indices.size(); i += 3) {
				std::swap(surface.indices[i + 1], surface.indices[i + 2]);
			}
		}
		return surface;
	}

	// Turns y up into y down, and the other way round.
	static Transform3D upside_down(const Vector3 &p_origin) {
		return { Basis(Vector3(1, 0, 0), Vector3(0, -1, 0), Vector3(0, 0, -1)), p_origin };
	}

	PathTracerResult render(const PathTracerSettings &p_settings) const {
		Result<std::unique_ptr<PathTracer>> tracer = PathTracer::create(scene, scenario, camera);
		REQUIRE(tracer.ok());
		Result<PathTracerResult> result = tracer.value()->render(p_settings);
		REQUIRE(result.ok());
		CHECK(result.value().bad_samples == 0);
		return result.take();
	}
};

// The picture's mean and the half width of its interval at p_sigmas standard deviations.
struct Estimate {
	double mean = 0;
	double margin = 0;
};

inline Estimate estimate(const PathTracerResult &p_result, uint32_t p_channel = 0, double p_sigmas = 4.0) {
	Estimate result;
	const size_t count = size_t(p_result.width) * p_result.height;
	for (size_t i = 0; i < count; i++) {
		result.mean += p_result.radiance[3 * i + p_channel] / double(count);
		result.margin += p_result.variance[3 * i + p_channel];
	}
	result.margin = p_sigmas * std::sqrt(result.margin) / double(count);
	return result;
}

} // namespace lucent::test
