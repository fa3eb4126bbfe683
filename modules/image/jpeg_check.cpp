// SPDX-License-Identifier: MIT
#include "modules/image/jpeg_check.h"

#include <cstdint>

namespace lucent {

namespace {

constexpr uint8_t HUFFMAN_TABLES = 0xC4;
constexpr uint8_t RESTART_0 = 0xD0;
constexpr uint8_t IMAGE_START = 0xD8;
constexpr uint8_t IMAGE_END = 0xD9;
constexpr uint8_t SCAN = 0xDA;

// A segment's tables: a byte of kind, 16 counts, then as many symbols. The last may reach beyond the segment, which the decoder notices too late.
bool tables_fit(std::span<const std::byte> p_bytes, size_t p_begin, size_t p_end) {
	constexpr uint32_t MAX_CODES = 256;
	while (p_begin < p_end) {
		uint32_t codes = 0;
		for (size_t i = p_begin + 1; i <= p_begin + 16 && i < p_bytes.size(); i++) {
			codes += uint32_t(p_bytes[i]);
		}
		if (codes > MAX_CODES) {
			return false;
		}
		p_begin += 17 + codes;
	}
	return true;
}

} // namespace

const char *find_jpeg_fault(std::span<const std::byte> p_bytes) {
	bool has_scan = false;
	size_t position = 0;
	while (position + 1 < p_bytes.size()) {
		if (p_bytes[position] != std::byte(0xFF) || p_bytes[position + 1] == std::byte(0xFF)) {
			position++; // a scan's data, or padding
			continue;
		}
		const uint8_t marker = uint8_t(p_bytes[position + 1]);
		position += 2;
		if (marker == IMAGE_END) {
			return has_scan ? nullptr : "no scan";
		}
		if (marker <= 1 || (marker >= RESTART_0 && marker <= IMAGE_START)) {
			continue; // no segment
		}
		if (position + 2 > p_bytes.size()) {
			break;
		}
		const size_t length = size_t(p_bytes[position]) << 8 | size_t(p_bytes[position + 1]);
		if (length < 2 || length > p_bytes.size() - position) {
			break;
		}
		if (marker == HUFFMAN_TABLES && !tables_fit(p_bytes, position + 2, position + length)) {
			return "a Huffman table of more than 256 codes";
		}
		has_scan = has_scan || marker == SCAN;
		position += length;
	}
	return "no end marker";
}

} // namespace lucent
