// SPDX-License-Identifier: MIT
// Where a pass that is specialised for it (COUNT_FETCHES) leaves its count of fetches.
#ifndef FETCH_COUNTS_INC
#define FETCH_COUNTS_INC
#include "servers/rendering/gi/world/world_inc.glsl"

layout(set = 0, binding = WORLD_FETCH_COUNTS, scalar) buffer FetchCountsBlock {
	FetchCounts fetch_counts[];
};

uint carry_of_sum(uint before, uint added) {
	return before + added < before ? 1u : 0u;
}

// Called once, last, by every invocation. `pass`: FETCHES_*.
void store_fetches(uint pass) {
	if (COUNT_FETCHES == 0u || fetch_count == 0u) {
		return;
	}
	uint before = atomicAdd(fetch_counts[pass].fetches, fetch_count);
	atomicAdd(fetch_counts[pass].fetches_high, carry_of_sum(before, fetch_count));
	before = atomicAdd(fetch_counts[pass].bytes, fetch_bytes);
	atomicAdd(fetch_counts[pass].bytes_high, carry_of_sum(before, fetch_bytes));
}

#endif
