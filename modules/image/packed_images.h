// SPDX-License-Identifier: MIT
#pragma once
// JPEG, PNG and WebP through libjpeg-turbo, libpng and libwebp, which take any bytes. All answer RGBA8 with the values that the file
// has: no colour profile or gamma is applied. Errors begin with p_name.

#include "servers/core/error.h"
#include "servers/core/image.h"

#include <span>
#include <string>

namespace lucent {

Result<Image> load_jpeg(std::span<const std::byte> p_bytes, const std::string &p_name);
Result<Image> load_png(std::span<const std::byte> p_bytes, const std::string &p_name);
Result<Image> load_webp(std::span<const std::byte> p_bytes, const std::string &p_name);

// Whether an image of this size is within the limits of image_io.h; the error says which. p_bytes: of a PNG or JPEG, a few of which
// must not ask for half a gigabyte. Deflate makes a byte of at most 1032, so of 8256 texels; Huffman's codes of a JPEG have a bit for 64.
Status check_image_size(uint64_t p_width, uint64_t p_height, const std::string &p_name, uint64_t p_bytes = UINT64_MAX);

} // namespace lucent
