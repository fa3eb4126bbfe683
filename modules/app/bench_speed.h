// SPDX-License-Identifier: MIT
#pragma once

#include "modules/app/bench_rig.h"
#include "modules/bench/statistics.h"

#include <nlohmann/json_fwd.hpp>

namespace lucent {

struct SpeedPreset {
	bool cpu = false;
	uint32_t width = 1920;
	uint32_t height = 1080;
	uint32_t grid = 128;
	uint32_t frames = 240; // in each state
	uint32_t settle_frames = 600; // at most
	uint32_t cascades = 0; // 0: the scene's
	uint32_t frames_to_converge = 0; // 0: the default
	float frames_a_second = 60.0f; // of the moving camera
	uint32_t scaling_frames = 24; // with a light that changes, at each point
	uint32_t max_instanced_triangles = 10'000'000;
	uint32_t max_lights = 1000;
};
SpeedPreset speed_preset(const BenchOptions &p_options, const DeviceInfo &p_device);

// What happened over the frames of one state of the camera and the lights.
struct SpeedState {
	std::string name;
	std::string what;
	std::vector<FrameSample> frames;
};

// What the shaders loaded in one frame.
struct FetchFrame {
	std::string what;
	std::vector<GiFetches> passes;
};

struct PassRow {
	std::string name;
	Distribution ms; // of a pass's sum in a frame; frames without it count as 0
};
std::vector<PassRow> pass_rows(const std::vector<FrameSample> &p_frames); // in order of appearance
Distribution gi_distribution(const std::vector<FrameSample> &p_frames);
Distribution gpu_distribution(const std::vector<FrameSample> &p_frames);

struct ScalePoint {
	std::string group; // "cascades"
	std::string label; // "4"
	double x = 0;
	double first_ms = 0; // GI in the frame that builds everything
	double gi_ms = 0; // median of GI with a light that changes every frame
	double gather_ms = 0; // … of the passes called sdfgi.gather*
	double frame_ms = 0; // … of everything
	GiFetches fetches; // sum of all passes, with a light that changes
	GiStats gi;
};

struct SpeedResult {
	SpeedPreset preset;
	std::vector<SpeedState> states;
	std::vector<FetchFrame> fetches;
	uint32_t settled_after = 0; // frames; 0: not within the limit
	MemoryReport memory;
	std::vector<ScalePoint> scaling;
};

// The atrium, with hands on what speed depends on.
class SpeedScene {
public:
	SpeedScene(RenderingDevice &p_device, const SpeedPreset &p_preset) :
			bench(p_device), preset(p_preset) {}
	Status load(const BenchOptions &p_options);

	BenchScene bench;
	// The sun's energy, as a multiple of the scene's.
	void set_sun(float p_factor);
	Transform3D start() const { return start_transform; } // the camera's, as the scene has it
	void set_camera(const Transform3D &p_transform);
	Result<Transform3D> other_camera(); // where another of the scene's cameras stands

	SdfgiSettings sdfgi() const { return base_sdfgi; }
	void set_sdfgi(const SdfgiSettings &p_settings);
	// Draws a frame whose fetches are counted.
	std::vector<GiFetches> count_fetches();
	void add_lamps(uint32_t p_count);
	void add_emitter(float p_area_m2);
	// Hides the atrium and shows spheres instead; answers how many triangles those have.
	uint64_t show_spheres(uint64_t p_triangles);
	// Undoes set_sdfgi, add_* and show_spheres.
	void reset();

private:
	scene::Node &extras();
	SpeedPreset preset;
	SdfgiSettings base_sdfgi;
	Transform3D start_transform;
	float sun_energy = 1.0f;
};

// Fills in the result's states, fetches and settled_after.
void run_states(SpeedScene &r_scene, bool p_quiet, SpeedResult &r_result);
std::vector<ScalePoint> run_scaling(SpeedScene &r_scene, const SpeedPreset &p_preset, bool p_quiet);

// Prints the tables, writes speed.json and speed.html.
Status write_speed(const BenchOptions &p_options, const SpeedResult &p_result, const nlohmann::ordered_json &p_conditions);

} // namespace lucent
