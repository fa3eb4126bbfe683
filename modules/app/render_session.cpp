// SPDX-License-Identifier: MIT
#include "modules/app/render_session.h"

#include "modules/app/framing.h"
#include "modules/app/preview.h"
#include "modules/app/property_setting.h"
#include "modules/app/suggestion.h"
#include "modules/scene/camera_3d.h"
#include "modules/scene/load_report.h"
#include "modules/scene/packed_scene.h"
#include "modules/scene/resource_loader.h"
#include "modules/scene/viewport.h"

#include <algorithm>

namespace lucent {

RenderSession::~RenderSession() {
	if (viewport_rid.is_valid()) {
		server.free(viewport_rid);
	}
}

Status RenderSession::load(const std::string &p_path, bool p_strict) {
	path = p_path;
	const scene::LoadReport::Scope report;
	const int errors_before = scene::LoadReport::error_count();
	Result<Ref<Resource>> resource = scene::ResourceLoader::load(p_path);
	if (!resource) {
		return resource.error();
	}
	const auto packed = std::dynamic_pointer_cast<scene::PackedScene>(resource.value());
	if (!packed) {
		return make_error("{}: expected a scene, found a resource of class {}", p_path, resource.value()->get_class());
	}
	Result<std::unique_ptr<scene::Node>> scene = packed->instantiate();
	if (!scene) {
		return scene.error();
	}
	if (const int errors = scene::LoadReport::error_count() - errors_before; p_strict && errors > 0) {
		return make_error("{}: {} {} of the scene can't be read (--strict)", p_path, errors, errors == 1 ? "part" : "parts");
	}
	const PreviewNodes preview = add_preview_environment(*scene.value());
	tree.set_current_scene(scene.take());
	tree.flush();
	fit_preview(preview, bounds_without_backdrop(visible_boxes(server.scenario_snapshot())));
	return Ok();
}

// Those in the scene's own world.
static void collect_cameras(scene::Node &p_node, std::vector<scene::Camera3D *> &r_cameras) {
	if (scene::Camera3D *camera = dynamic_cast<scene::Camera3D *>(&p_node); camera != nullptr && scene::is_in_tree_world(*camera)) {
		r_cameras.push_back(camera);
	}
	for (const std::unique_ptr<scene::Node> &child : p_node.get_children()) {
		collect_cameras(*child, r_cameras);
	}
}

static Result<scene::Camera3D *> named_camera(scene::Node &p_root, const std::string &p_name, const std::vector<scene::Camera3D *> &p_cameras) {
	std::vector<std::string> names;
	for (scene::Camera3D *camera : p_cameras) {
		names.push_back(camera->get_name());
		if (camera->get_name() == p_name) {
			return camera;
		}
	}
	if (scene::Camera3D *camera = dynamic_cast<scene::Camera3D *>(p_root.get_node_or_null(NodePath(p_name)))) {
		if (!scene::is_in_tree_world(*camera)) {
			return make_error("--camera '{}': the camera is in a SubViewport's own world, which is not drawn", p_name);
		}
		return camera;
	}
	std::string list;
	for (const std::string &name : names) {
		list += (list.empty() ? "; there are " : ", ") + name;
	}
	return make_error("--camera '{}': the scene has no such camera{}", p_name, list);
}

Result<CameraRid> RenderSession::choose_camera(const RenderOptions &p_options) {
	std::vector<scene::Camera3D *> cameras;
	collect_cameras(root(), cameras);
	scene::Camera3D *camera = tree.get_camera_3d();
	if (!p_options.camera.empty()) {
		const Result<scene::Camera3D *> named = named_camera(root(), p_options.camera, cameras);
		if (!named) {
			return named.error();
		}
		camera = named.value();
	}
	if (camera == nullptr) {
		const auto first = std::find_if(cameras.begin(), cameras.end(), [](const scene::Camera3D *p_camera) { return scene::find_viewport(*p_camera) == nullptr; });
		camera = first == cameras.end() ? nullptr : *first;
	}
	const AABB bounds = visible_bounds(server.scenario_snapshot());
	if (bounds.is_empty()) {
		log_warning("{}: there is no mesh to see", path);
	}
	if (camera == nullptr) {
		camera = add_framing_camera(root(), bounds, float(p_options.width) / float(p_options.height));
		tree.flush();
	}
	if (scene::find_viewport(*camera) == nullptr) { // what depends on the viewer's place looks from here
		camera->make_current();
	}
	tree.flush();
	return camera->get_camera_rid();
}

Status RenderSession::open_viewport(const RenderOptions &p_options) {
	tree.flush();
	const Result<CameraRid> camera = choose_camera(p_options);
	if (!camera) {
		return camera.error();
	}
	viewport_rid = server.viewport_create();
	server.viewport_set_size(viewport_rid, p_options.width, p_options.height);
	server.viewport_set_scenario(viewport_rid, tree.get_scenario());
	server.viewport_attach_camera(viewport_rid, camera.value());
	server.viewport_set_aov(viewport_rid, !p_options.aovs.empty());
	server.viewport_set_debug_view(viewport_rid, p_options.debug_view);
	return Ok();
}

void RenderSession::draw_frame() {
	tree.process(1.0 / 60.0);
	server.draw();
}

} // namespace lucent
