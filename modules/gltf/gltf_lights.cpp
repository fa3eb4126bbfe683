// SPDX-License-Identifier: MIT
// KHR_lights_punctual and cameras.
#include "modules/gltf/gltf_loader.h"

namespace lucent {

namespace {

constexpr float PI = 3.14159265358979f;
// A file without a range means an infinite one; beyond this the fall-off by distance has left nothing.
constexpr float DEFAULT_RANGE_M = 4096.0f;

// Godot's spot_angle_attenuation such that both cones dim to one half at the same angle. glTF recommends t^2 with t from 0 at the outer to
// 1 at the inner cone in cosines; Godot has 1 - x^(1 / attenuation) with x = (1 - cos) / (1 - cos outer).
float spot_attenuation(float p_inner, float p_outer) {
	const float inner = (1.0f - std::cos(p_inner)) / std::max(1.0f - std::cos(p_outer), 1e-9f);
	const float half = 1.0f - std::sqrt(0.5f) * (1.0f - std::clamp(inner, 0.0f, 1.0f));
	return std::max(std::log(std::min(half, 0.999f)) / std::log(0.5f), 0.01f);
}

GltfLight load_light(const JsonView &p_json) {
	GltfLight result;
	result.name = p_json.string_or("name", "");
	Light &light = result.light;
	light.color = glm::max(p_json.vector3_or("color", Vector3(1.0f)), Vector3(0.0f));
	// Candela and lux: a Lambertian surface reflects albedo / pi * intensity * cos / d^2; Godot's energy leaves the pi out.
	light.energy = p_json.float_in("intensity", 1.0f, 0.0f, 1e30f) / PI;
	light.shadow_enabled = true;
	const std::string type = p_json.member("type").to_string();
	if (type == "directional") {
		light.type = LightType::DIRECTIONAL;
		return result;
	}
	light.range_m = p_json.float_in("range", DEFAULT_RANGE_M, 1e-3f, DEFAULT_RANGE_M);
	light.attenuation = 2.0f;
	light.specular = 0.5f; // Godot's default for lamps with a place: a lobe of full strength
	if (type == "point") {
		light.type = LightType::OMNI;
	} else if (type == "spot") {
		light.type = LightType::SPOT;
		const JsonView spot = p_json.member("spot");
		const float outer = spot.float_in("outerConeAngle", PI / 4.0f, 1e-3f, PI / 2.0f);
		const float inner = spot.float_in("innerConeAngle", 0.0f, 0.0f, outer);
		light.spot_angle_degrees = outer * 180.0f / PI;
		light.spot_attenuation = spot_attenuation(inner, outer);
	} else {
		p_json.member("type").fail("expected directional, point or spot, found '{}'", type);
	}
	return result;
}

GltfCamera load_camera(const JsonView &p_json) {
	GltfCamera result;
	result.name = p_json.string_or("name", "");
	Camera &camera = result.camera;
	const std::string type = p_json.member("type").to_string();
	if (type != "perspective" && type != "orthographic") {
		p_json.member("type").fail("expected perspective or orthographic, found '{}'", type);
	}
	const JsonView lens = p_json.member(type.c_str());
	if (type == "perspective") {
		camera.kind = Camera::Kind::PERSPECTIVE;
		camera.fov_degrees = lens.member("yfov").to_float() * 180.0f / PI;
		if (!(camera.fov_degrees > 0.0f && camera.fov_degrees < 180.0f)) {
			lens.member("yfov").fail("expected an angle between 0 and pi");
		}
		camera.near_m = lens.float_in("znear", 0.05f, 1e-4f, 1e6f);
	} else {
		camera.kind = Camera::Kind::ORTHOGONAL;
		camera.size_m = 2.0f * std::abs(lens.member("ymag").to_float());
		if (!(camera.size_m > 0.0f)) {
			lens.member("ymag").fail("expected a size other than 0");
		}
		camera.near_m = lens.float_in("znear", 0.0f, 0.0f, 1e6f);
	}
	// An infinite far plane (no zfar) is far enough away at Godot's default.
	camera.far_m = std::max(lens.float_or("zfar", std::max(4000.0f, camera.near_m * 2.0f)), camera.near_m * 1.001f + 1e-3f);
	return result;
}

} // namespace

void load_lights(GltfContext &r_context) {
	const JsonView lights = r_context.root.extension("KHR_lights_punctual").member("lights");
	for (size_t i = 0; i < lights.array_size(); i++) {
		r_context.document.lights.push_back(load_light(lights.element(i)));
	}
}

void load_cameras(GltfContext &r_context) {
	const JsonView cameras = r_context.root.member("cameras");
	for (size_t i = 0; i < cameras.array_size(); i++) {
		r_context.document.cameras.push_back(load_camera(cameras.element(i)));
	}
}

} // namespace lucent
