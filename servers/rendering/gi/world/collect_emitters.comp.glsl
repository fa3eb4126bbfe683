// SPDX-License-Identifier: MIT
// The list of emissive records that stand for themselves (not those that a finer cascade holds too), with the running share of their power, by one work group.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_inc.glsl"
#include "servers/rendering/gi/world/group_scan_inc.glsl"

#define COLLECT_EMITTERS_COUNTS 20
#define COLLECT_EMITTERS_LIST 21
#define COLLECT_EMITTERS_COUNT 22

layout(local_size_x = 256) in;
layout(set = 0, binding = WORLD_RECORDS, scalar) readonly buffer RecordsBlock {
	WorldRecord records[];
};
layout(set = 0, binding = COLLECT_EMITTERS_COUNTS, scalar) readonly buffer CountsBlock {
	CascadeCounts counts[];
};
layout(set = 0, binding = COLLECT_EMITTERS_LIST, scalar) buffer EmittersBlock {
	Emitter emitters[];
};
layout(set = 0, binding = COLLECT_EMITTERS_COUNT, scalar) writeonly buffer EmitterCountBlock {
	uint emitter_count; // in the list
	uint emitters_wanted;
};

float emitter_power(WorldRecord record) {
	if (record.emission == 0u || !record_has_start(record) || cell_in_finer(record_cascade(record), record_world_cell(record), 0)) {
		return 0.0;
	}
	return dot(color_from_rgb9e5(record.emission), vec3(1.0)) * record_emitting_area_m2(record);
}

shared float group_power[256];

void main() {
	uint lane = gl_LocalInvocationIndex;
	uint found = 0u;
	float power = 0.0;
	for (uint pass = 0u; pass < 2u; pass++) {
		uint slot = pass == 0u ? 0u : scan_group(found);
		float running = 0.0;
		float total = 0.0;
		if (pass == 1u) {
			group_power[lane] = power;
			barrier();
			for (uint i = 0u; i < 256u; i++) {
				running += i < lane ? group_power[i] : 0.0;
				total += group_power[i];
			}
			if (lane == 0u) {
				emitters_wanted = group_total;
				// More than the list holds: the gather rays see all emission, as they do that of near emitters.
				emitter_count = group_total <= uint(emitters.length()) ? group_total : 0u;
			}
		}
		for (uint c = 0u; c < world.cascade_count; c++) {
			uint count = min(counts[c].records, world.record_capacity);
			uint each = (count + 255u) / 256u;
			uint end = min(count, (lane + 1u) * each);
			for (uint i = lane * each; i < end; i++) {
				uint index = record_base(c) + i;
				float record_power = records[index].emission == 0u ? 0.0 : emitter_power(records[index]);
				if (!(record_power > 0.0)) {
					continue;
				}
				if (pass == 0u) {
					found++;
					power += record_power;
				} else if (slot < uint(emitters.length())) {
					running += record_power;
					emitters[slot] = Emitter(index, running / total, record_power / total);
					slot++;
				}
			}
		}
	}
}
