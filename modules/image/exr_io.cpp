// SPDX-License-Identifier: MIT
// The only file that sees OpenEXR. Its exceptions end here.
#include "modules/image/image_io.h"

#include "servers/core/file_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <half.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <stdexcept>

namespace lucent {

namespace {

// All channels together: 1 GiB.
constexpr uint64_t MAX_EXR_VALUES = uint64_t(1) << 28;
// No compression comes near that: 64 texels a symbol (DWA) times Deflate's 1032.
constexpr uint64_t MAX_TEXELS_A_BYTE = 65536;

class MemoryInput : public Imf::IStream {
public:
	MemoryInput(std::span<const std::byte> p_bytes, const std::string &p_name) :
			Imf::IStream(p_name.c_str()), bytes(p_bytes) {}
	bool read(char *r_data, int p_count) override {
		if (p_count < 0 || uint64_t(p_count) > bytes.size() - position) {
			throw std::runtime_error("the file ends too early");
		}
		std::memcpy(r_data, bytes.data() + position, size_t(p_count));
		position += uint64_t(p_count);
		return position < bytes.size();
	}
	uint64_t tellg() override { return position; }
	void seekg(uint64_t p_position) override {
		if (p_position > bytes.size()) {
			throw std::runtime_error("an offset points past the end of the file");
		}
		position = p_position;
	}

private:
	std::span<const std::byte> bytes;
	uint64_t position = 0;
};

class MemoryOutput : public Imf::OStream {
public:
	MemoryOutput() :
			Imf::OStream("memory") {}
	void write(const char *p_data, int p_count) override {
		if (bytes.size() < position + uint64_t(p_count)) {
			bytes.resize(position + uint64_t(p_count));
		}
		std::memcpy(bytes.data() + position, p_data, size_t(p_count));
		position += uint64_t(p_count);
	}
	uint64_t tellp() override { return position; }
	void seekp(uint64_t p_position) override { position = p_position; }

	std::vector<std::byte> bytes;

private:
	uint64_t position = 0;
};

// OpenEXR allocates what an attribute claims to have before it reads: "name\0type\0", size (4 bytes), data; an empty name ends a header,
// an empty header the headers of a file with parts.
void check_attribute_sizes(std::span<const std::byte> p_bytes) {
	const std::string_view text(reinterpret_cast<const char *>(p_bytes.data()), p_bytes.size());
	const bool has_parts = text.size() > 5 && (text[5] & 0x10) != 0;
	size_t position = 8; // magic number, version and flags
	bool header_is_empty = true;
	while (position < text.size()) {
		if (text[position] == '\0') {
			if (!has_parts || header_is_empty) {
				return;
			}
			header_is_empty = true;
			position++;
			continue;
		}
		header_is_empty = false;
		const size_t name_end = text.find('\0', position);
		const size_t type_end = name_end == std::string_view::npos ? name_end : text.find('\0', name_end + 1);
		if (type_end == std::string_view::npos || text.size() - type_end < 5) {
			break;
		}
		uint32_t size = 0;
		std::memcpy(&size, text.data() + type_end + 1, 4);
		const size_t left = text.size() - type_end - 5;
		if (size > left) {
			throw std::runtime_error(fmt::format("an attribute of {} bytes where {} are left", size, left));
		}
		position = type_end + 5 + size;
	}
	throw std::runtime_error("the file ends within its header");
}

struct Window {
	int min_x = 0, min_y = 0;
	uint32_t width = 0, height = 0;
};

Window data_window(const Imf::Header &p_header) {
	const Imath::Box2i &box = p_header.dataWindow();
	const int64_t width = int64_t(box.max.x) - box.min.x + 1;
	const int64_t height = int64_t(box.max.y) - box.min.y + 1;
	if (width <= 0 || height <= 0 || width > MAX_IMAGE_SIDE_TEXELS || height > MAX_IMAGE_SIDE_TEXELS) {
		throw std::runtime_error(fmt::format("{} x {} texels are more than the limit of {} a side", width, height, MAX_IMAGE_SIDE_TEXELS));
	}
	return { box.min.x, box.min.y, uint32_t(width), uint32_t(height) };
}

void read_part(Imf::MultiPartInputFile &p_file, int p_part, size_t p_file_bytes, ExrImage &r_image) {
	const Imf::Header &header = p_file.header(p_part);
	if (header.hasType() && header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE) {
		return; // deep data has no single value a texel
	}
	const Window window = data_window(header);
	if (r_image.channels.empty()) {
		r_image.width = window.width;
		r_image.height = window.height;
	} else if (window.width != r_image.width || window.height != r_image.height) {
		return;
	}
	const std::string prefix = p_file.parts() > 1 && header.hasName() ? header.name() + "." : "";
	const size_t first = r_image.channels.size();
	const uint64_t texels = uint64_t(window.width) * window.height;
	if (texels / MAX_TEXELS_A_BYTE > p_file_bytes) {
		throw std::runtime_error(fmt::format("{} x {} texels cannot come from {} bytes", window.width, window.height, p_file_bytes));
	}
	for (Imf::ChannelList::ConstIterator it = header.channels().begin(); it != header.channels().end(); ++it) {
		if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
			throw std::runtime_error(fmt::format("channel '{}' is subsampled, which is not supported", it.name()));
		}
		if ((r_image.channels.size() + 1) * texels > MAX_EXR_VALUES) {
			throw std::runtime_error(fmt::format("more than the limit of {} values", MAX_EXR_VALUES));
		}
		r_image.channels.push_back({ prefix + it.name(), std::vector<float>(texels) });
	}
	Imf::FrameBuffer frame_buffer;
	size_t index = first;
	for (Imf::ChannelList::ConstIterator it = header.channels().begin(); it != header.channels().end(); ++it) {
		const size_t stride = window.width * sizeof(float);
		char *base = reinterpret_cast<char *>(r_image.channels[index++].values.data());
		frame_buffer.insert(it.name(), Imf::Slice::Make(Imf::FLOAT, base, Imath::V2i(window.min_x, window.min_y), window.width, window.height, sizeof(float), stride));
	}
	Imf::InputPart part(p_file, p_part);
	part.setFrameBuffer(frame_buffer);
	part.readPixels(window.min_y, window.min_y + int(window.height) - 1);
}

} // namespace

