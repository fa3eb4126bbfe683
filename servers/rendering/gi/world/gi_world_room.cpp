// SPDX-License-Identifier: MIT
// How much a world has memory for, and what a scene needs.
#include "servers/core/log.h"
#include "servers/rendering/gi/world/gi_world.h"

namespace lucent {

// An eighth of the grid: a room's walls take a tenth at most; doc/sdfgi.md, "Capacity".
GiWorldRoom GiWorld::usual_room() const {
	const uint32_t cell_count = world_desc.grid_size * world_desc.grid_size * world_desc.grid_size;
	return { .cells = cell_count / 8, .records = cell_count / 6, .triangles = cell_count / 2 };
}

// As far as cells can name them and the device binds them.
GiWorldRoom GiWorld::largest_room() const {
	constexpr uint64_t GROWTH = 4;
	const GiWorldRoom usual = usual_room();
	const uint64_t room_bytes = device.info().max_storage_buffer_bytes / world_desc.cascades;
	const auto largest = [&](uint32_t p_usual, uint64_t p_bytes_each, uint64_t p_nameable) {
		return uint32_t(std::max<uint64_t>(p_usual, std::min({ p_usual * GROWTH, room_bytes / p_bytes_each, p_nameable })));
	};
	return {
		.cells = largest(usual.cells, sizeof(shader::WorldCell), UINT32_MAX),
		.records = largest(usual.records, std::max<uint64_t>(sizeof(shader::WorldRecord), GiWorld::RECORD_STATE_BYTES), (1u << 25) / world_desc.cascades),
		.triangles = largest(usual.triangles, 4, (1u << (32 - WORLD_LIST_COUNT_BITS)) - 1),
	};
}

std::optional<GiWorldRoom> GiWorld::check_room(std::span<const shader::CascadeCounts> p_counts) const {
	const GiWorldRoom largest = largest_room();
	const GiWorldRoom had = { .cells = params.cell_capacity, .records = params.record_capacity, .triangles = params.triangle_capacity };
	GiWorldRoom room = had;
	const auto grow = [](uint32_t &r_room, uint32_t p_wanted, uint32_t p_largest) {
		if (p_wanted > r_room) {
			r_room = std::max(r_room, uint32_t(std::min<uint64_t>(uint64_t(p_wanted) * 9 / 8, p_largest)));
		}
	};
	for (uint32_t i = 0; i < world_desc.cascades; i++) {
		grow(room.cells, p_counts[i].cells, largest.cells);
		grow(room.records, p_counts[i].records, largest.records);
		grow(room.triangles, p_counts[i].triangles, largest.triangles);
	}
	if (room != had) {
		log_info("GI needs more room for this scene: {} surface cells, {} records and {} listed triangles a cascade instead of {}, {} and {}", room.cells, room.records, room.triangles, had.cells, had.records, had.triangles);
		return room;
	}
	for (uint32_t i = 0; i < world_desc.cascades; i++) {
		const shader::CascadeCounts &wanted = p_counts[i];
		if (wanted.triangles > had.triangles) {
			log_warning_once(fmt::format("gi triangles {}", i), fmt::format("GI cascade {} has {} triangles in its cells' lists, more than its {}: some surfaces are as coarse as their voxels; raise sdfgi_min_cell_size", i, wanted.triangles, had.triangles));
		}
		if (wanted.cells > had.cells || wanted.records > had.records) {
			log_warning_once(fmt::format("gi capacity {}", i), fmt::format("GI cascade {} has {} surface cells and {} records, more than its {} and {}: some surfaces stay black in reflections and bounces; raise sdfgi_min_cell_size", i, wanted.cells, wanted.records, had.cells, had.records));
		}
	}
	return std::nullopt;
}

} // namespace lucent
