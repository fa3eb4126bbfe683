// SPDX-License-Identifier: MIT
#include "modules/image/hdr_io.h"

#include "modules/image/image_io.h"

#include <cmath>
#include <cstdio>
#include <cstring>

namespace lucent {

namespace {

class HdrReader {
public:
	HdrReader(std::span<const std::byte> p_bytes, const std::string &p_name) :
			bytes(p_bytes), name(p_name) {}

	Result<Image> load();

private:
	std::string read_line();
	size_t left() const { return bytes.size() - position; }
	uint8_t next() { return uint8_t(bytes[position++]); }
	// False: the data ends or a run passes the end of the row.
	bool read_row(std::vector<uint8_t> &r_row, uint32_t p_width);
	bool read_channel(uint8_t *r_first, uint32_t p_width);

	std::span<const std::byte> bytes;
	const std::string &name;
	size_t position = 0;
};

std::string HdrReader::read_line() {
	std::string line;
	while (left() > 0) {
		const char c = char(next());
		if (c == '\n') {
			break;
		}
		line += c;
	}
	return line;
}

bool HdrReader::read_channel(uint8_t *r_first, uint32_t p_width) {
	uint32_t x = 0;
	while (x < p_width) {
		if (left() < 2) {
			return false;
		}
		uint32_t count = next();
		const bool is_run = count > 128;
		count -= is_run ? 128 : 0;
		if (count == 0 || count > p_width - x || (!is_run && count > left())) {
			return false;
		}
		const uint8_t value = is_run ? next() : 0;
		for (uint32_t i = 0; i < count; i++) {
			r_first[size_t(x++) * 4] = is_run ? value : next();
		}
	}
	return true;
}

bool HdrReader::read_row(std::vector<uint8_t> &r_row, uint32_t p_width) {
	if (left() < 4) {
		return false;
	}
	const uint8_t *start = reinterpret_cast<const uint8_t *>(bytes.data()) + position;
	const bool is_packed = p_width >= 8 && p_width < 32768 && start[0] == 2 && start[1] == 2 && uint32_t(start[2]) * 256 + start[3] == p_width;
	if (!is_packed) {
		if (left() < r_row.size()) {
			return false;
		}
		std::memcpy(r_row.data(), start, r_row.size());
		position += r_row.size();
		return true;
	}
	position += 4;
	for (int channel = 0; channel < 4; channel++) {
		if (!read_channel(r_row.data() + channel, p_width)) {
			return false;
		}
	}
	return true;
}

Result<Image> HdrReader::load() {
	for (std::string line = read_line(); !line.empty(); line = read_line()) {
		if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
			return make_error("{}: expected FORMAT=32-bit_rle_rgbe, found {}", name, line.substr(0, 60));
		}
	}
	const std::string size = read_line();
	unsigned int width = 0, height = 0;
	if (std::sscanf(size.c_str(), "-Y %7u +X %7u", &height, &width) != 2 || width == 0 || height == 0) {
		return make_error("{}: broken HDR header (expected -Y height +X width)", name);
	}
	if (width > MAX_IMAGE_SIDE_TEXELS || height > MAX_IMAGE_SIDE_TEXELS || uint64_t(width) * height > MAX_IMAGE_TEXELS) {
		return make_error("{}: {} x {} texels are more than the limit of {} a side and {} in all", name, width, height, MAX_IMAGE_SIDE_TEXELS, MAX_IMAGE_TEXELS);
	}
	// The shortest rows: a run of up to 127 texels a channel takes 2 bytes.
	const uint64_t least_row = width < 8 ? width * 4 : 4 + 4 * 2 * ((width + 126) / 127);
	if (least_row * height > left()) {
		return make_error("{}: truncated HDR data: {} x {} texels cannot come from {} bytes", name, width, height, left());
	}
	Image image{ ImageFormat::RGBA32F, width, height, {} };
	image.texels.resize(size_t(width) * height * 16);
	std::vector<uint8_t> row(size_t(width) * 4);
	for (uint32_t y = 0; y < height; y++) {
		if (!read_row(row, width)) {
			return make_error("{}: broken or truncated HDR data in row {} of {}", name, y, height);
		}
		for (uint32_t x = 0; x < width; x++) {
			const uint8_t *rgbe = &row[size_t(x) * 4];
			const float scale = rgbe[3] ? std::ldexp(1.0f, int(rgbe[3]) - (128 + 8)) : 0.0f;
			const float texel[4] = { rgbe[0] * scale, rgbe[1] * scale, rgbe[2] * scale, 1.0f };
			std::memcpy(image.texels.data() + (size_t(y) * width + x) * 16, texel, 16);
		}
	}
	return image;
}

} // namespace

Result<Image> load_hdr(std::span<const std::byte> p_bytes, const std::string &p_name) {
	return HdrReader(p_bytes, p_name).load();
}

} // namespace lucent
