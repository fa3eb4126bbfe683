// SPDX-License-Identifier: MIT
#include "modules/bench/furnace.h"

#include "modules/bench/statistics.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr double FULL_COLOUR = 0.25;

Material furnace_material(float p_albedo) {
	Material material;
	material.albedo = Vector4(p_albedo, p_albedo, p_albedo, 1.0f);
	material.emission = Vector3(1.0f - p_albedo);
	material.specular = 0.0f;
	material.cull = MaterialCull::DISABLED;
	return material;
}

// The environment that the viewport shows now: the camera's, the scenario's, its fallback.
Environment shown_environment(const RenderScene &p_scene, const Viewport &p_viewport) {
	const Camera *camera = p_scene.cameras.get(p_viewport.camera);
	const Scenario *scenario = p_scene.scenarios.get(p_viewport.scenario);
	for (const EnvironmentRid rid : { camera->environment, scenario->environment, scenario->fallback_environment }) {
		if (const Environment *environment = p_scene.environments.get(rid)) {
			return *environment;
		}
	}
	return {};
}

void set_environment(RenderingServer &r_server, const Viewport &p_viewport) {
	const RenderScene &scene = r_server.scenario_snapshot();
	SdfgiSettings sdfgi = shown_environment(scene, p_viewport).sdfgi;
	sdfgi.enabled = true;
	sdfgi.bounce_feedback = 1.0f;
	sdfgi.energy = 1.0f;
	sdfgi.read_sky_light = true;
	Camera camera = *scene.cameras.get(p_viewport.camera);
	camera.environment = {};
	const EnvironmentRid environment = r_server.environment_create();
	r_server.environment_set_background(environment, BackgroundMode::COLOR);
	r_server.environment_set_bg_color(environment, Vector3(1.0f));
	r_server.environment_set_sdfgi(environment, sdfgi);
	r_server.camera_set(p_viewport.camera, camera);
	r_server.scenario_set_environment(p_viewport.scenario, environment);
}

double pixel_mean(const MetricImage &p_picture, size_t p_pixel) {
	const float *values = p_picture.values.data() + 3 * p_pixel;
	return (double(values[0]) + double(values[1]) + double(values[2])) / 3.0;
}

} // namespace

void make_furnace(RenderingServer &r_server, ViewportRid p_viewport, float p_albedo) {
	const RenderScene &scene = r_server.scenario_snapshot();
	const Viewport viewport = *scene.viewports.get(p_viewport);
	std::vector<InstanceRid> meshes, lights;
	scene.instances.for_each([&](InstanceRid p_rid, const Instance &p_instance) {
		(p_instance.light.is_valid() ? lights : meshes).push_back(p_rid);
	});
	const MaterialRid material = r_server.material_create();
	r_server.material_set(material, furnace_material(p_albedo));
	for (const InstanceRid rid : meshes) {
		r_server.instance_geometry_set_material_override(rid, material);
		r_server.instance_geometry_set_transparency(rid, 0.0f);
	}
	for (const InstanceRid rid : lights) {
		r_server.instance_set_visible(rid, false);
	}
	set_environment(r_server, viewport);
}

Result<FurnaceError> measure_furnace(const MetricImage &p_picture) {
	if (p_picture.pixel_count() == 0) {
		return make_error("the picture has no pixel");
	}
	std::vector<double> values;
	FurnaceError error;
	for (size_t i = 0; i < p_picture.pixel_count(); i++) {
		const double value = pixel_mean(p_picture, i);
		if (!std::isfinite(value)) {
			return make_error("pixel {},{} of the picture is not finite", i % p_picture.width, i / p_picture.width);
		}
		values.push_back(value);
		error.mean += value / double(p_picture.pixel_count());
		error.off += (std::abs(value - 1.0) > FURNACE_OFF ? 1.0 : 0.0) / double(p_picture.pixel_count());
	}
	error.p1 = percentile(values, 0.01);
	error.p5 = percentile(values, 0.05);
	error.p50 = percentile(values, 0.5);
	error.p95 = percentile(values, 0.95);
	error.p99 = percentile(values, 0.99);
	return error;
}

std::vector<uint8_t> furnace_map(const MetricImage &p_picture) {
	std::vector<uint8_t> map(3 * p_picture.pixel_count());
	for (size_t i = 0; i < p_picture.pixel_count(); i++) {
		const double error = std::clamp((pixel_mean(p_picture, i) - 1.0) / FULL_COLOUR, -1.0, 1.0);
		map[3 * i] = uint8_t(std::max(-error, 0.0) * 255.0 + 0.5);
		map[3 * i + 1] = map[3 * i + 2] = uint8_t(std::max(error, 0.0) * 255.0 + 0.5);
	}
	return map;
}

} // namespace lucent
