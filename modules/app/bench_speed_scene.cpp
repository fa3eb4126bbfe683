// SPDX-License-Identifier: MIT
#include "modules/app/bench_speed.h"
#include "modules/app/property_setting.h"
#include "modules/scene/camera_3d.h"
#include "modules/scene/environment.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/primitive_meshes.h"

namespace lucent {

namespace {

constexpr const char *EXTRAS = "BenchExtras";
// The court, metres: extras stand in it.
const Vector3 COURT_MIN(-10.0f, 0.3f, -6.0f);
const Vector3 COURT_MAX(10.0f, 8.0f, 6.0f);

// The R2 sequence's sister in three dimensions (Roberts, 2018): spread evenly, the same on every run.
Vector3 spread_point(uint32_t p_index) {
	const Vector3 t = glm::fract(Vector3(0.8191725f, 0.6710436f, 0.5497005f) * float(p_index + 1));
	return COURT_MIN + t * (COURT_MAX - COURT_MIN);
}

} // namespace

Status SpeedScene::load(const BenchOptions &p_options) {
	BenchOptions options = p_options;
	options.grid = preset.grid;
	if (const Status status = bench.load(source_root() + "doc/samples/atrium/atrium.tscn", options, preset.width, preset.height); !status) {
		return make_error("{} ('python3 doc/samples/atrium/make_atrium.py' makes the atrium's geometry)", status.error().message);
	}
	const Result<scene::Node *> sun = find_node(bench.root(), "Sun");
	if (!sun || bench.camera() == nullptr || bench.environment() == nullptr) {
		return make_error("the atrium lacks its camera, environment or sun");
	}
	sun_energy = dynamic_cast<scene::Light3D &>(*sun.value()).get_parameters().energy;
	start_transform = bench.camera()->get_global_transform();
	base_sdfgi = bench.environment()->sdfgi;
	base_sdfgi.cascades = preset.cascades != 0 ? preset.cascades : base_sdfgi.cascades;
	base_sdfgi.frames_to_converge = preset.frames_to_converge != 0 ? preset.frames_to_converge : base_sdfgi.frames_to_converge;
	base_sdfgi.count_every_frame = true;
	set_sdfgi(base_sdfgi);
	return Ok();
}

std::vector<GiFetches> SpeedScene::count_fetches() {
	SdfgiSettings counting = bench.environment()->sdfgi;
	counting.count_fetches = true;
	set_sdfgi(counting);
	std::vector<GiFetches> result = bench.draw().stats.gi.fetches;
	counting.count_fetches = false;
	set_sdfgi(counting);
	return result;
}

void SpeedScene::set_sun(float p_factor) {
	auto &sun = dynamic_cast<scene::Light3D &>(*find_node(bench.root(), "Sun").value());
	Light parameters = sun.get_parameters();
	parameters.energy = sun_energy * p_factor;
	sun.set_parameters(parameters);
}

void SpeedScene::set_camera(const Transform3D &p_transform) {
	bench.camera()->set_global_transform(p_transform);
}

Result<Transform3D> SpeedScene::other_camera() {
	const Result<scene::Node *> node = find_node(bench.root(), "Gallery");
	if (!node) {
		return node.error();
	}
	return dynamic_cast<scene::Camera3D &>(*node.value()).get_global_transform();
}

void SpeedScene::set_sdfgi(const SdfgiSettings &p_settings) {
	bench.environment()->sdfgi = p_settings;
	bench.environment()->state_changed();
}

scene::Node &SpeedScene::extras() {
	scene::Node *node = bench.root().get_node_or_null(NodePath(EXTRAS));
	return node != nullptr ? *node : *bench.root().create_child<scene::Node3D>(EXTRAS);
}

void SpeedScene::add_lamps(uint32_t p_count) {
	scene::Node &parent = extras();
	for (uint32_t i = 0; i < p_count; i++) {
		auto *lamp = parent.create_child<scene::OmniLight3D>("");
		Light parameters = lamp->get_parameters();
		parameters.range_m = 8.0f;
		parameters.energy = 10.0f / float(p_count);
		parameters.shadow_enabled = true;
		parameters.bake_mode = LightBakeMode::DYNAMIC;
		lamp->set_parameters(parameters);
		lamp->set_position(spread_point(i));
	}
}

void SpeedScene::add_emitter(float p_area_m2) {
	auto mesh = std::make_shared<scene::BoxMesh>();
	const float side = std::sqrt(p_area_m2);
	mesh->state.size = Vector3(side, 0.05f, side);
	auto material = std::make_shared<scene::StandardMaterial3D>();
	scene::BaseMaterial3D::State state = material->get_state();
	state.emission_enabled = true;
	state.emission = Color{ 1, 1, 1, 1 };
	state.emission_energy_multiplier = 10.0f / p_area_m2;
	material->set_state(state);
	mesh->set_material(material);
	auto *node = extras().create_child<scene::MeshInstance3D>("");
	node->set_mesh(mesh);
	node->set_position(Vector3(0.0f, 3.0f, 0.0f));
}

uint64_t SpeedScene::show_spheres(uint64_t p_triangles) {
	dynamic_cast<scene::Node3D &>(*find_node(bench.root(), "Geometry").value()).set_visible(false);
	auto mesh = std::make_shared<scene::SphereMesh>();
	mesh->state.radius = 0.25f;
	mesh->state.height = 0.5f;
	mesh->state.radial_segments = 50;
	mesh->state.rings = 48;
	const uint64_t triangles = mesh->surface_get_arrays(0)->indices.size() / 3;
	const uint64_t count = std::max<uint64_t>(1, (p_triangles + triangles / 2) / triangles);
	scene::Node &parent = extras();
	for (uint64_t i = 0; i < count; i++) {
		auto *node = parent.create_child<scene::MeshInstance3D>("");
		node->set_mesh(mesh);
		node->set_position(spread_point(uint32_t(i)));
	}
	return count * triangles;
}

void SpeedScene::reset() {
	if (scene::Node *node = bench.root().get_node_or_null(NodePath(EXTRAS))) {
		bench.root().remove_child(node);
	}
	dynamic_cast<scene::Node3D &>(*find_node(bench.root(), "Geometry").value()).set_visible(true);
	set_sdfgi(base_sdfgi);
	set_camera(start_transform);
	set_sun(1.0f);
	bench.set_size(preset.width, preset.height);
}

} // namespace lucent
