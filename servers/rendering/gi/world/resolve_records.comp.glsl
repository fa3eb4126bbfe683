// SPDX-License-Identifier: MIT
// Sums to means: each record's albedo, emission, normal, centroid.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_lookup_inc.glsl"

#define RESOLVE_RECORDS_ACCUMULATORS 20
#define RESOLVE_RECORDS_COUNTS 21
#define RESOLVE_RECORDS_RECORDS 22
#define RESOLVE_RECORDS_LIGHT 23

layout(local_size_x = 64) in;
layout(set = 0, binding = RESOLVE_RECORDS_ACCUMULATORS, scalar) readonly buffer AccumulatorsBlock {
	RecordAccumulator accumulators[];
};
layout(set = 0, binding = RESOLVE_RECORDS_COUNTS, scalar) readonly buffer CountsBlock {
	CascadeCounts counts[];
};
layout(set = 0, binding = RESOLVE_RECORDS_RECORDS, scalar) buffer RecordsBlock {
	WorldRecord records[];
};
layout(set = 0, binding = RESOLVE_RECORDS_LIGHT, scalar) writeonly buffer RecordLightBlock {
	uvec4 record_light[];
};
layout(push_constant, scalar) uniform ResolvePush {
	VoxelizeConstants constants;
};

void main() {
	GiCascade cascade = world.cascades[constants.cascade];
	uint count = min(counts[constants.cascade].records, world.record_capacity);
	uint stride = gl_NumWorkGroups.x * 64u;
	for (uint i = gl_GlobalInvocationID.x; i < count; i += stride) {
		uint index = record_base(constants.cascade) + i;
		WorldRecord record = records[index];
		RecordAccumulator sums = accumulators[i];
		uint axis = record_face(record) >> 1;
		float area = max(float(sums.area), 1.0) / WORLD_FIXED_AREA;
		vec3 area_vector = vec3(sums.normal) / WORLD_FIXED_AREA;
		vec3 normal = dot(area_vector, area_vector) > 1e-16 ? normalize(area_vector / cascade.cell_m) : vec3(0.0);
		if (normal == vec3(0.0) || face_from_normal(normal) != record_face(record)) {
			normal = vec3(0.0);
			normal[axis] = (record_face(record) & 1u) == 0u ? 1.0 : -1.0;
		}
		vec3 center = vec3(sums.position) / max(float(sums.area), 1.0);
		uvec3 p = uvec3(clamp(center, 0.0, 1.0) * 511.0 + 0.5);
		record.position = p.x | (p.y << 9) | (p.z << 18);
		uvec2 n = uvec2(ivec2(round(clamp(octahedral_from_direction(normal), -1.0, 1.0) * 4095.0))) & 0x1FFFu;
		record.normal = n.x | (n.y << 13);
		record.albedo = unorm111110_from_color(vec3(sums.albedo) / max(float(sums.area), 1.0));
		record.emission = rgb9e5_from_color(vec3(sums.emission) / WORLD_FIXED_EMISSION / area);
		float area_m2 = cascade.cell_m.x * cascade.cell_m.y * cascade.cell_m.z * length(area_vector / cascade.cell_m);
		float own_share = 3.0 * float(sums.own_emission) / max(float(sums.emission.x) + float(sums.emission.y) + float(sums.emission.z), 1.0);
		record.area = (floatBitsToUint(area_m2) & ~255u) | uint(clamp(own_share, 0.0, 1.0) * 255.0 + 0.5);
		records[index] = record;
		record_light[index] = uvec4(0u);
	}
}
