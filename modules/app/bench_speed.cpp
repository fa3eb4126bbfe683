// SPDX-License-Identifier: MIT
#include "modules/app/bench_speed.h"

#include "modules/app/bench.h"
#include "modules/app/bench_results.h"
#include "modules/app/register_modules.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace lucent {

namespace {

constexpr float REACH_M = 8.0f; // the moving camera turns back this far from where it started

// There and back along x, at a constant speed.
Transform3D moved(const Transform3D &p_start, float p_meters) {
	const float along = std::fmod(p_meters, 2.0f * REACH_M);
	Transform3D result = p_start;
	result.origin.x += along <= REACH_M ? along : 2.0f * REACH_M - along;
	return result;
}

Transform3D turned(const Transform3D &p_start, float p_degrees) {
	const float angle = glm::radians(p_degrees);
	const Basis turn(std::cos(angle), 0.0f, -std::sin(angle), 0.0f, 1.0f, 0.0f, std::sin(angle), 0.0f, std::cos(angle));
	return { turn * p_start.basis, p_start.origin };
}

// p_change: what is different in each frame, the first is 0.
template <typename F>
SpeedState run_state(SpeedScene &r_scene, uint32_t p_frames, const std::string &p_name, const std::string &p_what, const F &p_change) {
	SpeedState state = { .name = p_name, .what = p_what };
	for (uint32_t frame = 0; frame < p_frames; frame++) {
		p_change(frame);
		state.frames.push_back(r_scene.bench.draw());
	}
	return state;
}

} // namespace

SpeedPreset speed_preset(const BenchOptions &p_options, const DeviceInfo &p_device) {
	SpeedPreset preset;
	if (p_options.preset.empty() ? is_cpu_device(p_device) : p_options.preset == "cpu") {
		preset = { .cpu = true, .width = 240, .height = 135, .grid = 64, .frames = 4, .settle_frames = 80, .cascades = 2, .frames_to_converge = 1, .frames_a_second = 15.0f, .scaling_frames = 1, .max_instanced_triangles = 1'000'000, .max_lights = 100 };
	}
	preset.frames = p_options.frames != 0 ? p_options.frames : preset.frames;
	preset.grid = p_options.grid != 0 ? p_options.grid : preset.grid;
	return preset;
}

std::vector<PassRow> pass_rows(const std::vector<FrameSample> &p_frames) {
	std::vector<std::string> names;
	std::vector<std::vector<double>> sums;
	for (size_t frame = 0; frame < p_frames.size(); frame++) {
		for (const PassTiming &pass : p_frames[frame].passes) {
			const size_t index = size_t(std::find(names.begin(), names.end(), pass.name) - names.begin());
			if (index == names.size()) {
				names.push_back(pass.name);
				sums.emplace_back(p_frames.size(), 0.0);
			}
			sums[index][frame] += pass.gpu_ms;
		}
	}
	std::vector<PassRow> rows;
	for (size_t i = 0; i < names.size(); i++) {
		rows.push_back({ names[i], distribution_of(sums[i]) });
	}
	return rows;
}

Distribution gi_distribution(const std::vector<FrameSample> &p_frames) {
	std::vector<double> values;
	for (const FrameSample &frame : p_frames) {
		values.push_back(frame.gi_ms());
	}
	return distribution_of(values);
}

Distribution gpu_distribution(const std::vector<FrameSample> &p_frames) {
	std::vector<double> values;
	for (const FrameSample &frame : p_frames) {
		values.push_back(frame.gpu_ms());
	}
	return distribution_of(values);
}

void run_states(SpeedScene &r_scene, bool p_quiet, SpeedResult &r_result) {
	const SpeedPreset &preset = r_result.preset;
	// Each state starts from rest, so that it holds nothing of the one before; on a CPU device, where that would take minutes, from a frame later.
	const auto run = [&](const std::string &p_name, const std::string &p_what, const auto &p_change) {
		r_scene.bench.settle(preset.cpu ? 1 : preset.settle_frames);
		r_result.states.push_back(run_state(r_scene, preset.frames, p_name, p_what, p_change));
		if (!p_quiet) {
			std::fprintf(stderr, "%s\n", p_name.c_str());
		}
	};
	const auto count = [&](const std::string &p_what) { r_result.fetches.push_back({ p_what, r_scene.count_fetches() }); };
	uint32_t needed = 0;
	r_result.settled_after = r_scene.bench.settle(preset.settle_frames, &needed) ? needed : 0;
	run("settled", "still camera, nothing changes", [](uint32_t) {});
	count("settled");
	run("turning", "3 degrees a frame", [&](uint32_t p_frame) { r_scene.set_camera(turned(r_scene.start(), 3.0f * float(p_frame + 1))); });
	r_scene.set_camera(r_scene.start());
	run("light step", "the sun doubles in the first frame", [&](uint32_t p_frame) {
		if (p_frame == 0) {
			r_scene.set_sun(2.0f);
		}
	});
	r_scene.set_sun(1.0f);
	run("light every frame", "the sun changes by 0.1 % in every frame", [&](uint32_t p_frame) { r_scene.set_sun(1.0f + 0.001f * float(p_frame % 2 + 1)); });
	r_scene.set_sun(1.0f);
	count("light changes");
	for (const float speed : { 10.0f, 40.0f }) {
		run(fmt::format("moving {:g} m/s", speed), "there and back along the court", [&](uint32_t p_frame) { r_scene.set_camera(moved(r_scene.start(), speed / preset.frames_a_second * float(p_frame + 1))); });
		r_scene.set_camera(r_scene.start());
	}
	const Result<Transform3D> other = r_scene.other_camera();
	run("teleport", "to another camera in the first frame", [&](uint32_t p_frame) {
		if (p_frame == 0 && other.ok()) {
			r_scene.set_camera(other.value());
		}
	});
	r_scene.set_camera(r_scene.start());
	count("all built anew");
}

int bench_speed(const BenchOptions &p_options) {
	if (const Status status = prepare_output(p_options); !status) {
		return bench_failure(EXIT_OUTPUT, status.error());
	}
	const Result<std::unique_ptr<RenderingDevice>> device = create_bench_device(p_options);
	if (!device) {
		return bench_failure(EXIT_DEVICE, device.error());
	}
	if (!device.value()->info().timestamps) {
		return bench_failure(EXIT_DEVICE, make_error("{}: the device measures no GPU times", device.value()->info().name));
	}
	register_modules();
	SpeedResult result;
	result.preset = speed_preset(p_options, device.value()->info());
	SpeedScene scene(*device.value(), result.preset);
	if (const Status status = scene.load(p_options); !status) {
		return bench_failure(EXIT_BAD_INPUT, status.error());
	}
	run_states(scene, p_options.quiet, result);
	result.memory = device.value()->memory_report();
	result.scaling = run_scaling(scene, result.preset, p_options.quiet);
	nlohmann::ordered_json conditions = bench_conditions(p_options, device.value()->info());
	conditions["scene"] = "doc/samples/atrium/atrium.tscn";
	conditions["preset"] = result.preset.cpu ? "cpu" : "gpu";
	conditions["size"] = { result.preset.width, result.preset.height };
	conditions["grid"] = result.preset.grid;
	conditions["cascades"] = scene.sdfgi().cascades;
	conditions["frames_to_converge"] = scene.sdfgi().frames_to_converge;
	conditions["frames_a_second"] = result.preset.frames_a_second;
	if (const Status status = write_speed(p_options, result, conditions); !status) {
		return bench_failure(EXIT_OUTPUT, status.error());
	}
	return EXIT_OK;
}

} // namespace lucent
