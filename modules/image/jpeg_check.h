// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace lucent {

// What the decoder must be spared, walked over as it does (ITU-T T.81, annex B): Huffman tables of more than 256 codes, which it
// stores without looking, and files that end before their picture does, which it fills up with grey. Null: none; else what is wrong.
const char *find_jpeg_fault(std::span<const std::byte> p_bytes);

} // namespace lucent
