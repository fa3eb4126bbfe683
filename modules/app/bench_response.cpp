// SPDX-License-Identifier: MIT
#include "modules/app/bench_response.h"

#include "modules/app/bench.h"
#include "modules/app/bench_results.h"
#include "modules/app/bench_rig.h"
#include "modules/app/property_setting.h"
#include "modules/app/register_modules.h"
#include "modules/scene/camera_3d.h"
#include "modules/scene/environment.h"
#include "modules/scene/light_3d.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace lucent {

namespace {

ResponsePreset response_preset(const BenchOptions &p_options, const DeviceInfo &p_device) {
	ResponsePreset preset;
	if (p_options.preset.empty() ? is_cpu_device(p_device) : p_options.preset == "cpu") {
		preset = { .width = 128, .height = 72, .grid = 64, .frames_to_converge = 4, .settle_frames = 108, .frames = 64 };
	}
	preset.frames = p_options.frames != 0 ? p_options.frames : preset.frames;
	preset.grid = p_options.grid != 0 ? p_options.grid : preset.grid;
	return preset;
}

Status load(BenchScene &r_scene, const BenchOptions &p_options, const ResponsePreset &p_preset, const std::string &p_name) {
	BenchOptions options = p_options;
	options.grid = p_preset.grid;
	if (const Status status = r_scene.load(p_options.scenes + p_name + ".tscn", options, p_preset.width, p_preset.height); !status) {
		return status;
	}
	if (r_scene.environment() == nullptr || r_scene.camera() == nullptr) {
		return make_error("{}: lacks its environment or camera", p_name);
	}
	if (p_preset.frames_to_converge != 0) {
		r_scene.environment()->sdfgi.frames_to_converge = p_preset.frames_to_converge;
		r_scene.environment()->state_changed();
	}
	return Ok();
}

template <typename T>
Result<T *> node_of(BenchScene &r_scene, const std::string &p_name) {
	const Result<scene::Node *> node = find_node(r_scene.root(), p_name);
	if (!node) {
		return node.error();
	}
	T *typed = dynamic_cast<T *>(node.value());
	if (typed == nullptr) {
		return make_error("node '{}' is a {}", p_name, node.value()->get_class());
	}
	return typed;
}

Status double_sun(BenchScene &r_scene) {
	const Result<scene::Light3D *> sun = node_of<scene::Light3D>(r_scene, "Sun0");
	if (!sun) {
		return sun.error();
	}
	Light parameters = sun.value()->get_parameters();
	parameters.energy *= 2.0f;
	sun.value()->set_parameters(parameters);
	return Ok();
}

uint32_t double_emission(scene::Node &r_node) {
	uint32_t found = 0;
	if (const auto *instance = dynamic_cast<scene::MeshInstance3D *>(&r_node); instance != nullptr && instance->get_mesh() != nullptr) {
		for (int surface = 0; surface < instance->get_mesh()->get_surface_count(); surface++) {
			const auto material = std::dynamic_pointer_cast<scene::BaseMaterial3D>(instance->get_active_material(surface));
			if (material != nullptr && material->get_state().emission_enabled) {
				scene::BaseMaterial3D::State state = material->get_state();
				state.emission_energy_multiplier *= 2.0f;
				material->set_state(state);
				found++;
			}
		}
	}
	for (const std::unique_ptr<scene::Node> &child : r_node.get_children()) {
		found += double_emission(*child);
	}
	return found;
}

Status double_panel(BenchScene &r_scene) {
	return double_emission(r_scene.root()) > 0 ? Status(Ok()) : Status(make_error("nothing in the scene emits"));
}

Status place(BenchScene &r_scene, const char *p_node, const Transform3D &p_transform) {
	const Result<scene::Node3D *> node = node_of<scene::Node3D>(r_scene, p_node);
	if (!node) {
		return node.error();
	}
	node.value()->set_transform(p_transform);
	return Ok();
}

const Transform3D CLOSED_DOOR = { Basis(1.0f), Vector3(0.0f, 1.0f, 0.0f) };
const Transform3D OPEN_DOOR = { Basis(0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f, -1.0f, 0.0f, 0.0f), Vector3(0.6f, 1.0f, -0.55f) };
const Transform3D MOVED_LAMP = { Basis(1.0f), Vector3(-2.0f, 0.6f, 0.8f) };

struct Change {
	const char *name;
	const char *scene;
	Status (*before)(BenchScene &); // null: nothing to do
	Status (*change)(BenchScene &);
};
const Change CHANGES[] = {
	{ "sun doubles", "sun_room", nullptr, double_sun },
	{ "emitter doubles", "cornell", nullptr, double_panel },
	{ "door opens", "door", [](BenchScene &r_scene) { return place(r_scene, "Door", CLOSED_DOOR); }, [](BenchScene &r_scene) { return place(r_scene, "Door", OPEN_DOOR); } },
	{ "door closes", "door", nullptr, [](BenchScene &r_scene) { return place(r_scene, "Door", CLOSED_DOOR); } },
	{ "emitter moves 2.2 m", "door", nullptr, [](BenchScene &r_scene) { return place(r_scene, "Lamp", MOVED_LAMP); } },
};

double luminance(const MetricImage &p_image, size_t p_pixel) {
	return 0.2126 * p_image.values[3 * p_pixel] + 0.7152 * p_image.values[3 * p_pixel + 1] + 0.0722 * p_image.values[3 * p_pixel + 2];
}

// Pixels whose light changes by more than a tenth of what it is, and by more than a hundredth of the picture's mean.
std::vector<size_t> affected_pixels(const MetricImage &p_before, const MetricImage &p_after) {
	double mean = 0;
	for (size_t i = 0; i < p_before.pixel_count(); i++) {
		mean += std::max(luminance(p_before, i), luminance(p_after, i)) / double(p_before.pixel_count());
	}
	std::vector<size_t> pixels;
	for (size_t i = 0; i < p_before.pixel_count(); i++) {
		const double before = luminance(p_before, i), after = luminance(p_after, i);
		if (std::abs(after - before) > std::max(0.1 * std::max(before, after), 0.01 * mean)) {
			pixels.push_back(i);
		}
	}
	return pixels;
}

// How far the pixels have gone where they are going, on average: brighter and darker ones both count as progress.
double mean_progress(const MetricImage &p_image, const MetricImage &p_before, const MetricImage &p_after, const std::vector<size_t> &p_pixels) {
	double sum = 0;
	for (const size_t pixel : p_pixels) {
		const double before = luminance(p_before, pixel);
		sum += (luminance(p_image, pixel) - before) * (luminance(p_after, pixel) > before ? 1.0 : -1.0);
	}
	return p_pixels.empty() ? 0.0 : sum / double(p_pixels.size());
}

// The largest difference of a channel between frames that nothing lies between; also whether rays were traced.
void measure_rest(BenchScene &r_scene, ResponseRow &r_row) {
	constexpr uint32_t FRAMES = 4;
	MetricImage last = r_scene.picture(ViewportBuffer::COLOR_LINEAR);
	for (uint32_t i = 0; i < FRAMES; i++) {
		const FrameSample sample = r_scene.draw();
		const MetricImage next = r_scene.picture(ViewportBuffer::COLOR_LINEAR);
		r_row.rest_rays = std::max(r_row.rest_rays, sample.stats.gi.rays);
		for (size_t k = 0; k < next.values.size(); k++) {
			r_row.rest_difference = std::max(r_row.rest_difference, double(std::abs(next.values[k] - last.values[k])));
		}
		last = next;
	}
}

Result<ResponseRow> measure_change(RenderingDevice &r_device, const BenchOptions &p_options, const ResponsePreset &p_preset, const Change &p_change) {
	ResponseRow row = { .name = p_change.name, .scene = p_change.scene };
	BenchScene scene(r_device);
	if (const Status status = load(scene, p_options, p_preset, p_change.scene); !status) {
		return status.error();
	}
	scene.keep_layers(true);
	if (p_change.before != nullptr) {
		if (const Status status = p_change.before(scene); !status) {
			return status.error();
		}
	}
	row.settled = scene.settle(p_preset.settle_frames, &row.settle_frames);
	measure_rest(scene, row);
	const MetricImage before = scene.picture(ViewportBuffer::INDIRECT_DIFFUSE);
	if (const Status status = p_change.change(scene); !status) {
		return status.error();
	}
	std::vector<MetricImage> pictures;
	for (uint32_t i = 0; i < p_preset.frames; i++) {
		row.ended = scene.draw().stats.gi.converged;
		pictures.push_back(scene.picture(ViewportBuffer::INDIRECT_DIFFUSE));
	}
	const std::vector<size_t> pixels = affected_pixels(before, pictures.back());
	for (const MetricImage &picture : pictures) {
		row.curve.push_back(mean_progress(picture, before, pictures.back(), pixels));
	}
	row.affected = double(pixels.size()) / double(before.pixel_count());
	row.response = response_of(0.0, row.curve);
	return row;
}

// Where cascade 0 has a choice: between two multiples of the spacing it stays where it came from. The camera goes there from one side,
// then steps over the edge and back: the same view, the cascade a probe further.
Result<ScrollResult> measure_scroll(RenderingDevice &r_device, const BenchOptions &p_options, const ResponsePreset &p_preset) {
	ScrollResult result;
	BenchScene scene(r_device);
	if (const Status status = load(scene, p_options, p_preset, "sun_room"); !status) {
		return status.error();
	}
	const SdfgiSettings sdfgi = scene.environment()->sdfgi;
	const float step_m = sdfgi.min_cell_size_m * float(sdfgi.probe_spacing_cells);
	Transform3D view = scene.camera()->get_global_transform();
	view.origin.x = (std::floor(view.origin.x / step_m) + 0.3f) * step_m;
	scene.camera()->set_global_transform(view);
	result.settled = scene.settle(p_preset.settle_frames);
	const MetricImage before = scene.picture(ViewportBuffer::COLOR_DISPLAY);
	Transform3D beyond = view;
	beyond.origin.x += 0.75f * step_m;
	scene.camera()->set_global_transform(beyond);
	scene.draw();
	scene.camera()->set_global_transform(view);
	for (uint32_t frame = 0; frame < p_preset.frames; frame++) {
		scene.draw();
		const MetricImage after = scene.picture(ViewportBuffer::COLOR_DISPLAY);
		std::vector<double> steps;
		for (size_t i = 0; i < after.values.size(); i++) {
			steps.push_back(std::abs(std::round(after.values[i] * 255.0f) - std::round(before.values[i] * 255.0f)));
		}
		result.p99_steps.push_back(percentile(steps, 0.99));
		result.max_steps.push_back(percentile(steps, 1.0));
	}
	return result;
}

Result<MetricImage> draw_once(const BenchOptions &p_options, const ResponsePreset &p_preset) {
	const Result<std::unique_ptr<RenderingDevice>> device = create_bench_device(p_options);
	if (!device) {
		return device.error();
	}
	BenchScene scene(*device.value());
	if (const Status status = load(scene, p_options, p_preset, "rooms_1"); !status) {
		return status.error();
	}
	for (uint32_t frame = 0; frame < REPEAT_FRAMES; frame++) {
		scene.draw();
	}
	return scene.picture(ViewportBuffer::COLOR_LINEAR);
}

} // namespace

