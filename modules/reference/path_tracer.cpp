// SPDX-License-Identifier: MIT
#include "modules/reference/path_tracer.h"

#include "modules/reference/path_integrator.h"
#include "modules/reference/pixel_filter.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <pmmintrin.h>
#include <thread>

namespace lucent {

namespace {

constexpr uint32_t TILE_PIXELS = 16;
constexpr uint32_t MAX_SPP = 1u << 24;
constexpr uint32_t MAX_SIZE = 16384;

double seconds_since(std::chrono::steady_clock::time_point p_start) {
	return std::chrono::duration<double>(std::chrono::steady_clock::now() - p_start).count();
}

bool is_finite(const Vector3 &p_value) {
	return std::isfinite(p_value.x) && std::isfinite(p_value.y) && std::isfinite(p_value.z);
}

// Sums over a pixel's samples; doubles, so that a mean of 2^24 samples is still exact to a float.
struct PixelSums {
	glm::dvec3 sum{ 0.0 };
	glm::dvec3 square{ 0.0 };
	uint32_t count = 0;
};

struct LayerSums {
	glm::dvec3 direct{ 0.0 }, emission{ 0.0 }, background{ 0.0 }, albedo{ 0.0 }, normal{ 0.0 };
	double depth_m = 0;
	uint32_t surface_count = 0;

	void add(const PathLayers &p_sample) {
		direct += glm::dvec3(p_sample.direct);
		emission += glm::dvec3(p_sample.emission);
		background += glm::dvec3(p_sample.background);
		if (p_sample.depth_m > 0.0f) {
			albedo += glm::dvec3(p_sample.albedo);
			normal += glm::dvec3(p_sample.normal);
			depth_m += p_sample.depth_m;
			surface_count++;
		}
	}
};

// Runs p_work on p_count threads, each with denormals flushed as Embree wants.
template <typename F>
void run_threads(uint32_t p_count, const F &p_work) {
	std::vector<std::thread> threads;
	for (uint32_t i = 0; i < p_count; i++) {
		threads.emplace_back([&p_work, i] {
			_MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
			_MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
			p_work(i);
		});
	}
	for (std::thread &thread : threads) {
		thread.join();
	}
}

uint32_t thread_count(const PathTracerSettings &p_settings) {
	return p_settings.threads > 0 ? p_settings.threads : std::max(1u, std::thread::hardware_concurrency());
}

Status check_settings(const PathTracerSettings &p_settings) {
	if (p_settings.width < 1 || p_settings.width > MAX_SIZE || p_settings.height < 1 || p_settings.height > MAX_SIZE) {
		return make_error("path tracer: size {}x{} is outside 1 to {}", p_settings.width, p_settings.height, MAX_SIZE);
	}
	if (p_settings.spp < 1 || p_settings.spp > MAX_SPP) {
		return make_error("path tracer: {} samples a pixel are outside 1 to {}", p_settings.spp, MAX_SPP);
	}
	return Ok();
}

void put(std::vector<float> &r_values, const glm::dvec3 &p_value) {
	for (int i = 0; i < 3; i++) {
		r_values.push_back(float(p_value[i]));
	}
}

} // namespace

struct PathTracer::Impl {
	TraceWorld world;

	// One picture in the making.
	struct Film {
		const PathTracerSettings &settings;
		CameraRays camera_rays;
		PixelFilterSampler filter;
		std::vector<PixelSums> pixels;
		std::vector<LayerSums> layers;
		std::atomic<uint64_t> rays{ 0 };
		std::atomic<uint64_t> bad_samples{ 0 };
		std::vector<std::vector<Ray>> recordings; // by thread; empty: nothing is recorded
		size_t recording_limit = 0;

		bool cancelled() const { return settings.cancel && settings.cancel->load(std::memory_order_relaxed); }
	};

	std::unique_ptr<Film> make_film(const PathTracerSettings &p_settings) const {
		auto film = std::unique_ptr<Film>(new Film{ p_settings, CameraRays(world.camera, p_settings.width, p_settings.height), PixelFilterSampler(p_settings.filter), {}, {}, {}, {}, {}, 0 });
		film->pixels.resize(size_t(p_settings.width) * p_settings.height);
		film->layers.resize(p_settings.aov ? film->pixels.size() : 0);
		return film;
	}

