// SPDX-License-Identifier: MIT
#include "servers/rendering/gi/sdfgi/sdfgi_cascades.h"
#include "servers/rendering/gi/sdfgi/sdfgi_impl.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr uint32_t PROBE_TILES_A_ROW = 256;
constexpr uint32_t PROBE_AVERAGE_VISITS = 8;
struct DebugView {
	const char *name;
	uint32_t number; // DEBUG_VIEW_* in debug_gi.comp.glsl
};
constexpr DebugView DEBUG_VIEWS[] = { { "sdf", 0 }, { "albedo", 1 }, { "light", 2 }, { "emission", 3 }, { "normals", 4 }, { "cascade", 5 }, { "probes", 6 }, { "occlusion", 7 }, { "radiance", 8 } };

} // namespace

Sdfgi::Sdfgi(RenderingDevice &p_device) :
		impl(std::make_unique<Impl>(p_device)) {
}

Sdfgi::~Sdfgi() = default;

void Sdfgi::Impl::create(const SdfgiSettings &p_settings) {
	settings = p_settings;
	world.reset();
	world = std::make_unique<GiWorld>(device, GiWorldDesc{ .cascades = settings.cascades, .grid_size = settings.grid_size_cells, .min_cell_m = settings.min_cell_size_m, .y_multiplier = sdfgi_y_multiplier(settings.y_scale), .least_room = least_room });
	needs_room = false;
	probes_axis = settings.grid_size_cells / settings.probe_spacing_cells + 1;
	const uint32_t probes = probes_in_cascade() * settings.cascades;
	const uint32_t rows = (probes + PROBE_TILES_A_ROW - 1) / PROBE_TILES_A_ROW;
	probe_params = device.create_buffer({ .size_bytes = sizeof(shader::ProbeParams), .usage = BUFFER_UNIFORM, .name = "sdfgi.probe_params" });
	probe_places = device.create_buffer({ .size_bytes = uint64_t(probes) * sizeof(shader::ProbePlace), .name = "sdfgi.probe_places" });
	probe_list = device.create_buffer({ .size_bytes = uint64_t(settings.cascades) * (PROBE_LIST_HEADER_WORDS + probes_in_cascade()) * 4, .usage = BUFFER_STORAGE | BUFFER_INDIRECT, .name = "sdfgi.probe_list" });
	statistics = device.create_buffer({ .size_bytes = sizeof(shader::SdfgiStatistics), .name = "sdfgi.statistics" });
	fetch_counts = device.create_buffer({ .size_bytes = FETCHES_PASSES * sizeof(shader::FetchCounts), .name = "sdfgi.fetch_counts" });
	ray_cache_words = uint32_t(std::min({ uint64_t(std::max(settings.ray_cache_mib, 1u)) << 18, uint64_t(settings.cascades) * world->record_capacity() * 8 * turns(), device.info().max_storage_buffer_bytes / 4 }));
	ray_cache = device.create_buffer({ .size_bytes = uint64_t(ray_cache_words) * 4, .name = "sdfgi.ray_cache" });
	const uint32_t radiance_tile = settings.probe_radiance_texels + PROBE_BORDER_TEXELS;
	const uint32_t irradiance_tile = settings.probe_irradiance_texels + PROBE_BORDER_TEXELS;
	const auto atlas = [&](const char *p_name, uint32_t p_tile) {
		return device.create_texture({ .format = Format::RGBA16_FLOAT, .width = PROBE_TILES_A_ROW * p_tile, .height = rows * p_tile, .usage = TEXTURE_SAMPLED | TEXTURE_STORAGE, .name = p_name });
	};
	radiance_atlas = atlas("sdfgi.probe_radiance", radiance_tile);
	irradiance_atlas = atlas("sdfgi.probe_irradiance", irradiance_tile);
	probe_sampler = device.sampler({ .mip_filter = Filter::NEAREST, .address_u = AddressMode::CLAMP_TO_EDGE, .address_v = AddressMode::CLAMP_TO_EDGE });
	cascades_placed = false;
	stats = {};
	stats.probes = probes;
	stats.bytes = world->size_bytes() + uint64_t(ray_cache_words) * 4 + uint64_t(ray_pixel_capacity) * 4 + uint64_t(probes) * sizeof(shader::ProbePlace) + uint64_t(PROBE_TILES_A_ROW) * rows * 8 * (radiance_tile * radiance_tile + irradiance_tile * irradiance_tile);
}