int bench_response(const BenchOptions &p_options) {
	if (const Status status = prepare_output(p_options); !status) {
		return bench_failure(EXIT_OUTPUT, status.error());
	}
	register_modules();
	ResponseResult result;
	nlohmann::ordered_json conditions;
	{
		const Result<std::unique_ptr<RenderingDevice>> device = create_bench_device(p_options);
		if (!device) {
			return bench_failure(EXIT_DEVICE, device.error());
		}
		result.preset = response_preset(p_options, device.value()->info());
		conditions = bench_conditions(p_options, device.value()->info());
		for (const Change &change : CHANGES) {
			Result<ResponseRow> row = measure_change(*device.value(), p_options, result.preset, change);
			if (!row) {
				return bench_failure(EXIT_BAD_INPUT, row.error());
			}
			result.rows.push_back(row.take());
			if (!p_options.quiet) {
				std::fprintf(stderr, "%s\n", change.name);
			}
		}
		Result<ScrollResult> scroll = measure_scroll(*device.value(), p_options, result.preset);
		if (!scroll) {
			return bench_failure(EXIT_BAD_INPUT, scroll.error());
		}
		result.scroll = scroll.take();
	}
	const Result<MetricImage> first = draw_once(p_options, result.preset), second = draw_once(p_options, result.preset);
	if (!first || !second) {
		return bench_failure(EXIT_BAD_INPUT, first ? second.error() : first.error());
	}
	result.repeats = first.value().values == second.value().values;
	if (const Status status = write_response(p_options, result, conditions); !status) {
		return bench_failure(EXIT_OUTPUT, status.error());
	}
	return result.repeats && result.rests() ? EXIT_OK : EXIT_WORSE;
}

} // namespace lucent
