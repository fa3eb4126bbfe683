// SPDX-License-Identifier: MIT
#include "modules/python/py_tree.h"

#include "drivers/vulkan/vulkan_driver.h"
#include "modules/app/framing.h"
#include "modules/app/preview.h"
#include "modules/app/render_options.h"
#include "modules/app/stats_file.h"
#include "modules/app/suggestion.h"
#include "modules/reference/path_tracer.h"
#include "modules/scene/camera_3d.h"
#include "modules/scene/packed_scene.h"
#include "modules/scene/resource_loader.h"
#include "modules/scene/scene_tree.h"
#include "servers/rendering/device/rendering_device.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <chrono>
#include <map>

namespace lucent::python {

namespace py = pybind11;

namespace {

struct Runtime {
	std::unique_ptr<RenderingServer> server;
	ViewportRid viewport;
};

std::map<uint64_t, Runtime> &runtimes() { // by the tree's id
	static auto *instance = new std::map<uint64_t, Runtime>;
	return *instance;
}

std::unique_ptr<RenderingDevice> device; // of all trees
std::string device_name;

double seconds_since(std::chrono::steady_clock::time_point p_start) {
	return std::chrono::duration<double>(std::chrono::steady_clock::now() - p_start).count();
}

PyObject *raise_device(const std::string &p_message) {
	PyErr_SetString(device_error, p_message.c_str());
	return nullptr;
}

bool open_device(Runtime &r_runtime, const std::string &p_name) {
	if (device && !p_name.empty() && p_name != device_name) {
		raise_device("a process has one device, and it is '" +
				(device_name.empty() ? device->info().name : device_name) + "' already");
		return false;
	}
	if (!device) {
		Result<std::unique_ptr<RenderingDeviceDriver>> driver = create_vulkan_driver({ p_name, false });
		Result<std::unique_ptr<RenderingDevice>> made = driver
				? RenderingDevice::create(driver.take())
				: Result<std::unique_ptr<RenderingDevice>>(driver.error());
		if (!made) {
			raise_device(made.error().message);
			return false;
		}
		device = made.take();
		device_name = p_name;
	}
	if (!r_runtime.server->get_rendering_device()) {
		r_runtime.server->open_device(*device);
	}
	return true;
}

void collect_cameras(scene::Node &p_node, std::vector<scene::Camera3D *> &r_cameras) {
	if (scene::Camera3D *camera = dynamic_cast<scene::Camera3D *>(&p_node)) {
		r_cameras.push_back(camera);
	}
	for (const std::unique_ptr<scene::Node> &child : p_node.get_children()) {
		collect_cameras(*child, r_cameras);
	}
}

// As RenderSession does for `lucent render`. Null: an error is set.
scene::Camera3D *choose_camera(
		scene::SceneTree &r_tree, const RenderingServer &p_server, ObjectID p_camera, float p_aspect) {
	if (p_camera.is_valid()) {
		scene::Camera3D *camera = dynamic_cast<scene::Camera3D *>(ObjectDB::get(p_camera));
		if (!camera || camera->get_tree() != &r_tree) {
			PyErr_SetString(PyExc_ValueError, "camera: expected a Camera3D of this tree");
			return nullptr;
		}
		return camera;
	}
	std::vector<scene::Camera3D *> cameras;
	collect_cameras(*r_tree.get_root(), cameras);
	if (scene::Camera3D *camera = r_tree.get_camera_3d()) {
		return camera;
	}
	if (!cameras.empty()) {
		return cameras.front();
	}
	scene::Node *scene = r_tree.get_current_scene();
	scene::Camera3D *camera = add_framing_camera(
			scene ? *scene : *r_tree.get_root(), visible_bounds(p_server.scenario_snapshot()), p_aspect);
	r_tree.flush();
	return camera;
}

// One frame. The interpreter is free while it is drawn.
void draw(scene::SceneTree &r_tree, RenderingServer &r_server, double p_delta_s) {
	r_tree.process(p_delta_s);
	if (!has_kept_exception()) {
		const py::gil_scoped_release release;
		r_server.draw();
	}
}

// As `lucent render`: only the last frame is pictured. False: an error is set or kept.
bool draw_frames(
		scene::SceneTree &r_tree, Runtime &r_runtime, const RenderRequest &p_request, RenderSummary &r_summary) {
	RenderingServer &server = *r_runtime.server;
	const uint32_t limit = p_request.frames != 0 ? p_request.frames : MAX_FRAMES_TO_CONVERGE;
	bool pictured = false;
	while (r_summary.frames < limit) {
		pictured = r_summary.frames + 1 == limit;
		server.viewport_set_picture_enabled(r_runtime.viewport, pictured);
		draw(r_tree, server, p_request.delta_s);
		if (has_kept_exception() || PyErr_CheckSignals() < 0) {
			return false;
		}
		r_summary.frames++;
		const FrameStats frame = server.get_frame_stats();
		r_summary.passes.add(frame.pass_ms);
		r_summary.converged = frame.gi.converged || frame.gi.frames == 0;
		if (p_request.frames == 0 && r_summary.converged) {
			break;
		}
	}
	if (!pictured) {
		server.viewport_set_picture_enabled(r_runtime.viewport, true);
		draw(r_tree, server, p_request.delta_s);
	}
	return !has_kept_exception();
}

PyObject *make_display_array(const ViewportImage &p_image) {
	py::array_t<uint8_t> array(
			{ py::ssize_t(p_image.height), py::ssize_t(p_image.width), py::ssize_t(p_image.channels) });
	std::transform(p_image.values.begin(), p_image.values.end(), array.mutable_data(), [](float p_value) {
		return uint8_t((p_value > 0.0f ? std::min(p_value, 1.0f) : 0.0f) * 255.0f + 0.5f); // NaN is black
	});
	return array.release().ptr();
}

constexpr ViewportBuffer AOV_BUFFERS[] = { ViewportBuffer::DIRECT, ViewportBuffer::INDIRECT_DIFFUSE,
	ViewportBuffer::INDIRECT_SPECULAR, ViewportBuffer::EMISSION, ViewportBuffer::ALBEDO, ViewportBuffer::NORMAL,
	ViewportBuffer::DEPTH, ViewportBuffer::MOTION };
static_assert(std::size(AOV_BUFFERS) == std::size(AOV_NAMES)); // in its order

PyObject *read_buffer(RenderingServer &r_server, ViewportRid p_viewport, ViewportBuffer p_buffer) {
	ViewportImage image;
	{
		const py::gil_scoped_release release;
		image = r_server.viewport_get_image(p_viewport, p_buffer);
	}
	return make_array(std::move(image.values), image.width, image.height, image.channels);
}

// Fills the dict with p_names' arrays. False: an error is set.
bool read_aovs(
		RenderingServer &r_server, ViewportRid p_viewport, const std::vector<std::string> &p_names, py::dict &r_aovs) {
	for (const std::string &name : p_names) {
		const auto *const found = std::find(std::begin(AOV_NAMES), std::end(AOV_NAMES), name);
		r_aovs[py::str(name)] = py::reinterpret_steal<py::object>(
				read_buffer(r_server, p_viewport, AOV_BUFFERS[found - std::begin(AOV_NAMES)]));
	}
	return true;
}

bool check_names(const std::vector<std::string> &p_names, const std::vector<std::string> &p_known) {
	for (const std::string &name : p_names) {
		if (std::find(p_known.begin(), p_known.end(), name) == p_known.end()) {
			std::string list;
			for (const std::string &known : p_known) {
				list += (list.empty() ? "" : ", ") + known;
			}
			PyErr_SetString(PyExc_ValueError,
					fmt::format("aovs: there is no '{}'{}; there are {}", name, suggestion(name, p_known), list)
							.c_str());
			return false;
		}
	}
	return true;
}

bool check_size(uint32_t p_width, uint32_t p_height, uint32_t p_most) {
	if (p_width < 1 || p_height < 1 || p_width > p_most || p_height > p_most) {
		PyErr_SetString(PyExc_ValueError,
				fmt::format("size: width and height must be 1 to {}, got {}x{}", p_most, p_width, p_height).c_str());
		return false;
	}
	return true;
}

Runtime *runtime_of(const Object &p_tree) {
	const auto found = runtimes().find(p_tree.get_instance_id().value);
	if (found == runtimes().end()) {
		PyErr_SetString(PyExc_ValueError, "expected a SceneTree that is open");
		return nullptr;
	}
	return &found->second;
}

} // namespace

std::unique_ptr<Object> make_tree() {
	Runtime runtime;
	runtime.server = std::make_unique<RenderingServer>(nullptr);
	auto tree = std::make_unique<scene::SceneTree>(runtime.server.get());
	runtimes()[tree->get_instance_id().value] = std::move(runtime);
	return tree;
}

void close_tree(std::unique_ptr<Object> p_tree) {
	const auto found = runtimes().find(p_tree->get_instance_id().value);
	Runtime runtime;
	if (found != runtimes().end()) {
		runtime = std::move(found->second);
		runtimes().erase(found);
	}
	if (runtime.server && runtime.viewport.is_valid()) {
		runtime.server->free(runtime.viewport);
	}
	p_tree.reset();
}

void close_all() {
	while (!runtimes().empty()) {
		std::unique_ptr<Object> tree = ScriptOwned::take(ObjectID{ runtimes().begin()->first });
		if (!tree) {
			runtimes().erase(runtimes().begin());
			continue;
		}
		close_tree(std::move(tree));
	}
	device.reset();
}

PyObject *make_array(std::vector<float> p_values, uint32_t p_width, uint32_t p_height, uint32_t p_channels) {
	auto *values = new std::vector<float>(std::move(p_values));
	const py::capsule owner(values, [](void *p_pointer) { delete static_cast<std::vector<float> *>(p_pointer); });
	std::vector<py::ssize_t> shape = { py::ssize_t(p_height), py::ssize_t(p_width) };
	if (p_channels > 1) {
		shape.push_back(py::ssize_t(p_channels));
	}
	return py::array_t<float>(shape, values->data(), owner).release().ptr();
}

PyObject *render(Object &r_tree, const RenderRequest &p_request) {
	Runtime *runtime = runtime_of(r_tree);
	const std::vector<std::string> names(std::begin(AOV_NAMES), std::end(AOV_NAMES));
	if (!runtime || !check_size(p_request.width, p_request.height, MAX_IMAGE_SIZE) ||
			!check_names(p_request.aovs, names)) {
		return nullptr;
	}
	const auto start = std::chrono::steady_clock::now();
	if (!open_device(*runtime, p_request.device) ||
			!check_size(p_request.width, p_request.height, device->info().max_texture_2d_texels)) {
		return nullptr;
	}
	scene::SceneTree &tree = static_cast<scene::SceneTree &>(r_tree);
	RenderingServer &server = *runtime->server;
	tree.flush();
	scene::Camera3D *camera = choose_camera(
			tree, server, p_request.camera, float(p_request.width) / float(p_request.height));
	if (!camera) {
		return nullptr;
	}
	if (!runtime->viewport.is_valid()) {
		runtime->viewport = server.viewport_create();
		server.viewport_set_scenario(runtime->viewport, tree.get_scenario());
	}
	server.viewport_set_size(runtime->viewport, p_request.width, p_request.height);
	server.viewport_attach_camera(runtime->viewport, camera->get_camera_rid());
	server.viewport_set_aov(runtime->viewport, !p_request.aovs.empty());
	RenderSummary summary;
	summary.load_s = seconds_since(start);
	if (!draw_frames(tree, *runtime, p_request, summary)) {
		return nullptr;
	}
	py::object color = py::reinterpret_steal<py::object>(
			read_buffer(server, runtime->viewport, ViewportBuffer::COLOR_LINEAR));
	py::object display = py::none();
	if (p_request.srgb) {
		display = py::reinterpret_steal<py::object>(
				make_display_array(server.viewport_get_image(runtime->viewport, ViewportBuffer::COLOR_DISPLAY)));
	}
	py::dict aovs;
	read_aovs(server, runtime->viewport, p_request.aovs, aovs);
	summary.total_s = seconds_since(start);
	summary.render_s = summary.total_s - summary.load_s;
	RenderOptions options;
	const scene::Node *scene = tree.get_current_scene();
	options.scene = scene ? scene->get_scene_file_path() : "";
	options.width = p_request.width;
	options.height = p_request.height;
	return py::make_tuple(color, display, aovs, stats_json(options, summary, server)).release().ptr();
}

PyObject *reference(Object &r_tree, const ReferenceRequest &p_request) {
	Runtime *runtime = runtime_of(r_tree);
	const std::vector<std::string> names = { "direct", "indirect", "emission", "background", "albedo", "normal",
		"depth" };
	if (!runtime || !check_size(p_request.width, p_request.height, MAX_IMAGE_SIZE) ||
			!check_names(p_request.aovs, names)) {
		return nullptr;
	}
	scene::SceneTree &tree = static_cast<scene::SceneTree &>(r_tree);
	tree.flush();
	scene::Camera3D *camera = choose_camera(
			tree, *runtime->server, p_request.camera, float(p_request.width) / float(p_request.height));
	if (!camera) {
		return nullptr;
	}
	Result<std::unique_ptr<PathTracer>> tracer = PathTracer::create(
			runtime->server->scenario_snapshot(), tree.get_scenario(), camera->get_camera_rid());
	if (!tracer) {
		return raise(tracer.error());
	}
	PathTracerSettings settings;
	settings.width = p_request.width;
	settings.height = p_request.height;
	settings.spp = p_request.spp;
	settings.seed = p_request.seed;
	settings.aov = !p_request.aovs.empty();
	std::atomic<bool> cancel = false;
	settings.cancel = &cancel;
	Result<PathTracerResult> result = Error();
	{
		const py::gil_scoped_release release;
		result = tracer.value()->render(settings, [&](const PathTracerProgress &) {
			const py::gil_scoped_acquire acquire;
			cancel = cancel || PyErr_CheckSignals() < 0;
		});
	}
	if (PyErr_Occurred()) {
		return nullptr;
	}
	if (!result) {
		return raise(result.error());
	}
	PathTracerResult picture = result.take();
	const auto array = [&](std::vector<float> &r_values, uint32_t p_channels = 3) {
		return py::reinterpret_steal<py::object>(
				make_array(std::move(r_values), picture.width, picture.height, p_channels));
	};
	std::vector<float> *const layers[] = { &picture.direct, &picture.indirect, &picture.emission, &picture.background,
		&picture.albedo, &picture.normal, &picture.depth };
	py::dict aovs;
	for (const std::string &name : p_request.aovs) {
		aovs[py::str(name)] = array(
				*layers[std::find(names.begin(), names.end(), name) - names.begin()], name == "depth" ? 1 : 3);
	}
	return py::make_tuple(array(picture.radiance), array(picture.variance), aovs, picture.rays, picture.seconds)
			.release()
			.ptr();
}

PyObject *open_scene(Object &r_tree, const std::string &p_path) {
	const auto fail = [](const Error &p_error) -> PyObject * {
		return PyErr_SetString(load_error, p_error.message.c_str()), nullptr;
	};
	Result<Ref<Resource>> resource = scene::ResourceLoader::load(p_path);
	if (!resource) {
		return fail(resource.error());
	}
	const auto packed = std::dynamic_pointer_cast<scene::PackedScene>(resource.value());
	if (!packed) {
		return fail(make_error(
				"{}: expected a scene, found a resource of class {}", p_path, resource.value()->get_class()));
	}
	Result<std::unique_ptr<scene::Node>> scene = packed->instantiate();
	if (!scene) {
		return fail(scene.error());
	}
	add_preview_environment(*scene.value());
	static_cast<scene::SceneTree &>(r_tree).set_current_scene(scene.take());
	Py_RETURN_NONE;
}

} // namespace lucent::python
