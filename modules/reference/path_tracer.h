// SPDX-License-Identifier: MIT
#pragma once
// The truth: an unbiased path tracer (Embree) on the scene that RenderingServer holds, with the raster frame's BRDF, camera and units.
//
// Conventions where a raster frame and light transport differ:
//   - camera rays see what the raster camera sees: culled sides are skipped, shadows-only instances are invisible;
//   - every other ray finds both sides of each surface; they reflect with the same albedo, whatever the material culls;
//   - a surface emits from its visible sides only: the front with MaterialCull::BACK, both with DISABLED;
//   - on the first surface a lamp has no shadow where shadow_enabled is off; after that everything stops it, as in GI, and indirect_energy
//     and bake_mode apply;
//   - negative lamps: a pixel's mean is at least 0, and so is the sum of all lamps where light bounces;
//   - occlusion textures, ambient colours and read_sky_light are approximations of transport and are ignored;
//   - coordinates are relative to the RenderOrigin of the frame that the camera would draw;
//   - textures are read at level 0, bilinear unless the filter is nearest.

#include "servers/core/error.h"
#include "servers/rendering/render_scene.h"

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

namespace lucent {

// How a pixel weighs what is around its centre. Samples are drawn by the filter and count alike, so pixels stay independent.
enum class PixelFilter : uint8_t {
	BOX, // the mean over the pixel, as a raster frame with all samples
	BLACKMAN_HARRIS, // 1.5 pixels wide in each direction, what Cycles does by default
};

struct PathTracerSettings {
	uint32_t width = 256;
	uint32_t height = 144;
	uint32_t spp = 64; // samples a pixel, at most 2^24
	uint32_t seed = 0;
	uint32_t threads = 0; // 0: as many as the machine has. The result doesn't depend on it
	double time_limit_s = 0; // 0: none. Checked between tiles once every pixel has a sample, so pixels may end with different numbers of them
	PixelFilter filter = PixelFilter::BOX;
	bool aov = false; // keep the layers of the first hit: 136 bytes a pixel more than the picture's 56
	const std::atomic<bool> *cancel = nullptr; // set by another thread or a signal: stop, keep what there is
};

struct PathTracerProgress {
	uint32_t spp_done = 0;
	uint32_t spp = 0;
	double elapsed_s = 0;
	double remaining_s = 0; // estimated, the sooner of spp and time limit
};

// Linear, scene-referred, rows from the top, width * height * 3 floats (depth: 1).
struct PathTracerResult {
	uint32_t width = 0;
	uint32_t height = 0;
	uint32_t spp = 0; // done for every pixel, at least
	uint64_t untraced_pixels = 0; // without a sample, as the first pass was cancelled; black
	double seconds = 0;
	uint64_t rays = 0; // traced, shadow rays included
	uint64_t bad_samples = 0; // not finite: counted as black
	std::vector<float> radiance; // the mean
	std::vector<float> variance; // of the mean: +- 1.96 sqrt(variance) is a 95 % interval. Unknown, and written as 0, where a pixel has fewer than 2 samples

	// With PathTracerSettings::aov; else empty. radiance = direct + indirect + emission + background, but for pixels
	// that negative lamps would take below 0.
	std::vector<float> direct; // light of lamps that the first surface reflects
	std::vector<float> indirect; // everything else that it reflects: emissive surfaces, sky, bounces
	std::vector<float> emission; // of the first surface (unshaded ones: their colour)
	std::vector<float> background; // sky seen directly
	std::vector<float> albedo;
	std::vector<float> normal; // world, shading
	std::vector<float> depth; // m along the camera's axis; 0: no surface
};

// Throughput on one machine in one run, by CPU time times the number of threads: what an idle machine would reach.
struct PathTracerThroughput {
	double path_tracer_mrays_s = 0; // millions of rays a second, with shading and everything
	double bare_mrays_s = 0; // rtcIntersect1 alone, on rays recorded from the same paths
	uint64_t recorded_rays = 0;
};

class PathTracer {
public:
	// Copies what it needs but meshes and textures, which it shares. Fails for stale ids and where Embree does.
	static Result<std::unique_ptr<PathTracer>> create(const RenderScene &p_scene, ScenarioRid p_scenario, CameraRid p_camera);
	~PathTracer();

	// Fails for sizes outside 1..16384 and spp outside 1..2^24. p_progress: after each pass, on the calling thread; may be empty.
	Result<PathTracerResult> render(const PathTracerSettings &p_settings, const std::function<void(const PathTracerProgress &)> &p_progress = {});

	// Records at most 4 million rays of p_settings' samples, then traces those samples and replays the rays through rtcIntersect1 in turn, with
	// as many threads, until spp samples are done and both have run for a second. Shadow rays are replayed as nearest hits too.
	Result<PathTracerThroughput> measure_throughput(const PathTracerSettings &p_settings);

private:
	struct Impl;
	explicit PathTracer(std::unique_ptr<Impl> p_impl);
	std::unique_ptr<Impl> impl;
};

} // namespace lucent
