// SPDX-License-Identifier: MIT
// Running sum over a work group of 256: call scan_group(value) in uniform control flow; returns the sum of the lanes before,
// group_total is the whole sum.
#ifndef GROUP_SCAN_INC
#define GROUP_SCAN_INC

shared uint group_scan[256];
uint group_total;

uint scan_group(uint value) {
	uint lane = gl_LocalInvocationIndex;
	barrier();
	group_scan[lane] = value;
	barrier();
	for (uint step = 1u; step < 256u; step *= 2u) {
		uint below = lane >= step ? group_scan[lane - step] : 0u;
		barrier();
		group_scan[lane] += below;
		barrier();
	}
	group_total = group_scan[255];
	return group_scan[lane] - value;
}

#endif
