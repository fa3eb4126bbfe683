// SPDX-License-Identifier: MIT
// Takes over the places that place_record_starts found: a pass of its own, since that one's rays read every record.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "servers/rendering/gi/world/world_inc.glsl"

#define MOVE_RECORDS_COUNTS 20
#define MOVE_RECORDS_POSITIONS 21
#define MOVE_RECORDS_RECORDS 22

layout(local_size_x = 64) in;
layout(set = 0, binding = MOVE_RECORDS_COUNTS, scalar) readonly buffer CountsBlock {
	CascadeCounts counts[];
};
layout(set = 0, binding = MOVE_RECORDS_POSITIONS, scalar) readonly buffer PositionsBlock {
	uvec2 new_places[]; // WorldRecord.position and .area
};
layout(set = 0, binding = MOVE_RECORDS_RECORDS, scalar) buffer RecordsBlock {
	WorldRecord records[];
};
layout(push_constant, scalar) uniform MovePush {
	VoxelizeConstants constants;
};

void main() {
	uint count = min(counts[constants.cascade].records, world.record_capacity);
	uint stride = gl_NumWorkGroups.x * 64u;
	for (uint i = gl_GlobalInvocationID.x; i < count; i += stride) {
		records[record_base(constants.cascade) + i].position = new_places[i].x;
		records[record_base(constants.cascade) + i].area = new_places[i].y;
	}
}
