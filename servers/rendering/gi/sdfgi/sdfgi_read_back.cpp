// SPDX-License-Identifier: MIT
// What a frame counted: whether the light has settled, whether the world has room for the scene, statistics.
#include "servers/rendering/gi/sdfgi/sdfgi_impl.h"

#include <cstring>

namespace lucent {

namespace {

// Light is settled when fewer than this share of the lit records moved by over SETTLED_CHANGE in a frame, or after this many frames.
constexpr double SETTLED_SHARE = 0.01;
constexpr uint32_t MAX_FRAMES = 400;

// By FETCHES_*.
constexpr const char *COUNTED_PASSES[FETCHES_PASSES] = { "sdfgi.trace_records", "sdfgi.light_lamps", "sdfgi.light_records", "sdfgi.trace_probes", "sdfgi.trace_far_probes", "sdfgi.filter_probes", "sdfgi.filter_far_probes", "sdfgi.gather_gi", "sdfgi.gather_rays" };

} // namespace

void Sdfgi::Impl::read_fetches() {
	const std::vector<shader::FetchCounts> counts = device.read_back_buffer<shader::FetchCounts>(fetch_counts);
	for (uint32_t pass = 0; pass < FETCHES_PASSES; pass++) {
		const shader::FetchCounts &count = counts[pass];
		stats.fetches.push_back({ COUNTED_PASSES[pass], uint64_t(count.fetches_high) << 32 | count.fetches, uint64_t(count.bytes_high) << 32 | count.bytes });
	}
}

void Sdfgi::Impl::read_gather_counts() {
	const std::vector<std::byte> bytes = device.read_back_buffer(ray_pixels, 0, sizeof(shader::GatherCounts));
	shader::GatherCounts counts;
	std::memcpy(&counts, bytes.data(), sizeof(counts));
	stats.startless_pixels = counts.startless;
	stats.recordless_pixels = counts.recordless;
	picture_counted = true;
}

// A scene that needs more room than the world has gets a larger world in the next frame.
void Sdfgi::Impl::check_room(const std::vector<shader::CascadeCounts> &p_counts) {
	if (const std::optional<GiWorldRoom> room = world->check_room(p_counts)) {
		least_room = *room;
		needs_room = true;
	}
}

void Sdfgi::after_frame() {
	Impl &i = *impl;
	i.stats.fetches.clear();
	if (i.world != nullptr && i.settings.count_fetches) {
		i.read_fetches();
	}
	if (i.gathered && i.converged && !i.picture_counted) {
		i.read_gather_counts();
	}
	i.gathered = false;
	if (i.world != nullptr && i.checks_room && !i.checks_light) {
		i.check_room(i.device.read_back_buffer<shader::CascadeCounts>(i.world->counts_handle()));
	}
	i.checks_room = false;
	if (!i.checks_light || i.world == nullptr) {
		return;
	}
	const std::vector<shader::SdfgiStatistics> statistics = i.device.read_back_buffer<shader::SdfgiStatistics>(i.statistics);
	const std::vector<shader::CascadeCounts> counts = i.device.read_back_buffer<shader::CascadeCounts>(i.world->counts_handle());
	i.peak_rays = std::max<uint64_t>(i.peak_rays, statistics[0].rays);
	i.stats.rays = i.settings.count_every_frame ? statistics[0].rays : i.peak_rays;
	if (statistics[0].met[GATHER_MET_SKY] + statistics[0].met[GATHER_MET_RECORD] > 0) { // a frame that traced
		std::copy(std::begin(statistics[0].met), std::end(statistics[0].met), i.stats.gather_rays.begin());
	}
	i.stats.surface_cells = i.stats.listed_triangles = i.stats.plain_cells = i.stats.unlisted_cells = i.stats.surface_records = 0;
	for (uint32_t c = 0; c < i.settings.cascades; c++) {
		i.stats.surface_cells += counts[c].cells;
		i.stats.surface_records += counts[c].records;
		i.stats.listed_triangles += counts[c].triangles;
		i.stats.plain_cells += counts[c].plain_cells;
		i.stats.unlisted_cells += counts[c].unlisted_cells;
	}
	i.check_room(counts);
	if (i.may_settle && i.frame % CHECK_PERIOD_FRAMES == 0) {
		i.light_settled = i.light_settled || statistics[0].changed_records <= uint32_t(SETTLED_SHARE * statistics[0].lit_records) || i.frame >= MAX_FRAMES;
		i.converged = i.light_settled && i.frame >= i.frames_of_probes();
	}
	i.stats.converged = i.converged;
	i.checks_light = false;
}

} // namespace lucent