const ExrChannel *ExrImage::find(const std::string &p_name) const {
	for (const ExrChannel &channel : channels) {
		if (channel.name == p_name) {
			return &channel;
		}
	}
	return nullptr;
}

Result<ExrImage> read_exr_layers_from_memory(std::span<const std::byte> p_bytes, const std::string &p_name) {
	ExrImage image;
	try {
		Imf::Header::setMaxImageSize(int(MAX_IMAGE_SIDE_TEXELS), int(MAX_IMAGE_SIDE_TEXELS));
		Imf::Header::setMaxTileSize(int(MAX_IMAGE_SIDE_TEXELS), int(MAX_IMAGE_SIDE_TEXELS));
		check_attribute_sizes(p_bytes);
		MemoryInput input(p_bytes, p_name);
		Imf::MultiPartInputFile file(input, 0, false);
		for (int part = 0; part < file.parts(); part++) {
			read_part(file, part, p_bytes.size(), image);
		}
	} catch (const std::exception &exception) {
		return make_error("{}: broken or truncated EXR ({})", p_name, exception.what());
	}
	if (image.channels.empty()) {
		return make_error("{}: expected an EXR with at least one flat channel", p_name);
	}
	return image;
}

Result<ExrImage> read_exr_layers(const std::string &p_path) {
	const Result<std::vector<std::byte>> bytes = read_file(p_path);
	if (!bytes) {
		return bytes.error();
	}
	return read_exr_layers_from_memory(bytes.value(), p_path);
}

Status write_exr(const std::string &p_path, uint32_t p_width, uint32_t p_height, std::span<const ExrLayer> p_layers) {
	if (p_width == 0 || p_height == 0 || p_width > MAX_IMAGE_SIDE_TEXELS || p_height > MAX_IMAGE_SIDE_TEXELS) {
		return make_error("{}: cannot write an EXR of {} x {} texels", p_path, p_width, p_height);
	}
	MemoryOutput output;
	std::deque<std::vector<Imath::half>> halves; // what slices of half layers point to
	try {
		Imf::Header header{ int(p_width), int(p_height) };
		header.compression() = Imf::ZIP_COMPRESSION;
		Imf::FrameBuffer frame_buffer;
		for (const ExrLayer &layer : p_layers) {
			const size_t count = layer.channels.size();
			INVARIANT(layer.values.size() == size_t(p_width) * p_height * count, "layer '{}': {} values for {} x {} x {}", layer.name, layer.values.size(), p_width, p_height, count);
			const Imf::PixelType type = layer.half ? Imf::HALF : Imf::FLOAT;
			const size_t size = layer.half ? sizeof(Imath::half) : sizeof(float);
			// OpenEXR only reads through an output slice's pointer.
			char *base = const_cast<char *>(reinterpret_cast<const char *>(layer.values.data()));
			if (layer.half) {
				base = reinterpret_cast<char *>(halves.emplace_back(layer.values.begin(), layer.values.end()).data());
			}
			for (size_t c = 0; c < count; c++) {
				const std::string name = layer.name.empty() ? layer.channels[c] : layer.name + "." + layer.channels[c];
				header.channels().insert(name, Imf::Channel(type));
				frame_buffer.insert(name, Imf::Slice(type, base + c * size, count * size, count * size * p_width));
			}
		}
		Imf::OutputFile file(output, header, 0);
		file.setFrameBuffer(frame_buffer);
		file.writePixels(int(p_height));
	} catch (const std::exception &exception) {
		return make_error("{}: cannot write: {}", p_path, exception.what());
	}
	return write_file(p_path, output.bytes);
}

} // namespace lucent
