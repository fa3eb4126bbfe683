// SPDX-License-Identifier: MIT
// Debug views: what the world and the probes hold, seen by primary rays through the world itself.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/gi_sample_inc.glsl"

#define DEBUG_GI_TARGET 20
#define DEBUG_GI_DEPTH 21

// Numbers as in Sdfgi::debug_views().
#define DEBUG_VIEW_SDF 0u
#define DEBUG_VIEW_ALBEDO 1u
#define DEBUG_VIEW_LIGHT 2u
#define DEBUG_VIEW_EMISSION 3u
#define DEBUG_VIEW_NORMALS 4u
#define DEBUG_VIEW_CASCADE 5u
#define DEBUG_VIEW_PROBES 6u
#define DEBUG_VIEW_OCCLUSION 7u
#define DEBUG_VIEW_RADIANCE 8u

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = DEBUG_GI_TARGET, rgba16f) uniform writeonly image2D target;
layout(set = 0, binding = DEBUG_GI_DEPTH) uniform texture2D depth_texture;
layout(push_constant, scalar) uniform DebugPush {
	GatherConstants constants;
};

vec3 cascade_color(uint cascade) {
	const vec3 COLORS[8] = vec3[](vec3(1.0, 0.3, 0.3), vec3(0.3, 1.0, 0.3), vec3(0.35, 0.45, 1.0), vec3(1.0, 0.9, 0.3), vec3(1.0, 0.4, 1.0), vec3(0.3, 1.0, 1.0), vec3(1.0, 0.6, 0.2), vec3(0.8, 0.8, 0.8));
	return COLORS[min(cascade, 7u)];
}

vec3 view_of_hit(WorldHit hit, vec3 direction) {
	if (hit.cell >= WORLD_LOST_CELL) {
		return vec3(1.0, 0.0, 1.0);
	}
	if (constants.view == DEBUG_VIEW_RADIANCE) {
		return hit_radiance(hit, direction);
	}
	vec3 sum = vec3(0.0);
	float weight_sum = 0.0;
	uint packed_records = world_cells[hit.cell].records;
	uint index = cell_first_record(packed_records);
	uint end = record_end(hit.cascade);
	for (uint faces = packed_records & 63u; faces != 0u && index < end; faces &= faces - 1u, index++) {
		WorldRecord record = world_records[index];
		float weight = max(-dot(record_normal(record), direction), 0.0);
		vec3 value = color_from_unorm111110(record.albedo);
		if (constants.view == DEBUG_VIEW_LIGHT) {
			value = vec4_from_half4(world_record_light[index].xy).rgb / max(value, vec3(0.01));
		} else if (constants.view == DEBUG_VIEW_EMISSION) {
			value = color_from_rgb9e5(record.emission);
		} else if (constants.view == DEBUG_VIEW_NORMALS) {
			value = record_normal(record) * 0.5 + 0.5;
		}
		sum += weight * value;
		weight_sum += weight;
	}
	return weight_sum > 0.0 ? sum / weight_sum : vec3(0.0);
}

