// SPDX-License-Identifier: MIT
#pragma once
// Radiance pictures (.hdr), after Ward, "Real Pixels", Graphics Gems II, and radiance's color.c file format description.

#include "servers/core/error.h"
#include "servers/core/image.h"

#include <span>
#include <string>

namespace lucent {

// Flat and run-length encoded scanlines of 32-bit_rle_rgbe; rows from the top, columns from the left, as every writer does.
Result<Image> load_hdr(std::span<const std::byte> p_bytes, const std::string &p_name);

} // namespace lucent
