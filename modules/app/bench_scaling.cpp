// SPDX-License-Identifier: MIT
// How GI's cost grows with what one may turn.
#include "modules/app/bench_speed.h"

#include <cstdio>
#include <functional>

namespace lucent {

namespace {

struct ScaleCase {
	const char *group;
	std::string label;
	double x = 0;
	std::function<void(SpeedScene &)> apply;
};

void add_setting(std::vector<ScaleCase> &r_cases, const char *p_group, uint32_t p_value, uint32_t SdfgiSettings::*p_setting) {
	r_cases.push_back({ p_group, std::to_string(p_value), double(p_value), [=](SpeedScene &r_scene) {
						   SdfgiSettings settings = r_scene.sdfgi();
						   settings.*p_setting = p_value;
						   r_scene.set_sdfgi(settings);
					   } });
}

void add_plain(std::vector<ScaleCase> &r_cases, const char *p_group, const std::string &p_label, double p_x, const std::function<void(SpeedScene &)> &p_apply) {
	r_cases.push_back({ p_group, p_label, p_x, p_apply });
}

void add_load_cases(std::vector<ScaleCase> &r_cases, const SpeedPreset &p_preset) {
	for (const uint32_t triangles : { 10'000u, 100'000u, 1'000'000u, 10'000'000u }) {
		if (triangles <= p_preset.max_instanced_triangles) {
			add_plain(r_cases, "instanced triangles", std::to_string(triangles), triangles, [=](SpeedScene &r_scene) { r_scene.show_spheres(triangles); });
		}
	}
	for (const uint32_t lamps : { 1u, 10u, 100u, 1000u }) {
		if (lamps <= p_preset.max_lights) {
			add_plain(r_cases, "lamps", std::to_string(lamps), lamps, [=](SpeedScene &r_scene) { r_scene.add_lamps(lamps); });
		}
	}
	for (const float area : { 0.01f, 0.1f, 1.0f, 10.0f, 100.0f }) {
		if (!p_preset.cpu || area == 0.1f || area == 10.0f) {
			add_plain(r_cases, "emissive area, m2", fmt::format("{:g}", area), area, [=](SpeedScene &r_scene) { r_scene.add_emitter(area); });
		}
	}
}

std::vector<ScaleCase> make_cases(const SpeedPreset &p_preset) {
	std::vector<ScaleCase> cases;
	const bool cpu = p_preset.cpu;
	for (const uint32_t count : cpu ? std::vector<uint32_t>{ 1, 2, 4 } : std::vector<uint32_t>{ 1, 2, 3, 4, 5, 6, 7, 8 }) {
		add_setting(cases, "cascades", count, &SdfgiSettings::cascades);
	}
	for (const uint32_t height : cpu ? std::vector<uint32_t>{ 270, 540 } : std::vector<uint32_t>{ 540, 720, 1080, 1440, 2160 }) {
		add_plain(cases, "picture's height", std::to_string(height), height, [=](SpeedScene &r_scene) { r_scene.bench.set_size(height * 16 / 9, height); });
	}
	for (const uint32_t grid : cpu ? std::vector<uint32_t>{ 64, 128 } : std::vector<uint32_t>{ 64, 128, 256 }) {
		add_setting(cases, "distance field's size", grid, &SdfgiSettings::grid_size_cells);
	}
	for (const uint32_t spacing : cpu ? std::vector<uint32_t>{ 4, 16 } : std::vector<uint32_t>{ 4, 8, 16 }) {
		add_setting(cases, "probe spacing, cells", spacing, &SdfgiSettings::probe_spacing_cells);
	}
	for (const uint32_t rays : cpu ? std::vector<uint32_t>{ 8, 32 } : std::vector<uint32_t>{ 8, 16, 32, 64 }) {
		add_setting(cases, "rays a probe", rays, &SdfgiSettings::probe_rays);
	}
	for (const uint32_t texels : cpu ? std::vector<uint32_t>{ 4, 16 } : std::vector<uint32_t>{ 4, 8, 16 }) {
		add_setting(cases, "texels of a probe's radiance, an axis", texels, &SdfgiSettings::probe_radiance_texels);
	}
	for (const uint32_t texels : cpu ? std::vector<uint32_t>{ 14 } : std::vector<uint32_t>{ 4, 6, 8, 14 }) {
		add_setting(cases, "texels of a probe's irradiance, an axis", texels, &SdfgiSettings::probe_irradiance_texels);
	}
	add_load_cases(cases, p_preset);
	return cases;
}

ScalePoint measure(SpeedScene &r_scene, const SpeedPreset &p_preset, const ScaleCase &p_case) {
	ScalePoint point = { .group = p_case.group, .label = p_case.label, .x = p_case.x };
	r_scene.reset();
	p_case.apply(r_scene);
	const FrameSample first = r_scene.bench.draw();
	point.first_ms = first.gi_ms();
	point.gi = first.stats.gi; // the frame with the most rays
	for (uint32_t turn = 1; turn < r_scene.sdfgi().frames_to_converge; turn++) {
		r_scene.bench.draw();
	}
	std::vector<FrameSample> frames;
	for (uint32_t i = 0; i < p_preset.scaling_frames; i++) {
		r_scene.set_sun(1.0f + 0.001f * float(i % 2 + 1));
		frames.push_back(r_scene.bench.draw());
	}
	r_scene.set_sun(1.0f);
	for (const GiFetches &pass : r_scene.count_fetches()) {
		point.fetches.fetches += pass.fetches;
		point.fetches.bytes += pass.bytes;
	}
	point.gi_ms = gi_distribution(frames).median;
	point.frame_ms = gpu_distribution(frames).median;
	for (const PassRow &row : pass_rows(frames)) {
		point.gather_ms += row.name.starts_with("sdfgi.gather") ? row.ms.median : 0.0;
	}
	return point;
}

} // namespace

std::vector<ScalePoint> run_scaling(SpeedScene &r_scene, const SpeedPreset &p_preset, bool p_quiet) {
	std::vector<ScalePoint> points;
	for (const ScaleCase &scale_case : make_cases(p_preset)) {
		points.push_back(measure(r_scene, p_preset, scale_case));
		if (!p_quiet) {
			std::fprintf(stderr, "%s %s\n", scale_case.group, scale_case.label.c_str());
		}
	}
	r_scene.reset();
	return points;
}

} // namespace lucent
