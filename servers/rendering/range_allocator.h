// SPDX-License-Identifier: MIT
#pragma once
// First-fit allocation of ranges of elements in a growing array.

#include <cstdint>
#include <map>

namespace lucent {

class RangeAllocator {
public:
	uint64_t capacity() const { return size; }
	// UINT64_MAX: no gap is long enough; grow() and try again.
	uint64_t allocate(uint64_t p_count) {
		for (auto it = gaps.begin(); it != gaps.end(); ++it) {
			if (it->second >= p_count) {
				const uint64_t first = it->first;
				const uint64_t rest = it->second - p_count;
				gaps.erase(it);
				if (rest > 0) {
					gaps[first + p_count] = rest;
				}
				return first;
			}
		}
		return UINT64_MAX;
	}
	void free(uint64_t p_first, uint64_t p_count) {
		auto next = gaps.lower_bound(p_first);
		if (next != gaps.end() && p_first + p_count == next->first) {
			p_count += next->second;
			next = gaps.erase(next);
		}
		if (next != gaps.begin()) {
			auto previous = std::prev(next);
			if (previous->first + previous->second == p_first) {
				previous->second += p_count;
				return;
			}
		}
		gaps[p_first] = p_count;
	}
	void grow(uint64_t p_capacity) {
		if (p_capacity > size) {
			const uint64_t first = size;
			size = p_capacity;
			free(first, p_capacity - first);
		}
	}

private:
	std::map<uint64_t, uint64_t> gaps; // first, count
	uint64_t size = 0;
};

} // namespace lucent