// The nearest probe sphere of one cascade that the ray meets before t_max.
vec4 probe_spheres(uint cascade, vec3 origin_m, vec3 direction, float t_max_m) {
	GiCascade c = world.cascades[cascade];
	float spacing = float(probe_params.spacing_cells);
	vec3 step_m = c.cell_m * spacing;
	float radius_m = 0.08 * min(step_m.x, min(step_m.y, step_m.z));
	vec4 result = vec4(0.0, 0.0, 0.0, t_max_m);
	ivec3 first = first_probe(cascade);
	// Samples a third of a spacing apart, each looks at the nearest probe.
	for (uint i = 0u; i < 160u; i++) {
		float t = float(i) * 0.3 * min(step_m.x, min(step_m.y, step_m.z));
		if (t > result.w) {
			break;
		}
		ivec3 probe = ivec3(round((origin_m + direction * t) / step_m));
		if (any(lessThan(probe, first)) || any(greaterThanEqual(probe, first + int(probe_params.probes)))) {
			continue;
		}
		uint index = probe_index(cascade, probe);
		vec3 center_m = probe_position_m(cascade, probe, gi_probe_places[index]);
		vec3 to_center = center_m - origin_m;
		float along = dot(to_center, direction);
		float off_squared = dot(to_center, to_center) - along * along;
		if (along > 0.0 && off_squared < radius_m * radius_m) {
			float t_hit = along - sqrt(radius_m * radius_m - off_squared);
			if (t_hit > 0.0 && t_hit < result.w) {
				vec3 normal = normalize(origin_m + direction * t_hit - center_m);
				vec2 uv = probe_uv(index, normal, int(probe_params.irradiance_texels), vec2(textureSize(gi_probe_irradiance, 0)));
				vec3 color = probe_is_free(gi_probe_places[index]) ? textureLod(sampler2D(gi_probe_irradiance, gi_probe_sampler), uv, 0.0).rgb : vec3(1.0, 0.0, 1.0);
				result = vec4(color, t_hit);
			}
		}
	}
	return result;
}

void main() {
	ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
	if (pixel.x >= int(constants.width) || pixel.y >= int(constants.height)) {
		return;
	}
	vec2 ndc = (vec2(pixel) + 0.5) / vec2(float(constants.width), float(constants.height)) * 2.0 - 1.0;
	float depth = texelFetch(depth_texture, pixel, 0).r;
	vec4 h = constants.world_from_clip * vec4(ndc, max(depth, 1e-6), 1.0);
	vec3 point_m = h.xyz / h.w;
	vec3 direction = normalize(point_m - constants.camera_m);
	vec3 color = vec3(0.0);
	uint cascade = finest_cascade(constants.camera_m);
	WorldHit hit = trace_world(constants.camera_m, direction, 1e6, cascade);
	if (constants.view == DEBUG_VIEW_PROBES) {
		color = hit.hit ? 0.2 * hit_radiance(hit, direction) : vec3(0.0);
		vec4 spheres = probe_spheres(0u, constants.camera_m, direction, hit.hit ? hit.t_m + 0.2 : 100.0);
		color = spheres.w < (hit.hit ? hit.t_m + 0.2 : 100.0) ? spheres.rgb : color;
	} else if (constants.view == DEBUG_VIEW_OCCLUSION) {
		// Share of the eight probes' trilinear weight that sees the point.
		if (depth > 0.0 && hit.hit) {
			GiQuery query = GiQuery(point_m, -direction, -direction, 1.0, point_m, false);
			uint at = finest_cascade(point_m);
			if (at < world.cascade_count) {
				find_query_start(query, at, true);
				ProbeSums sums = sample_probes(query, at, direction, false, true);
				color = vec3(clamp(sums.weight, 0.0, 1.0));
			}
		}
	} else if (constants.view == DEBUG_VIEW_SDF) {
		// Distance field a cell before the hit's surface: white far from anything, banded by cells.
		vec3 at_m = constants.camera_m + direction * (hit.hit ? hit.t_m * 0.5 : 5.0);
		uint at = finest_cascade(at_m);
		if (at < world.cascade_count) {
			float cells = sdf_cells(at, storage_from_world_cell(ivec3(floor(at_m / world.cascades[at].cell_m))));
			color = vec3(cells / 32.0) * (0.75 + 0.25 * step(0.5, fract(cells)));
		}
	} else if (hit.hit) {
		color = constants.view == DEBUG_VIEW_CASCADE ? cascade_color(hit.cascade) * (0.4 + 0.6 * float((hit.world_cell.x ^ hit.world_cell.y ^ hit.world_cell.z) & 1)) : view_of_hit(hit, direction);
	}
	imageStore(target, pixel, vec4(color, 1.0));
}