SdfgiPassInputs Sdfgi::Impl::pass_inputs() const {
	return { .world = *world, .probe_params = probe_params, .probe_places = probe_places, .probe_list = probe_list, .radiance_atlas = radiance_atlas, .irradiance_atlas = irradiance_atlas, .probe_sampler = probe_sampler, .sky = sky, .lights = lights, .statistics = statistics, .ray_cache = ray_cache, .probes_in_cascade = probes_in_cascade(), .fetch_counts = fetch_counts, .counts_fetches = settings.count_fetches, .probe_rays = probe_rays(), .probe_radiance_texels = settings.probe_radiance_texels, .probe_irradiance_texels = settings.probe_irradiance_texels };
}

// Lists the cascades that must be built anew. True: some moved.
bool Sdfgi::Impl::place_cascades(const Vector3 &p_camera_m, std::vector<uint32_t> &r_moved) {
	for (uint32_t i = 0; i < settings.cascades; i++) {
		const Vector3i old_origin = world->origin_cells(i);
		const Vector3i origin = cascade_origin_cells(p_camera_m, world->cell_m(i), settings.grid_size_cells, settings.probe_spacing_cells, cascades_placed ? &old_origin : nullptr);
		if (!cascades_placed || origin != old_origin) {
			world->set_origin_cells(i, origin);
			r_moved.push_back(i);
		}
	}
	cascades_placed = true;
	return !r_moved.empty();
}

void Sdfgi::Impl::upload_probe_params(PassRecorder &r_recorder, const Vector3 &p_camera_m) {
	const shader::ProbeParams params = {
		.probes = probes_axis,
		.spacing_cells = settings.probe_spacing_cells,
		.rays = probe_rays(),
		.radiance_texels = settings.probe_radiance_texels,
		.irradiance_texels = settings.probe_irradiance_texels,
		.frame = frame < PROBE_RESTART_FRAMES ? frame : frame - PROBE_RESTART_FRAMES,
		.running_frame = running_frame,
		.normal_bias = settings.normal_bias,
		.probe_bias = settings.probe_bias,
		.energy = settings.energy,
		.use_occlusion = settings.use_occlusion ? 1u : 0u,
		.camera_m = p_camera_m,
		.average_frames = PROBE_AVERAGE_VISITS,
	};
	r_recorder.update_buffer(probe_params, 0, std::as_bytes(std::span(&params, 1)));
}

// The light has to settle anew. Rays between surfaces stay what they are unless the geometry has changed.
void Sdfgi::Impl::restart(bool p_geometry) {
	frame = 0;
	lamp_turns_done = 0;
	turns_done = p_geometry ? 0 : turns_done;
	light_settled = converged = stats.converged = false;
	picture_counted = false;
	peak_rays = 0;
	stats.frames = 0;
}

