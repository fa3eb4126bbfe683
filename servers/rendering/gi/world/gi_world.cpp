// SPDX-License-Identifier: MIT
#include "servers/rendering/gi/world/gi_world.h"

namespace lucent {

namespace {

// Bindings that the build passes' shaders declare for themselves.
constexpr uint32_t OUT_0 = 20;
constexpr uint32_t OUT_1 = 21;
constexpr uint32_t OUT_2 = 22;
constexpr uint32_t OUT_3 = 23;
constexpr uint32_t VOXEL_SURFACES = 10;
constexpr uint32_t VOXEL_POSITIONS = 11;
constexpr uint32_t VOXEL_INDICES = 12;
constexpr uint32_t VOXEL_INSTANCES = 13;
constexpr uint32_t VOXEL_MATERIALS = 14;
constexpr uint32_t VOXEL_ATTRIBUTES = 15;
constexpr uint32_t VOXEL_TEXTURES = 16;
constexpr uint32_t VOXEL_SAMPLER = 17;
constexpr uint32_t VOXEL_STRETCHES = 18;

constexpr uint32_t STRETCH_CAPACITY = 131072; // 512 triangles that fill a cascade of 128 cells an axis

// 128 MiB of triangles; cells that others touch keep to their solid bits.
constexpr uint32_t STORED_TRIANGLES = (128u << 20) / WORLD_TRIANGLE_BYTES;

constexpr uint32_t EMITTER_CAPACITY = 16384;
constexpr uint32_t STATE_BYTES = 2 * 12; // record_rays_inc.glsl: two vec3 a record
constexpr uint32_t LIGHT_BYTES = 16;

void bind_materials(ComputePass &r_pass, const GiSceneView &p_scene) {
	r_pass.read(VOXEL_MATERIALS, p_scene.materials).read(VOXEL_ATTRIBUTES, p_scene.attributes).read(VOXEL_TEXTURES, p_scene.gi_textures).sampler(VOXEL_SAMPLER, p_scene.gi_sampler);
}

} // namespace

GiWorld::GiWorld(RenderingDevice &p_device, const GiWorldDesc &p_desc) :
		device(p_device), world_desc(p_desc) {
	const uint32_t bricks_axis = p_desc.grid_size / WORLD_BRICK_CELLS;
	const uint32_t bricks = bricks_axis * bricks_axis * bricks_axis;
	const uint32_t cell_count = p_desc.grid_size * p_desc.grid_size * p_desc.grid_size;
	params.cascade_count = p_desc.cascades;
	params.grid_size = p_desc.grid_size;
	// An eighth of the grid: a room's walls take a tenth at most; doc/sdfgi.md, "Capacity".
	params.cell_capacity = cell_count / 8;
	params.record_capacity = cell_count / 6;
	params.triangle_capacity = cell_count / 2;
	params.sky_scale = 1.0f;
	params.hole_margin_cells = 8;
	for (uint32_t i = 0; i < p_desc.cascades; i++) {
		shader::GiCascade &cascade = params.cascades[i];
		const float size = p_desc.min_cell_m * float(1u << i);
		cascade.cell_m = Vector3(size, size / p_desc.y_multiplier, size);
	}
	const uint64_t n = p_desc.cascades;
	params_buffer = make_buffer("gi_world.params", sizeof(shader::GiWorldParams), BUFFER_UNIFORM);
	occupancy = make_buffer("gi_world.occupancy", n * bricks * 8);
	brick_cell_base = make_buffer("gi_world.brick_cell_base", n * bricks * 4);
	sdf = make_buffer("gi_world.sdf", n * cell_count);
	cells = make_buffer("gi_world.cells", n * params.cell_capacity * sizeof(shader::WorldCell));
	cell_triangles = make_buffer("gi_world.cell_triangles", n * params.triangle_capacity * 4);
	records = make_buffer("gi_world.records", n * params.record_capacity * sizeof(shader::WorldRecord));
	record_light[0] = make_buffer("gi_world.record_light0", n * params.record_capacity * LIGHT_BYTES);
	record_light[1] = make_buffer("gi_world.record_light1", n * params.record_capacity * LIGHT_BYTES);
	record_state = make_buffer("gi_world.record_state", n * params.record_capacity * STATE_BYTES);
	counts = make_buffer("gi_world.counts", WORLD_MAX_CASCADES * sizeof(shader::CascadeCounts), BUFFER_STORAGE | BUFFER_INDIRECT);
	emitters = make_buffer("gi_world.emitters", EMITTER_CAPACITY * sizeof(shader::Emitter));
	emitter_count = make_buffer("gi_world.emitter_count", 8);
	accumulators = make_buffer("gi_world.accumulators", uint64_t(params.record_capacity) * sizeof(shader::RecordAccumulator));
	column_stretches = make_buffer("gi_world.column_stretches", 4 + STRETCH_CAPACITY * sizeof(shader::ColumnStretch));
	distance_scratch[0] = make_buffer("gi_world.distance_scratch0", uint64_t(cell_count) * 4);
	distance_scratch[1] = make_buffer("gi_world.distance_scratch1", uint64_t(cell_count) * 4);
	near_bricks[0] = make_buffer("gi_world.near_bricks0", uint64_t(bricks) * 4);
	near_bricks[1] = make_buffer("gi_world.near_bricks1", uint64_t(bricks) * 4);
	near_list = make_buffer("gi_world.near_list", sizeof(shader::NearBrickHeader) + uint64_t(bricks) * 4, BUFFER_STORAGE | BUFFER_INDIRECT);
	world_triangles = device.create_buffer({ .size_bytes = WORLD_TRIANGLE_BYTES, .name = "gi_world.triangles" });
	surfaces.resize(p_desc.cascades);
	sky_sampler = device.sampler({ .mip_filter = Filter::NEAREST, .address_u = AddressMode::CLAMP_TO_EDGE, .address_v = AddressMode::CLAMP_TO_EDGE });
}

OwnedBuffer GiWorld::make_buffer(const char *p_name, uint64_t p_size_bytes, uint32_t p_usage) {
	bytes += p_size_bytes;
	return device.create_buffer({ .size_bytes = p_size_bytes, .usage = p_usage, .name = p_name });
}

Vector3 GiWorld::cell_m(uint32_t p_cascade) const {
	return params.cascades[p_cascade].cell_m;
}

void GiWorld::upload_params(PassRecorder &r_recorder) {
	r_recorder.update_buffer(params_buffer, 0, std::as_bytes(std::span(&params, 1)));
}

void GiWorld::clear_words(PassRecorder &r_recorder, const char *p_name, BufferHandle p_buffer, uint32_t p_first, uint32_t p_count, uint32_t p_value) {
	const shader::ClearWordsConstants constants = { .first = p_first, .count = p_count, .value = p_value };
	r_recorder.compute(p_name, Shader::CLEAR_WORDS).write(0, p_buffer).constants(constants).dispatch_groups(std::min(4096u, (p_count + 63) / 64));
}

// Surfaces whose box meets the cascade, with a running triangle count of their own. Returns their number.
uint32_t GiWorld::cull_surfaces(const GiSceneView &p_scene, uint32_t p_cascade, uint32_t &r_triangles) {
	const shader::GiCascade &cascade = params.cascades[p_cascade];
	const Vector3 low = Vector3(cascade.origin_cells) * cascade.cell_m;
	const AABB box = { low, low + float(world_desc.grid_size) * cascade.cell_m };
	std::vector<shader::GiSurface> list;
	r_triangles = 0;
	for (size_t i = 0; i < p_scene.gi_surfaces.size(); i++) {
		if (!p_scene.gi_surface_boxes[i].intersects(box)) {
			continue;
		}
		shader::GiSurface surface = p_scene.gi_surfaces[i];
		const uint32_t end = i + 1 < p_scene.gi_surfaces.size() ? p_scene.gi_surfaces[i + 1].first_triangle : p_scene.gi_triangle_count;
		const uint32_t triangles = end - surface.first_triangle;
		surface.first_triangle = r_triangles;
		r_triangles += triangles;
		list.push_back(surface);
	}
	if (!list.empty()) {
		surfaces[p_cascade] = device.create_buffer({ .size_bytes = list.size() * sizeof(shader::GiSurface), .name = "gi_world.surfaces" });
		device.upload_buffer(surfaces[p_cascade], list);
	}
	return uint32_t(list.size());
}

// What every pass over triangles reads.
ComputePass GiWorld::geometry_pass(PassRecorder &r_recorder, const char *p_name, Shader p_shader, const GiSceneView &p_scene, BufferHandle p_surfaces, const shader::VoxelizeConstants &p_constants) {
	ComputePass pass = r_recorder.compute(p_name, p_shader);
	pass.uniform(WORLD_PARAMS, params_buffer).read(VOXEL_SURFACES, p_surfaces).read(VOXEL_POSITIONS, p_scene.positions);
	pass.read(VOXEL_INDICES, p_scene.indices).read(VOXEL_INSTANCES, p_scene.instances).constants(p_constants);
	return pass;
}

void GiWorld::store_triangles(PassRecorder &r_recorder, const GiSceneView &p_scene) {
	const uint64_t room = device.info().max_storage_buffer_bytes / WORLD_TRIANGLE_BYTES;
	stored_triangles = uint32_t(std::min<uint64_t>({ p_scene.gi_triangle_count, room, STORED_TRIANGLES }));
	const uint64_t size_bytes = std::max(stored_triangles, 1u) * WORLD_TRIANGLE_BYTES;
	if (size_bytes > world_triangle_bytes) {
		world_triangles = device.create_buffer({ .size_bytes = size_bytes, .name = "gi_world.triangles" });
		world_triangle_bytes = size_bytes;
	}
	if (stored_triangles == 0) {
		return;
	}
	all_surfaces = device.create_buffer({ .size_bytes = p_scene.gi_surfaces.size() * sizeof(shader::GiSurface), .name = "gi_world.all_surfaces" });
	device.upload_buffer(all_surfaces, p_scene.gi_surfaces);
	const shader::VoxelizeConstants constants = { .cascade = 0, .surface_count = uint32_t(p_scene.gi_surfaces.size()), .triangle_count = p_scene.gi_triangle_count, .stored_triangles = stored_triangles };
	ComputePass pass = geometry_pass(r_recorder, "gi_world.store_triangles", Shader::STORE_TRIANGLES, p_scene, all_surfaces, constants);
	bind_materials(pass, p_scene);
	pass.write(OUT_0, world_triangles);
	const uint32_t groups = (stored_triangles + 63) / 64;
	pass.dispatch_groups(std::min(groups, 32768u), (groups + 32767) / 32768);
}

void GiWorld::rebuild_cascade(PassRecorder &r_recorder, const GiSceneView &p_scene, uint32_t p_cascade) {
	const uint32_t bricks_axis = world_desc.grid_size / WORLD_BRICK_CELLS;
	const uint32_t bricks = bricks_axis * bricks_axis * bricks_axis;
	shader::VoxelizeConstants constants = { .cascade = p_cascade, .surface_count = 0, .triangle_count = 0, .stored_triangles = stored_triangles };
	constants.surface_count = cull_surfaces(p_scene, p_cascade, constants.triangle_count);
	clear_words(r_recorder, "gi_world.clear_occupancy", occupancy, p_cascade * bricks * 2, bricks * 2);
	clear_words(r_recorder, "gi_world.clear_cells", cells, p_cascade * params.cell_capacity * 4, params.cell_capacity * 4);
	clear_words(r_recorder, "gi_world.clear_accumulators", accumulators, 0, params.record_capacity * sizeof(shader::RecordAccumulator) / 4);

	clear_words(r_recorder, "gi_world.clear_column_stretches", column_stretches, 0, 1);

	// 32768 groups of 64 triangles or stretches a row.
	const uint32_t triangle_groups = (constants.triangle_count + 63) / 64;
	const uint32_t groups = triangle_groups > 0 ? triangle_groups + STRETCH_CAPACITY / 64 : 0;
	const auto dispatch = [](ComputePass p_pass, uint32_t p_groups) { p_pass.dispatch_groups(std::min(p_groups, 32768u), (p_groups + 32767) / 32768); };
	const auto voxelize = [&](const char *p_name, Shader p_shader) {
		ComputePass pass = geometry_pass(r_recorder, p_name, p_shader, p_scene, surfaces[p_cascade], constants);
		bind_materials(pass, p_scene);
		pass.read(VOXEL_STRETCHES, column_stretches).read(WORLD_OCCUPANCY, occupancy).read(WORLD_BRICK_CELL_BASE, brick_cell_base);
		return pass;
	};
	if (groups > 0) {
		dispatch(geometry_pass(r_recorder, "gi_world.list_columns", Shader::LIST_COLUMNS, p_scene, surfaces[p_cascade], constants).read_write(VOXEL_STRETCHES, column_stretches), triangle_groups);
		dispatch(geometry_pass(r_recorder, "gi_world.mark_cells", Shader::MARK_CELLS, p_scene, surfaces[p_cascade], constants).read(VOXEL_STRETCHES, column_stretches).read_write(WORLD_OCCUPANCY, occupancy), groups);
	}
	r_recorder.compute("gi_world.allocate_cells", Shader::ALLOCATE_CELLS).uniform(WORLD_PARAMS, params_buffer).read(WORLD_OCCUPANCY, occupancy).write(OUT_0, brick_cell_base).read_write(OUT_1, counts).constants(constants).dispatch_groups(1);
	if (groups > 0) {
		dispatch(voxelize("gi_world.voxelize_cells", Shader::VOXELIZE_CELLS).read_write(OUT_0, cells), groups);
	}
	r_recorder.compute("gi_world.allocate_records", Shader::ALLOCATE_RECORDS).uniform(WORLD_PARAMS, params_buffer).read(WORLD_OCCUPANCY, occupancy).read(WORLD_BRICK_CELL_BASE, brick_cell_base).read_write(OUT_0, counts).read_write(OUT_1, cells).read_write(OUT_2, records).constants(constants).dispatch_groups(1);
	if (groups > 0) {
		ComputePass list = geometry_pass(r_recorder, "gi_world.list_triangles", Shader::LIST_TRIANGLES, p_scene, surfaces[p_cascade], constants);
		list.read(VOXEL_STRETCHES, column_stretches).read(WORLD_OCCUPANCY, occupancy).read(WORLD_BRICK_CELL_BASE, brick_cell_base);
		dispatch(list.read_write(OUT_0, cells).read_write(OUT_1, cell_triangles), groups);
		dispatch(voxelize("gi_world.accumulate_records", Shader::ACCUMULATE_RECORDS).read(WORLD_CELLS, cells).read_write(OUT_0, accumulators), groups);
	}
	build_sdf(r_recorder, p_cascade);
	ComputePass resolve = r_recorder.compute("gi_world.resolve_records", Shader::RESOLVE_RECORDS);
	bind_trace(resolve);
	resolve.read(OUT_0, accumulators).read(OUT_1, counts).read_write(OUT_2, records).write(OUT_3, record_light[current_light]).constants(constants).dispatch_groups(1024);
	if (groups > 0) {
		dispatch(voxelize("gi_world.mark_flat_cells", Shader::MARK_FLAT_CELLS).read_write(WORLD_RECORDS, records).read_write(OUT_0, cells), groups);
	}
}

// Rays may pass several cascades, so all must be built.
void GiWorld::place_record_starts(PassRecorder &r_recorder, uint32_t p_cascade) {
	const shader::VoxelizeConstants constants = { .cascade = p_cascade, .surface_count = 0, .triangle_count = 0, .stored_triangles = 0 };
	ComputePass place = r_recorder.compute("gi_world.place_record_starts", Shader::PLACE_RECORD_STARTS);
	bind_trace(place);
	place.read(WORLD_RECORDS, records).read(OUT_0, counts).write(OUT_1, accumulators).constants(constants).dispatch_groups(1024);
	r_recorder.compute("gi_world.move_records", Shader::MOVE_RECORDS).uniform(WORLD_PARAMS, params_buffer).read(OUT_0, counts).read(OUT_1, accumulators).read_write(OUT_2, records).constants(constants).dispatch_groups(1024);
}

void GiWorld::build_sdf(PassRecorder &r_recorder, uint32_t p_cascade) {
	const uint32_t n = world_desc.grid_size;
	const uint32_t bricks = n / WORLD_BRICK_CELLS;
	clear_words(r_recorder, "gi_world.clear_near_list", near_list, 0, sizeof(shader::NearBrickHeader) / 4);
	clear_words(r_recorder, "gi_world.clear_sdf", sdf, p_cascade * (n * n * n / 4), n * n * n / 4, 0xFFFFFFFFu);
	for (const OwnedBuffer &scratch : distance_scratch) {
		clear_words(r_recorder, "gi_world.clear_distances", scratch, 0, n * n * n, WORLD_SDF_FAR_SQUARED);
	}
	for (uint32_t axis = 0; axis < 3; axis++) {
		const shader::BuildSdfConstants constants = { .cascade = p_cascade, .axis = axis };
		r_recorder.compute("gi_world.mark_near_bricks", Shader::MARK_NEAR_BRICKS).uniform(WORLD_PARAMS, params_buffer).read(WORLD_OCCUPANCY, occupancy).read(OUT_0, near_bricks[(axis & 1) ^ 1]).write(OUT_1, near_bricks[axis & 1]).read_write(OUT_2, near_list).constants(constants).dispatch_threads(bricks, bricks, bricks);
	}
	for (uint32_t axis = 0; axis < 3; axis++) {
		const shader::BuildSdfConstants constants = { .cascade = p_cascade, .axis = axis };
		r_recorder.compute("gi_world.build_sdf", Shader::BUILD_SDF).uniform(WORLD_PARAMS, params_buffer).read(WORLD_OCCUPANCY, occupancy).read(OUT_0, distance_scratch[(axis & 1) ^ 1]).write(OUT_1, distance_scratch[axis & 1]).write(OUT_2, sdf).read(OUT_3, near_list).constants(constants).dispatch_indirect(near_list);
	}
}

void GiWorld::collect_emitters(PassRecorder &r_recorder) {
	r_recorder.compute("gi_world.collect_emitters", Shader::COLLECT_EMITTERS)
			.uniform(WORLD_PARAMS, params_buffer)
			.read(WORLD_RECORDS, records)
			.read(OUT_0, counts)
			.read_write(OUT_1, emitters)
			.write(OUT_2, emitter_count)
			.dispatch_groups(1);
}

} // namespace lucent
