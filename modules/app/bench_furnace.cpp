// SPDX-License-Identifier: MIT
#include "modules/app/bench_furnace.h"
#include "modules/app/bench.h"
#include "modules/app/bench_results.h"
#include "modules/app/bench_rig.h"
#include "modules/app/register_modules.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>

namespace lucent {

namespace {

// The cells are the scene's on every device: with 64 an axis, as bench quality has them on a CPU, edges of cascades lie within the picture.
constexpr uint32_t CPU_FRAMES = 76;
constexpr uint32_t GPU_FRAMES = 512;

struct FurnaceScene {
	std::string name;
	std::string path;
};

bool is_scene_file(const std::string &p_argument) {
	const std::string extension = std::filesystem::path(p_argument).extension().string();
	return extension == ".tscn" || extension == ".gltf" || extension == ".glb";
}

// Arguments that end like a file are paths, others names of the folder's scenes; none: all of these.
Result<std::vector<FurnaceScene>> furnace_scenes(const BenchOptions &p_options) {
	BenchOptions named = p_options;
	std::erase_if(named.names, is_scene_file);
	std::vector<FurnaceScene> scenes;
	if (p_options.names.empty() || !named.names.empty()) {
		const Result<std::vector<std::string>> names = bench_scenes(named);
		if (!names) {
			return names.error();
		}
		for (const std::string &name : names.value()) {
			scenes.push_back({ name, p_options.scenes + name + ".tscn" });
		}
	}
	for (const std::string &argument : p_options.names) {
		if (is_scene_file(argument)) {
			scenes.push_back({ std::filesystem::path(argument).stem().string(), argument });
		}
	}
	std::map<std::string, uint32_t> uses;
	for (FurnaceScene &scene : scenes) {
		const uint32_t use = ++uses[scene.name];
		scene.name += use > 1 ? "_" + std::to_string(use) : "";
	}
	return scenes;
}

Result<FurnaceRow> measure_row(RenderingDevice &r_device, const BenchOptions &p_options, const FurnaceScene &p_scene, float p_albedo) {
	const auto start = std::chrono::steady_clock::now();
	FurnaceRow row = { .name = p_scene.name, .path = p_scene.path, .albedo = p_albedo };
	BenchScene scene(r_device);
	if (const Status status = scene.load(p_scene.path, p_options, p_options.width, p_options.height); !status) {
		return status.error();
	}
	make_furnace(scene.rendering_server(), scene.viewport(), p_albedo);
	const uint32_t limit = p_options.frames != 0 ? p_options.frames : GPU_FRAMES;
	while (row.frames < limit && !row.settled) {
		row.gi = scene.draw().stats.gi;
		row.settled = row.gi.converged;
		row.frames++;
	}
	row.picture = scene.picture(ViewportBuffer::COLOR_LINEAR);
	const Result<FurnaceError> error = measure_furnace(row.picture);
	if (!error) {
		return make_error("{}: {}", p_scene.path, error.error().message);
	}
	row.error = error.value();
	row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	return row;
}

// The first figure that a person asks for: how much of the picture is wrong; then how far the mean is.
void sort_rows(std::vector<FurnaceRow> &r_rows) {
	std::stable_sort(r_rows.begin(), r_rows.end(), [](const FurnaceRow &p_a, const FurnaceRow &p_b) {
		if (p_a.albedo != p_b.albedo) {
			return p_a.albedo < p_b.albedo;
		}
		return std::pair(p_a.error.off, std::abs(p_a.error.mean - 1.0)) > std::pair(p_b.error.off, std::abs(p_b.error.mean - 1.0));
	});
}

Result<std::vector<FurnaceRow>> measure_rows(RenderingDevice &r_device, const BenchOptions &p_options, const std::vector<FurnaceScene> &p_scenes) {
	std::vector<FurnaceRow> rows;
	for (const FurnaceScene &scene : p_scenes) {
		for (const float albedo : p_options.albedos) {
			Result<FurnaceRow> row = measure_row(r_device, p_options, scene, albedo);
			if (!row) {
				return row.error();
			}
			rows.push_back(row.take());
			if (!p_options.quiet) {
				const FurnaceRow &last = rows.back();
				std::fprintf(stderr, "%s, albedo %g: mean %.4f, %u frames, %.1f s\n", scene.name.c_str(), double(albedo), last.error.mean, last.frames, last.seconds);
			}
		}
	}
	sort_rows(rows);
	return rows;
}

} // namespace

int bench_furnace(const BenchOptions &p_options) {
	const Result<std::vector<FurnaceScene>> scenes = furnace_scenes(p_options);
	if (!scenes) {
		return bench_failure(EXIT_BAD_INPUT, scenes.error());
	}
	if (const Status status = prepare_output(p_options); !status) {
		return bench_failure(EXIT_OUTPUT, status.error());
	}
	const Result<std::unique_ptr<RenderingDevice>> device = create_bench_device(p_options);
	if (!device) {
		return bench_failure(EXIT_DEVICE, device.error());
	}
	BenchOptions options = p_options;
	if (is_cpu_device(device.value()->info())) {
		options.frames = options.frames != 0 ? options.frames : CPU_FRAMES;
	}
	register_modules();
	const Result<std::vector<FurnaceRow>> rows = measure_rows(*device.value(), options, scenes.value());
	if (!rows) {
		return bench_failure(EXIT_BAD_INPUT, rows.error());
	}
	nlohmann::ordered_json conditions = bench_conditions(p_options, device.value()->info());
	conditions["size"] = { p_options.width, p_options.height };
	conditions["grid"] = options.grid; // 0: the scene's
	if (const Status status = write_furnace(p_options, rows.value(), conditions); !status) {
		return bench_failure(EXIT_OUTPUT, status.error());
	}
	return EXIT_OK;
}

} // namespace lucent