	void trace_pixel(Film &r_film, PathIntegrator &r_integrator, uint32_t p_x, uint32_t p_y, uint32_t p_samples) const {
		const uint32_t index = p_y * r_film.settings.width + p_x;
		PixelSums &pixel = r_film.pixels[index];
		for (uint32_t i = 0; i < p_samples; i++) {
			Random random(r_film.settings.seed, index, pixel.count);
			const float x = float(p_x) + 0.5f + r_film.filter.sample(random.next());
			const float y = float(p_y) + 0.5f + r_film.filter.sample(random.next());
			PathLayers layers;
			Vector3 radiance = r_integrator.trace(x, y, random, r_film.layers.empty() ? nullptr : &layers);
			if (!is_finite(radiance) || !is_finite(layers.direct)) {
				radiance = layers.direct = layers.emission = layers.background = Vector3(0.0f);
				r_film.bad_samples++;
			}
			const glm::dvec3 value(radiance);
			pixel.sum += value;
			pixel.square += value * value;
			pixel.count++;
			if (!r_film.layers.empty()) {
				r_film.layers[index].add(layers);
			}
		}
	}

	// Adds p_samples to every pixel; tiles are dealt to whoever is free. p_stop is asked before each tile, by any thread; false: it stopped the pass.
	template <typename F>
	bool trace_pass(Film &r_film, uint32_t p_samples, const F &p_stop) const {
		const PathTracerSettings &settings = r_film.settings;
		const uint32_t tiles_x = (settings.width + TILE_PIXELS - 1) / TILE_PIXELS;
		const uint32_t tiles_y = (settings.height + TILE_PIXELS - 1) / TILE_PIXELS;
		std::atomic<uint32_t> next_tile{ 0 };
		std::atomic<bool> stopped{ false };
		run_threads(thread_count(settings), [&](uint32_t p_thread) {
			PathIntegrator integrator(world, r_film.camera_rays);
			for (uint32_t tile = next_tile++; tile < tiles_x * tiles_y; tile = next_tile++) {
				if (p_stop()) {
					stopped = true;
					break;
				}
				if (!r_film.recordings.empty()) {
					std::vector<Ray> &recording = r_film.recordings[p_thread];
					integrator.recording = recording.size() < r_film.recording_limit ? &recording : nullptr;
				}
				const uint32_t x0 = tile % tiles_x * TILE_PIXELS;
				const uint32_t y0 = tile / tiles_x * TILE_PIXELS;
				for (uint32_t y = y0; y < std::min(y0 + TILE_PIXELS, settings.height); y++) {
					for (uint32_t x = x0; x < std::min(x0 + TILE_PIXELS, settings.width); x++) {
						trace_pixel(r_film, integrator, x, y, p_samples);
					}
				}
			}
			r_film.rays += integrator.ray_count;
		});
		return !stopped;
	}

