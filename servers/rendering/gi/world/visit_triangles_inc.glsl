// SPDX-License-Identifier: MIT
// Walks every cell of a cascade that a triangle touches. A work group takes 64 triangles, or 64 further stretches of large ones
// (list_columns), and shares their columns of cells, so that large triangles hold up neither a lane nor a group. No lane visits more
// than WORLD_COLUMN_STRETCH columns: llvmpipe ends an invocation's loops after 65535 turns.
//   void visit_cell(VoxelTriangle triangle, ivec3 cell);   // cell: local, 0 .. grid_size - 1; called where the triangle touches it
// is the including shader's; main() is here.
#ifndef VISIT_TRIANGLES_INC
#define VISIT_TRIANGLES_INC
#include "servers/rendering/gi/world/voxel_triangle_inc.glsl"

layout(set = 0, binding = VOXEL_STRETCHES, scalar) readonly buffer ColumnStretchesBlock {
	uint stretches_wanted;
	ColumnStretch stretches[];
};

void visit_cell(VoxelTriangle triangle, ivec3 cell);

layout(local_size_x = 64) in;

shared VoxelTriangle group_triangles[64];
shared TriangleColumns group_columns[64];
shared uint group_first[64]; // first column of the stretch
shared uint group_end[64]; // running sum of columns

void visit_column(uint slot, uint column) {
	VoxelTriangle triangle = group_triangles[slot];
	vec3 n = cross(triangle.v[1] - triangle.v[0], triangle.v[2] - triangle.v[0]);
	uint k = main_axis(n);
	uint u = (k + 1u) % 3u;
	uint v = (k + 2u) % 3u;
	ivec3 size = group_columns[slot].size;
	ivec3 low_cell = group_columns[slot].low;
	ivec3 cell = low_cell;
	cell[u] += int(column) % size[u];
	cell[v] += int(column) / size[u];
	// The plane's depth over the column's square.
	float d = dot(n, triangle.v[0]);
	float center = (d - n[u] * (float(cell[u]) + 0.5) - n[v] * (float(cell[v]) + 0.5)) / n[k];
	float spread = (abs(n[u]) + abs(n[v])) / abs(n[k]) * (0.5 + CELL_TOUCH) + 2.0 * CELL_TOUCH;
	int low = max(low_cell[k], int(floor(center - spread)));
	int high = min(low_cell[k] + size[k] - 1, int(floor(center + spread)));
	TriangleBoxTest test = make_box_test(triangle.v, 1.0, CELL_TOUCH);
	for (int w = low; w <= high; w++) {
		cell[k] = w;
		if (touches_box(test, vec3(cell) - CELL_TOUCH)) {
			visit_cell(triangle, cell);
		}
	}
}

void main() {
	uint lane = gl_LocalInvocationIndex;
	uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
	uint triangle_groups = (constants.triangle_count + 63u) / 64u;
	bool listed = stretches_wanted <= uint(stretches.length());
	uint triangle = group * 64u + lane;
	uint first = 0u;
	if (group >= triangle_groups) {
		uint i = triangle - triangle_groups * 64u;
		bool has_stretch = listed && i < stretches_wanted;
		triangle = has_stretch ? stretches[i].triangle : constants.triangle_count;
		first = has_stretch ? stretches[i].first_column : 0u;
	}
	uint columns = 0u;
	if (triangle < constants.triangle_count) {
		group_triangles[lane] = load_triangle(triangle);
		group_columns[lane] = columns_of_triangle(group_triangles[lane]);
		group_first[lane] = first;
		columns = group_columns[lane].count - first;
		columns = listed ? min(columns, WORLD_COLUMN_STRETCH) : columns;
	}
	group_end[lane] = columns;
	barrier();
	for (uint step = 1u; step < 64u; step *= 2u) {
		uint below = lane >= step ? group_end[lane - step] : 0u;
		barrier();
		group_end[lane] += below;
		barrier();
	}
	uint total = group_end[63];
	for (uint column = lane; column < total; column += 64u) {
		uint slot = 0u;
		for (uint half_size = 32u; half_size > 0u; half_size /= 2u) {
			if (group_end[slot + half_size - 1u] <= column) {
				slot += half_size;
			}
		}
		uint before = slot > 0u ? group_end[slot - 1u] : 0u;
		visit_column(slot, group_first[slot] + column - before);
	}
}

#endif
