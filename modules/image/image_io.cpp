// SPDX-License-Identifier: MIT
#include "modules/image/image_io.h"

#include "modules/image/hdr_io.h"
#include "modules/image/packed_images.h"
#include "servers/core/file_io.h"

#include <algorithm>
#include <cstring>

#define STBI_MAX_DIMENSIONS 32768
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_NO_STDIO
#define STBI_ASSERT(m_condition) // some of them a broken file can fail
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace lucent {

static_assert(STBI_MAX_DIMENSIONS == MAX_IMAGE_SIDE_TEXELS);

namespace {

bool begins_with(std::span<const std::byte> p_bytes, std::string_view p_magic) {
	return p_bytes.size() >= p_magic.size() && std::memcmp(p_bytes.data(), p_magic.data(), p_magic.size()) == 0;
}

// Bytes for stb_image, which takes zeros where they end: that it asked for more is the only sign.
struct StbSource {
	std::span<const std::byte> bytes;
	size_t position = 0;
	const char *buffer = nullptr; // stb's own, which it fills with what there is; other places must get what they ask for
	bool past_end = false;

	static int read(void *p_source, char *r_data, int p_size) {
		StbSource &source = *static_cast<StbSource *>(p_source);
		source.buffer = source.buffer ? source.buffer : r_data;
		const size_t count = std::min(size_t(p_size), source.bytes.size() - source.position);
		source.past_end = source.past_end || (r_data == source.buffer ? count == 0 : count < size_t(p_size));
		std::copy_n(reinterpret_cast<const char *>(source.bytes.data()) + source.position, count, r_data);
		source.position += count;
		return int(count);
	}
	static void skip(void *p_source, int p_count) {
		StbSource &source = *static_cast<StbSource *>(p_source);
		const int64_t wanted = int64_t(source.position) + p_count;
		source.position = size_t(std::clamp<int64_t>(wanted, 0, int64_t(source.bytes.size())));
	}
	static int at_end(void *p_source) {
		const StbSource &source = *static_cast<const StbSource *>(p_source);
		return source.position == source.bytes.size();
	}
};

constexpr stbi_io_callbacks STB_CALLBACKS = { StbSource::read, StbSource::skip, StbSource::at_end };
constexpr uint64_t MAX_TEXELS_A_BYTE = 128; // run lengths of TGA

Result<Image> load_with_stb(std::span<const std::byte> p_bytes, const std::string &p_name, const char *p_kind) {
	int width = 0, height = 0, channels = 0;
	StbSource header{ p_bytes };
	if (!stbi_info_from_callbacks(&STB_CALLBACKS, &header, &width, &height, &channels) || width <= 0 || height <= 0) {
		return make_error("{}: broken {} header ({})", p_name, p_kind, stbi_failure_reason());
	}
	if (const Status status = check_image_size(uint64_t(width), uint64_t(height), p_name); !status) {
		return status.error();
	}
	if (uint64_t(width) * uint64_t(height) > MAX_TEXELS_A_BYTE * p_bytes.size()) {
		return make_error("{}: truncated {} data: {} bytes can't hold {} x {} texels", p_name, p_kind, p_bytes.size(), width, height);
	}
	Image image;
	StbSource source{ p_bytes };
	stbi_uc *texels = stbi_load_from_callbacks(&STB_CALLBACKS, &source, &width, &height, &channels, 4);
	if (!texels || source.past_end) {
		stbi_image_free(texels);
		return make_error("{}: broken or truncated {} data ({})", p_name, p_kind, texels ? "the file ends too early" : stbi_failure_reason());
	}
	image.width = uint32_t(width);
	image.height = uint32_t(height);
	image.texels.resize(size_t(width) * size_t(height) * image.texel_size_bytes());
	std::memcpy(image.texels.data(), texels, image.texels.size());
	stbi_image_free(texels);
	return image;
}

const std::vector<float> *find_channel(const ExrImage &p_exr, const std::string &p_name) {
	const ExrChannel *channel = p_exr.find(p_name);
	return channel ? &channel->values : nullptr;
}

// The prefix ("" or "layer.") of the channels that stand for the picture; "!" when there are none.
std::string picture_prefix(const ExrImage &p_exr) {
	if (p_exr.find("R") && p_exr.find("G") && p_exr.find("B")) {
		return "";
	}
	for (const ExrChannel &channel : p_exr.channels) {
		const std::string prefix = channel.name.substr(0, channel.name.rfind('.') + 1);
		if (p_exr.find(prefix + "R") && p_exr.find(prefix + "G") && p_exr.find(prefix + "B")) {
			return prefix;
		}
	}
	return "!";
}

Result<Image> load_exr(std::span<const std::byte> p_bytes, const std::string &p_name) {
	const Result<ExrImage> read = read_exr_layers_from_memory(p_bytes, p_name);
	if (!read) {
		return read.error();
	}
	const ExrImage &exr = read.value();
	if (uint64_t(exr.width) * exr.height > MAX_IMAGE_TEXELS) {
		return make_error("{}: {} x {} texels are more than the limit of {}", p_name, exr.width, exr.height, MAX_IMAGE_TEXELS);
	}
	const std::vector<float> *sources[4] = {};
	const std::string prefix = exr.find("Y") && !exr.find("R") ? "!" : picture_prefix(exr);
	if (prefix != "!") {
		const char *names[] = { "R", "G", "B", "A" };
		for (int c = 0; c < 4; c++) {
			sources[c] = find_channel(exr, prefix + names[c]);
		}
	} else {
		sources[0] = sources[1] = sources[2] = find_channel(exr, "Y");
		sources[3] = find_channel(exr, "A");
	}
	if (!sources[0]) {
		return make_error("{}: expected the channels R, G and B, or Y; the first of its {} is '{}'", p_name, exr.channels.size(), exr.channels[0].name);
	}
	Image image{ ImageFormat::RGBA32F, exr.width, exr.height, {} };
	const size_t count = size_t(exr.width) * exr.height;
	image.texels.resize(count * 16);
	for (size_t i = 0; i < count; i++) {
		float texel[4];
		for (int c = 0; c < 4; c++) {
			texel[c] = sources[c] ? (*sources[c])[i] : 1.0f;
		}
		std::memcpy(image.texels.data() + i * 16, texel, 16);
	}
	return image;
}

} // namespace

Status check_image_size(uint64_t p_width, uint64_t p_height, const std::string &p_name, uint64_t p_bytes) {
	static constexpr uint64_t MOST_TEXELS_A_BYTE = 16384;
	if (p_width == 0 || p_height == 0) {
		return make_error("{}: the image is empty: {} x {} texels", p_name, p_width, p_height);
	}
	if (p_width > MAX_IMAGE_SIDE_TEXELS || p_height > MAX_IMAGE_SIDE_TEXELS || p_width * p_height > MAX_IMAGE_TEXELS) {
		return make_error("{}: {} x {} texels are more than the limit of {} a side and {} in all", p_name, p_width, p_height, MAX_IMAGE_SIDE_TEXELS, MAX_IMAGE_TEXELS);
	}
	if (p_width * p_height / MOST_TEXELS_A_BYTE > p_bytes) {
		return make_error("{}: broken or truncated: {} bytes can't hold {} x {} texels", p_name, p_bytes, p_width, p_height);
	}
	return Ok();
}

Result<Image> load_image_from_memory(std::span<const std::byte> p_bytes, const std::string &p_name) {
	if (p_bytes.empty()) {
		return make_error("{}: the file is empty, expected a PNG, JPEG, WebP, TGA, BMP, HDR or EXR image", p_name);
	}
	if (begins_with(p_bytes, "\x89PNG")) {
		return load_png(p_bytes, p_name);
	}
	if (begins_with(p_bytes, "\xff\xd8\xff")) {
		return load_jpeg(p_bytes, p_name);
	}
	if (begins_with(p_bytes, "RIFF") && p_bytes.size() >= 12 && begins_with(p_bytes.subspan(8), "WEBP")) {
		return load_webp(p_bytes, p_name);
	}
	if (begins_with(p_bytes, "#?RADIANCE") || begins_with(p_bytes, "#?RGBE")) {
		return load_hdr(p_bytes, p_name);
	}
	if (begins_with(p_bytes, "\x76\x2f\x31\x01")) {
		return load_exr(p_bytes, p_name);
	}
	if (begins_with(p_bytes, "BM")) {
		return load_with_stb(p_bytes, p_name, "BMP");
	}
	if (path_extension(p_name) == "tga") { // the one kind without a mark of its own
		return load_with_stb(p_bytes, p_name, "TGA");
	}
	return make_error("{}: expected a PNG, JPEG, WebP, TGA, BMP, HDR or EXR image, found another kind of file", p_name);
}

Result<Image> load_image(const std::string &p_path) {
	const Result<std::vector<std::byte>> bytes = read_file(p_path);
	if (!bytes) {
		return bytes.error();
	}
	return load_image_from_memory(bytes.value(), p_path);
}

Status write_png(const std::string &p_path, uint32_t p_width, uint32_t p_height, uint32_t p_channels, std::span<const uint8_t> p_values) {
	ERR_FAIL_COND_V_MSG(p_channels != 1 && p_channels != 3 && p_channels != 4, make_error("{}: a PNG has 1, 3 or 4 channels, not {}", p_path, p_channels), "unsupported channel count {}", p_channels);
	if (p_width == 0 || p_height == 0 || uint64_t(p_width) * p_height > MAX_IMAGE_TEXELS) {
		return make_error("{}: cannot write a PNG of {} x {} texels", p_path, p_width, p_height);
	}
	INVARIANT(p_values.size() == size_t(p_width) * p_height * p_channels, "{} values for {} x {} x {}", p_values.size(), p_width, p_height, p_channels);
	std::vector<std::byte> file;
	const auto append = [](void *p_context, void *p_data, int p_size) {
		const std::byte *data = static_cast<const std::byte *>(p_data);
		std::vector<std::byte> &bytes = *static_cast<std::vector<std::byte> *>(p_context);
		bytes.insert(bytes.end(), data, data + p_size);
	};
	if (!stbi_write_png_to_func(append, &file, int(p_width), int(p_height), int(p_channels), p_values.data(), int(p_width * p_channels))) {
		return make_error("{}: out of memory while compressing", p_path);
	}
	return write_file(p_path, file);
}

} // namespace lucent