void Sdfgi::Impl::light_frame(PassRecorder &r_recorder) {
	r_recorder.clear_buffer(statistics);
	const SdfgiPassInputs inputs = pass_inputs();
	const uint32_t turns = this->turns();
	const bool traces = turns_done < turns;
	const bool lights_lamps = light_count > 0 && lamp_turns_done < lamp_turns();
	const auto rays = [&](uint32_t p_cascade, uint32_t p_turn) { return shader::RecordRaysConstants{ .cascade = p_cascade, .turn = p_turn, .turns = turns, .cache_capacity = ray_cache_words, .light_count = light_count }; };
	for (uint32_t i = 0; i < settings.cascades && traces; i++) {
		trace_records(r_recorder, inputs, rays(i, turns_done));
	}
	for (uint32_t i = 0; i < settings.cascades && lights_lamps; i++) {
		light_lamps(r_recorder, inputs, rays(i, lamp_turns_done));
	}
	turns_done += traces ? 1 : 0;
	lamp_turns_done += lights_lamps ? 1 : 0;
	for (uint32_t i = 0; i < settings.cascades && !light_settled; i++) {
		light_records(r_recorder, inputs, { .cascade = i, .turns = turns, .turns_done = turns_done, .lamp_turns_done = lamp_turns_done, .cache_capacity = ray_cache_words, .feedback = settings.bounce_feedback });
	}
	if (!light_settled) {
		world->swap_light();
	}
	const SdfgiPassInputs lit = pass_inputs();
	for (uint32_t i = 0; i < settings.cascades; i++) {
		for (const bool far : { false, true }) {
			trace_probes(r_recorder, lit, i, far);
			filter_probes(r_recorder, lit, i, far);
		}
	}
	frame++;
	running_frame++;
	may_settle = !traces && !lights_lamps;
	const bool all_lamps_done = lights_lamps && lamp_turns_done == lamp_turns();
	// The frames that trace last tell how many rays there are.
	checks_light = settings.count_every_frame || (traces && turns_done == turns) || all_lamps_done || (may_settle && frame % CHECK_PERIOD_FRAMES == 0);
	stats.frames++;
}

void Sdfgi::update(PassRecorder &r_recorder, const SdfgiSettings &p_settings, const GiSceneView &p_scene, const Vector3 &p_camera_position_m) {
	Impl &i = *impl;
	SdfgiSettings live = i.settings;
	live.energy = p_settings.energy;
	live.bounce_feedback = p_settings.bounce_feedback;
	live.read_sky_light = p_settings.read_sky_light;
	live.normal_bias = p_settings.normal_bias;
	live.probe_bias = p_settings.probe_bias;
	live.use_occlusion = p_settings.use_occlusion;
	live.count_every_frame = p_settings.count_every_frame;
	live.count_fetches = p_settings.count_fetches;
	const bool relight = live.bounce_feedback != i.settings.bounce_feedback || live.read_sky_light != i.settings.read_sky_light;
	if (live.grid_size_cells != p_settings.grid_size_cells) {
		i.least_room = {};
	}
	if (i.world == nullptr || live != p_settings || i.needs_room) {
		i.create(p_settings);
		r_recorder.clear_texture(i.radiance_atlas);
		r_recorder.clear_texture(i.irradiance_atlas);
	}
	i.settings = p_settings;
	i.sky = p_scene.sky_octahedral;
	i.lights = p_scene.lights;
	i.light_count = p_scene.light_count;
	i.world->set_sky_scale(p_settings.read_sky_light ? 1.0f : 0.0f);

	std::vector<uint32_t> stale;
	const bool triangles_changed = !i.cascades_placed || p_scene.geometry_version != i.geometry_version;
	i.place_cascades(p_camera_position_m, stale);
	if (p_scene.geometry_version != i.geometry_version) {
		stale.clear();
		for (uint32_t c = 0; c < p_settings.cascades; c++) {
			stale.push_back(c);
		}
	}
	if (!stale.empty() || p_scene.light_version != i.light_version || relight) {
		i.restart(!stale.empty());
	}
	i.geometry_version = p_scene.geometry_version;
	i.light_version = p_scene.light_version;

	if (p_settings.count_fetches) {
		r_recorder.clear_buffer(i.fetch_counts);
	}
	i.world->upload_params(r_recorder);
	i.upload_probe_params(r_recorder, p_camera_position_m);
	if (triangles_changed) {
		const uint64_t before = i.world->size_bytes();
		i.world->store_triangles(r_recorder, p_scene);
		i.stats.bytes += i.world->size_bytes() - before;
	}
	for (const uint32_t cascade : stale) {
		i.world->rebuild_cascade(r_recorder, p_scene, cascade);
		place_probes(r_recorder, i.pass_inputs(), cascade);
	}
	for (const uint32_t cascade : stale) {
		i.world->place_record_starts(r_recorder, cascade);
	}
	if (!stale.empty()) {
		i.world->collect_emitters(r_recorder);
	}
	i.checks_room = triangles_changed;
	i.checks_light = false;
	i.stats.rays = i.converged || p_settings.count_every_frame ? 0 : i.peak_rays;
	if (!i.converged) {
		i.light_frame(r_recorder);
	}
}

