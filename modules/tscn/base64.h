// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace lucent {

// RFC 4648; white space and missing padding are forgiven. Empty: other characters.
std::optional<std::vector<uint8_t>> decode_base64(std::string_view p_text);

} // namespace lucent
