// SPDX-License-Identifier: MIT
#include "servers/rendering/gi/sdfgi/sdfgi_settings.h"

#include <fmt/format.h>

#include <bit>

namespace lucent {

std::string sdfgi_settings_error(const SdfgiSettings &p_settings) {
	const SdfgiSettings &s = p_settings;
	constexpr uint32_t MAX_PROBES_AXIS = 33;
	struct Range {
		const char *name;
		double value;
		double low;
		double high;
		bool power_of_two;
	};
	const Range ranges[] = {
		{ "cascades", double(s.cascades), 1, 8, false },
		{ "min_cell_size_m", s.min_cell_size_m, 1e-6, 1e6, false },
		{ "grid_size_cells", double(s.grid_size_cells), 64, 256, true },
		{ "probe_spacing_cells", double(s.probe_spacing_cells), 4, 16, true },
		{ "probe_rays", double(s.probe_rays), 1, 64, true },
		{ "probe_radiance_texels", double(s.probe_radiance_texels), 4, 16, true },
		{ "probe_irradiance_texels", double(s.probe_irradiance_texels), 4, 14, false },
		{ "frames_to_converge", double(s.frames_to_converge), 1, 32, true },
		{ "ray_cache_mib", double(s.ray_cache_mib), 1, 1024, false },
	};
	for (const Range &range : ranges) {
		if (!(range.value >= range.low * 0.999 && range.value <= range.high * 1.001) || (range.power_of_two && !std::has_single_bit(uint32_t(range.value)))) {
			return fmt::format("sdfgi {} {:g}: expected {} {:g} to {:g}", range.name, range.value, range.power_of_two ? "a power of two," : "a number,", range.low, range.high);
		}
	}
	if (s.grid_size_cells / s.probe_spacing_cells >= MAX_PROBES_AXIS) {
		return fmt::format("sdfgi: {} cells with probes every {}: at most {} probes an axis fit", s.grid_size_cells, s.probe_spacing_cells, MAX_PROBES_AXIS);
	}
	return {};
}

} // namespace lucent
