// SPDX-License-Identifier: MIT
#pragma once
// PCG-XSH-RR 64/32 (O'Neill, HMC-CS-2014-0905). One generator a path, seeded from pixel and sample: pictures don't depend on threads.

#include <cstdint>

namespace lucent {

// Stafford's variant 13 of the 64-bit finalizer ("SplitMix64").
inline uint64_t mix_bits(uint64_t p_value) {
	p_value = (p_value ^ (p_value >> 30)) * 0xbf58476d1ce4e5b9ull;
	p_value = (p_value ^ (p_value >> 27)) * 0x94d049bb133111ebull;
	return p_value ^ (p_value >> 31);
}

class Random {
public:
	Random(uint32_t p_seed, uint32_t p_pixel, uint32_t p_sample) {
		const uint64_t stream = mix_bits((uint64_t(p_seed) << 32 | p_pixel) + 0x9e3779b97f4a7c15ull);
		increment = stream | 1;
		state = mix_bits(stream + p_sample * 0x9e3779b97f4a7c15ull);
		next_uint();
	}
	uint32_t next_uint() {
		const uint64_t old = state;
		state = old * 6364136223846793005ull + increment;
		const uint32_t shifted = uint32_t(((old >> 18) ^ old) >> 27);
		const uint32_t rotation = uint32_t(old >> 59);
		return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
	}
	// [0, 1), multiples of 2^-24
	float next() { return float(next_uint() >> 8) * 0x1p-24f; }

private:
	uint64_t state;
	uint64_t increment;
};

} // namespace lucent
