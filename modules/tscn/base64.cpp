// SPDX-License-Identifier: MIT
#include "modules/tscn/base64.h"

namespace lucent {

std::optional<std::vector<uint8_t>> decode_base64(std::string_view p_text) {
	static const std::string_view DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::vector<uint8_t> bytes;
	bytes.reserve(p_text.size() / 4 * 3);
	uint32_t bits = 0;
	int count = 0;
	for (const char c : p_text) {
		if (c == '=' || c == ' ' || c == '\t' || c == '\n' || c == '\r') {
			continue;
		}
		const size_t digit = DIGITS.find(c);
		if (digit == std::string_view::npos) {
			return std::nullopt;
		}
		bits = (bits << 6) | uint32_t(digit);
		count += 6;
		if (count >= 8) {
			count -= 8;
			bytes.push_back(uint8_t(bits >> count));
		}
	}
	return bytes;
}

} // namespace lucent