void Sdfgi::gather(PassRecorder &r_recorder, const GiGatherInputs &p_inputs) {
	impl->gathered = true;
	const uint32_t pixels = p_inputs.width * p_inputs.height;
	if (impl->ray_pixel_capacity < pixels) {
		impl->ray_pixels = impl->device.create_buffer({ .size_bytes = sizeof(shader::GatherCounts) + uint64_t(pixels) * 4, .name = "sdfgi.ray_pixels" });
		impl->stats.bytes += uint64_t(pixels - impl->ray_pixel_capacity) * 4;
		impl->ray_pixel_capacity = pixels;
	}
	const shader::GatherConstants constants = { .world_from_clip = p_inputs.world_from_clip, .camera_m = p_inputs.camera_position_m, .width = p_inputs.width, .height = p_inputs.height, .view = 0 };
	const shader::ClearWordsConstants clear = { .first = 0, .count = sizeof(shader::GatherCounts) / 4, .value = 0 };
	r_recorder.compute("sdfgi.clear_ray_pixels", Shader::CLEAR_WORDS).write(0, impl->ray_pixels).constants(clear).dispatch_groups(1);
	const auto gather = [&](const char *p_name, Shader p_shader) {
		ComputePass pass = r_recorder.compute(p_name, p_shader);
		bind_gi_sampling(pass, impl->pass_inputs());
		bind_fetch_counts(pass, impl->pass_inputs());
		pass.read(GATHER_DEPTH, p_inputs.depth).read(GATHER_NORMAL_ROUGHNESS, p_inputs.normal_roughness).write(GATHER_IRRADIANCE, p_inputs.irradiance).write(GATHER_RADIANCE, p_inputs.radiance).read_write(GATHER_RAY_PIXELS, impl->ray_pixels).constants(constants);
		return pass;
	};
	gather("sdfgi.gather_gi", Shader::GATHER_GI).dispatch_threads(p_inputs.width, p_inputs.height);
	// Groups beyond the list's end return at once.
	const uint32_t groups = (pixels + 63) / 64;
	gather("sdfgi.gather_rays", Shader::GATHER_RAYS).dispatch_groups(std::min(groups, 32768u), (groups + 32767) / 32768);
}

void Sdfgi::bind_sampling(RenderPass &r_pass) const {
	bind_gi_sampling(r_pass, impl->pass_inputs(), GI_SAMPLE_BINDING_BASE);
}

std::vector<std::string> Sdfgi::debug_views() {
	std::vector<std::string> names;
	for (const DebugView &view : DEBUG_VIEWS) {
		names.push_back(view.name);
	}
	return names;
}

bool Sdfgi::draw_debug_view(PassRecorder &r_recorder, const std::string &p_view, const GiGatherInputs &p_inputs, TextureHandle p_target) {
	const DebugView *view = std::find_if(std::begin(DEBUG_VIEWS), std::end(DEBUG_VIEWS), [&](const DebugView &p_candidate) { return p_view == p_candidate.name; });
	if (view == std::end(DEBUG_VIEWS)) {
		return false;
	}
	const shader::GatherConstants constants = { .world_from_clip = p_inputs.world_from_clip, .camera_m = p_inputs.camera_position_m, .width = p_inputs.width, .height = p_inputs.height, .view = view->number };
	ComputePass pass = r_recorder.compute("sdfgi.debug_gi", Shader::DEBUG_GI);
	bind_gi_sampling(pass, impl->pass_inputs());
	pass.write(20, p_target).read(21, p_inputs.depth).constants(constants).dispatch_threads(p_inputs.width, p_inputs.height);
	return true;
}

GiStats Sdfgi::stats() const {
	return impl->stats;
}

} // namespace lucent
