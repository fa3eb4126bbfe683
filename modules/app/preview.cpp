// SPDX-License-Identifier: MIT
#include "modules/app/preview.h"

#include "modules/app/framing.h"
#include "modules/scene/camera_3d.h"
#include "modules/scene/environment.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/sky.h"
#include "modules/scene/viewport.h"
#include "modules/scene/world_environment.h"

namespace lucent {

template <typename T>
static bool has_node_of(const scene::Node &p_node) {
	if (dynamic_cast<const T *>(&p_node) != nullptr) {
		return true;
	}
	if (const scene::Viewport *viewport = dynamic_cast<const scene::Viewport *>(&p_node); viewport != nullptr && viewport->has_separate_world()) {
		return false;
	}
	for (const std::unique_ptr<scene::Node> &child : p_node.get_children()) {
		if (has_node_of<T>(*child)) {
			return true;
		}
	}
	return false;
}

static Color mix(const Color &p_a, const Color &p_b, float p_weight) {
	return { std::lerp(p_a.r, p_b.r, p_weight), std::lerp(p_a.g, p_b.g, p_weight), std::lerp(p_a.b, p_b.b, p_weight), 1.0f };
}

static Ref<Resource> preview_environment() {
	static const Color SKY_COLOR{ 0.385f, 0.454f, 0.55f, 1.0f };
	static const Color GROUND_COLOR{ 0.2f, 0.169f, 0.133f, 1.0f };
	const Color between = mix(SKY_COLOR, GROUND_COLOR, 0.5f);
	const float luminance = 3.333f * (0.2126f * between.r + 0.7152f * between.g + 0.0722f * between.b);
	const Color horizon = mix(between, { luminance, luminance, luminance, 1.0f }, 0.5f);
	const auto material = std::make_shared<scene::ProceduralSkyMaterial>();
	material->set("sky_top_color", SKY_COLOR);
	material->set("sky_horizon_color", horizon);
	material->set("ground_bottom_color", GROUND_COLOR);
	material->set("ground_horizon_color", horizon);
	const auto sky = std::make_shared<scene::Sky>();
	sky->set("sky_material", material);
	const auto environment = std::make_shared<scene::Environment>();
	environment->set("background_mode", BackgroundMode::SKY);
	environment->set("sky", sky);
	environment->set("tonemap_mode", ToneMapper::FILMIC);
	environment->set("sdfgi_enabled", true);
	return environment;
}

PreviewNodes add_preview_environment(scene::Node &r_root) {
	PreviewNodes nodes;
	if (has_node_of<scene::WorldEnvironment>(r_root)) {
		return nodes; // complete: a lit room needs no second sun
	}
	nodes.environment = r_root.create_child<scene::WorldEnvironment>("WorldEnvironment");
	nodes.environment->set("environment", preview_environment());
	if (!has_node_of<scene::DirectionalLight3D>(r_root)) {
		nodes.sun = r_root.create_child<scene::DirectionalLight3D>("DirectionalLight3D");
		nodes.sun->set_rotation_degrees(Vector3(-60.0f, 150.0f, 0.0f));
		nodes.sun->set("shadow_enabled", true);
	}
	return nodes;
}

void fit_preview(const PreviewNodes &p_nodes, const AABB &p_bounds) {
	// A hundred cells along the radius: as Godot's default of 0.2 m in a building of 40 m. Four cascades then reach over five radii,
	// so to a camera that frames the scene.
	static const float CELLS_PER_RADIUS = 100.0f;
	const float radius = 0.5f * glm::length(p_bounds.size());
	if (p_bounds.is_empty() || !(radius > 0.0f)) {
		return;
	}
	if (p_nodes.environment != nullptr && p_nodes.environment->get_environment()) {
		p_nodes.environment->get_environment()->set_sdfgi_min_cell_size(radius / CELLS_PER_RADIUS);
	}
	if (p_nodes.sun != nullptr) { // shadow maps end where the scene does
		p_nodes.sun->set("directional_shadow_max_distance", 100.0f * radius);
	}
}

scene::Camera3D *add_framing_camera(scene::Node &r_root, const AABB &p_bounds, float p_aspect) {
	static const float FOV_Y_DEGREES = 50.0f;
	const Framing framing = frame_bounds(p_bounds, FOV_Y_DEGREES, p_aspect);
	scene::Camera3D *camera = r_root.create_child<scene::Camera3D>("Camera3D");
	camera->set_global_transform(framing.transform);
	camera->set("fov", FOV_Y_DEGREES);
	camera->set("near", framing.near_m);
	camera->set("far", framing.far_m);
	return camera;
}

} // namespace lucent
