// SPDX-License-Identifier: MIT
#pragma once
// Memory that is filled once and read at random: on large pages, where the system has them, so that a look-up costs no page walk.

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace lucent {

class HugeArena {
public:
	// Uninitialized, aligned to a cache line, lives as long as the arena. Throws std::bad_alloc as new does.
	std::byte *allocate(size_t p_bytes) {
		const size_t size = (p_bytes + LINE_BYTES - 1) / LINE_BYTES * LINE_BYTES;
		if (size > left) {
			add_chunk(size);
		}
		std::byte *const result = next;
		next += size;
		left -= size;
		return result;
	}

private:
	static constexpr size_t LINE_BYTES = 64;
	static constexpr size_t PAGE_BYTES = size_t(2) << 20;
	static constexpr size_t CHUNK_BYTES = 16 * PAGE_BYTES; // pages that nobody touches take no memory

	struct Free {
		void operator()(std::byte *p_memory) const { std::free(p_memory); }
	};

	void add_chunk(size_t p_bytes) {
		const size_t size = std::max((p_bytes + PAGE_BYTES - 1) / PAGE_BYTES * PAGE_BYTES, CHUNK_BYTES);
		chunks.emplace_back(static_cast<std::byte *>(std::aligned_alloc(PAGE_BYTES, size)));
		next = chunks.back().get();
		left = next ? size : throw std::bad_alloc();
#if defined(__linux__)
		madvise(next, size, MADV_HUGEPAGE);
#endif
	}

	std::vector<std::unique_ptr<std::byte, Free>> chunks;
	std::byte *next = nullptr;
	size_t left = 0;
};

} // namespace lucent
