// SPDX-License-Identifier: MIT
#pragma once
// Image files. Reads PNG, JPEG, WebP, TGA, BMP, Radiance HDR and OpenEXR; writes PNG and OpenEXR. The kind is told by the first
// bytes, and only a TGA, which has no mark, by its name. Rows run from the top. Errors read "file: what was expected". Output repeats bit for bit.

#include "servers/core/error.h"
#include "servers/core/image.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lucent {

// Larger images are refused before anything is allocated for their texels.
inline constexpr uint32_t MAX_IMAGE_SIDE_TEXELS = 32768;
inline constexpr uint64_t MAX_IMAGE_TEXELS = uint64_t(1) << 27;

// PNG, JPEG, WebP, TGA and BMP become RGBA8 (16-bit PNGs are rounded), HDR and EXR become RGBA32F, alpha 1 where the file has none.
// An EXR without plain R, G, B shows its Y (grey) or the first layer that has R, G, B ("Combined.R").
Result<Image> load_image(const std::string &p_path);

// p_name stands for the file in messages.
Result<Image> load_image_from_memory(std::span<const std::byte> p_bytes, const std::string &p_name);

// p_channels 8-bit values a texel: 1 (grey), 3 (RGB) or 4 (RGBA), sRGB-encoded by convention.
Status write_png(const std::string &p_path, uint32_t p_width, uint32_t p_height, uint32_t p_channels, std::span<const uint8_t> p_values);

// Interleaved channels of one name: { "direct", { "R", "G", "B" } } is stored as direct.R, direct.G, direct.B; an empty name
// stores plain R, G, B.
struct ExrLayer {
	std::string name;
	std::vector<std::string> channels;
	std::span<const float> values; // width * height * channels.size()
	bool half = false; // stored as 16-bit floats, rounded to nearest
};

// 32-bit float unless a layer says otherwise, ZIP compression.
Status write_exr(const std::string &p_path, uint32_t p_width, uint32_t p_height, std::span<const ExrLayer> p_layers);

struct ExrChannel {
	std::string name; // in full: "direct.R"; channels of a named part of a multi-part file: "part.direct.R"
	std::vector<float> values; // width * height
};

struct ExrImage {
	uint32_t width = 0;
	uint32_t height = 0;
	std::vector<ExrChannel> channels; // sorted by name within a part

	const ExrChannel *find(const std::string &p_name) const;
};

// Every channel of every flat part that has the first part's size.
Result<ExrImage> read_exr_layers(const std::string &p_path);
Result<ExrImage> read_exr_layers_from_memory(std::span<const std::byte> p_bytes, const std::string &p_name);

} // namespace lucent