	PathTracerResult develop(const Film &p_film) const {
		PathTracerResult result;
		result.width = p_film.settings.width;
		result.height = p_film.settings.height;
		result.rays = p_film.rays;
		result.bad_samples = p_film.bad_samples;
		result.spp = MAX_SPP;
		for (const PixelSums &pixel : p_film.pixels) {
			const double n = std::max(1u, pixel.count);
			const glm::dvec3 mean = pixel.sum / n;
			put(result.radiance, world.lights.has_negative_lamps() ? glm::max(mean, glm::dvec3(0.0)) : mean);
			put(result.variance, glm::max(pixel.square / n - mean * mean, glm::dvec3(0.0)) / std::max(n - 1.0, 1.0));
			result.spp = std::min(result.spp, pixel.count);
			result.untraced_pixels += pixel.count == 0;
		}
		for (size_t i = 0; i < p_film.layers.size(); i++) {
			const LayerSums &layer = p_film.layers[i];
			const double n = std::max(1u, p_film.pixels[i].count);
			const double surfaces = std::max(1u, layer.surface_count);
			put(result.direct, layer.direct / n);
			put(result.emission, layer.emission / n);
			put(result.background, layer.background / n);
			put(result.indirect, (p_film.pixels[i].sum - layer.direct - layer.emission - layer.background) / n);
			put(result.albedo, layer.albedo / surfaces);
			const double length = glm::length(layer.normal);
			put(result.normal, length > 0.0 ? layer.normal / length : glm::dvec3(0.0));
			result.depth.push_back(float(layer.depth_m / surfaces));
		}
		return result;
	}
};

PathTracer::PathTracer(std::unique_ptr<Impl> p_impl) :
		impl(std::move(p_impl)) {}
PathTracer::~PathTracer() = default;

Result<std::unique_ptr<PathTracer>> PathTracer::create(const RenderScene &p_scene, ScenarioRid p_scenario, CameraRid p_camera) {
	const Camera *camera = p_scene.cameras.get(p_camera);
	if (!camera || !p_scene.scenarios.get(p_scenario)) {
		return make_error("path tracer: the {} does not exist", camera ? "scenario" : "camera");
	}
	auto impl = std::make_unique<Impl>();
	// Where the raster frame of this camera has its origin, so that both see the same coordinates.
	RenderOrigin origin;
	const Environment *environment = p_scene.find_environment(*p_scene.scenarios.get(p_scenario), *camera);
	origin.follow(camera->transform.origin, environment ? environment->sdfgi : SdfgiSettings());
	Result<std::unique_ptr<TraceScene>> scene = TraceScene::create(p_scene, p_scenario, *camera, origin);
	if (!scene) {
		return scene.error();
	}
	impl->world.camera = *camera;
	impl->world.camera.transform = origin.render_from_world(camera->transform);
	impl->world.scene = scene.take();
	impl->world.lights = LightSampler(p_scene, p_scenario, origin, *impl->world.scene);
	impl->world.sky = TraceSky(p_scene, p_scenario, *camera);
	return std::unique_ptr<PathTracer>(new PathTracer(std::move(impl)));
}

Result<PathTracerResult> PathTracer::render(const PathTracerSettings &p_settings, const std::function<void(const PathTracerProgress &)> &p_progress) {
	if (const Status status = check_settings(p_settings); !status) {
		return status.error();
	}
	const auto start = std::chrono::steady_clock::now();
	const std::unique_ptr<Impl::Film> film = impl->make_film(p_settings);
	uint32_t done = 0;
	uint32_t pass = 1;
	while (done < p_settings.spp && !film->cancelled()) {
		pass = std::min(pass, p_settings.spp - done);
		const auto stop = [&] { return film->cancelled() || (done > 0 && p_settings.time_limit_s > 0 && seconds_since(start) >= p_settings.time_limit_s); };
		if (!impl->trace_pass(*film, pass, stop)) {
			break;
		}
		done += pass;
		// Passes of about half a second: often enough to report, rarely enough to cost nothing.
		const double elapsed = seconds_since(start);
		const double per_sample = elapsed / done;
		double remaining = per_sample * (p_settings.spp - done);
		double budget = 0.5;
		if (p_settings.time_limit_s > 0) {
			budget = std::min(budget, p_settings.time_limit_s - elapsed);
			remaining = std::min(remaining, p_settings.time_limit_s - elapsed);
		}
		if (p_progress) {
			p_progress({ done, p_settings.spp, elapsed, std::max(remaining, 0.0) });
		}
		if (budget <= 0) {
			break;
		}
		pass = uint32_t(std::clamp(budget / per_sample, 1.0, 256.0));
	}
	PathTracerResult result = impl->develop(*film);
	result.seconds = seconds_since(start);
	return result;
}

Result<PathTracerThroughput> PathTracer::measure_throughput(const PathTracerSettings &p_settings) {
	constexpr size_t MAX_RECORDED = 4'000'000;
	// The process's CPU time, all threads together: other work on the machine doesn't count.
	const auto never = [] { return false; };
	const auto cpu_seconds = [] { return double(std::clock()) / CLOCKS_PER_SEC; };
	if (const Status status = check_settings(p_settings); !status) {
		return status.error();
	}
	const uint32_t threads = thread_count(p_settings);
	PathTracerThroughput result;
	std::unique_ptr<Impl::Film> film = impl->make_film(p_settings);
	film->recordings.resize(threads);
	film->recording_limit = MAX_RECORDED / threads;
	uint32_t samples = 0;
	while (samples < p_settings.spp && result.recorded_rays < MAX_RECORDED) {
		impl->trace_pass(*film, 1, never);
		samples++;
		result.recorded_rays = 0;
		for (const std::vector<Ray> &recording : film->recordings) {
			result.recorded_rays += recording.size();
		}
	}
	// The same samples again, in turn with their bare rays, so that both see the same machine; for as long as a steady figure needs.
	uint64_t traced = 0, replayed = 0;
	double trace_seconds = 0, replay_seconds = 0;
	for (uint32_t done = 0; done < p_settings.spp || trace_seconds < 1.0 || replay_seconds < 1.0; done += samples) {
		const double start = cpu_seconds();
		const std::unique_ptr<Impl::Film> again = impl->make_film(p_settings);
		impl->trace_pass(*again, samples, never);
		const double middle = cpu_seconds();
		run_threads(threads, [&](uint32_t p_thread) { impl->world.scene->count_hits(film->recordings[p_thread]); });
		trace_seconds += middle - start;
		replay_seconds += cpu_seconds() - middle;
		traced += again->rays;
		replayed += result.recorded_rays;
	}
	result.path_tracer_mrays_s = double(traced) * threads / trace_seconds * 1e-6;
	result.bare_mrays_s = double(replayed) * threads / replay_seconds * 1e-6;
	return result;
}

} // namespace lucent
