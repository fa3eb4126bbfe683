// SPDX-License-Identifier: MIT
#include "modules/image/image_io.h"
#include "servers/core/file_io.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace {

using namespace lucent;

// A folder of its own that goes away with the test.
struct TemporaryFolder {
	std::string path = (std::filesystem::temp_directory_path() / fmt::format("lucent_image_{}", ::getpid())).string() + "/";
	TemporaryFolder() { std::filesystem::create_directories(path); }
	~TemporaryFolder() {
		std::error_code ignored;
		std::filesystem::remove_all(path, ignored);
	}
	size_t file_count() const { return size_t(std::distance(std::filesystem::directory_iterator(path), {})); }
};

std::vector<std::byte> to_bytes(std::string_view p_text) {
	const std::byte *data = reinterpret_cast<const std::byte *>(p_text.data());
	return { data, data + p_text.size() };
}

float float_at(const Image &p_image, size_t p_texel, size_t p_channel) {
	float value = 0.0f;
	std::memcpy(&value, p_image.texels.data() + p_texel * 16 + p_channel * 4, 4);
	return value;
}

bool contains(const std::string &p_text, const std::string &p_part) {
	return p_text.find(p_part) != std::string::npos;
}

// 8 x 8 texels of grey: one block whose coefficients are all zero.
std::vector<std::byte> tiny_jpeg() {
	std::string file("\xff\xd8\xff\xdb\0\x43\0", 7);
	file += std::string(64, '\1');
	file += std::string("\xff\xc0\0\x0b\x08\0\x08\0\x08\1\1\x11\0", 13);
	for (const char table : { '\0', '\x10' }) { // one code, "0", for "nothing"
		file += std::string("\xff\xc4\0\x14", 4) + table + '\1' + std::string(15, '\0') + '\0';
	}
	file += std::string("\xff\xda\0\x08\1\1\0\0\x3f\0\x3f\xff\xd9", 13);
	return to_bytes(file);
}

} // namespace

TEST_CASE("PNG: RGB and RGBA come back as they were written, twice the same bytes") {
	const TemporaryFolder folder;
	std::vector<uint8_t> rgba(7 * 5 * 4), rgb(7 * 5 * 3);
	for (size_t i = 0; i < rgba.size(); i++) {
		rgba[i] = uint8_t(i * 37);
	}
	for (size_t i = 0; i < rgb.size(); i++) {
		rgb[i] = uint8_t(i * 11);
	}
	REQUIRE(write_png(folder.path + "a.png", 7, 5, 4, rgba).ok());
	REQUIRE(write_png(folder.path + "b.png", 7, 5, 3, rgb).ok());
	REQUIRE(write_png(folder.path + "c.png", 7, 5, 4, rgba).ok());
	CHECK(read_file(folder.path + "a.png").value() == read_file(folder.path + "c.png").value());
	const Image a = load_image(folder.path + "a.png").take();
	CHECK(a.format == ImageFormat::RGBA8);
	REQUIRE(a.texels.size() == rgba.size());
	CHECK(std::memcmp(a.texels.data(), rgba.data(), rgba.size()) == 0);
	const Image b = load_image(folder.path + "b.png").take();
	REQUIRE(b.width == 7);
	REQUIRE(b.height == 5);
	CHECK(uint8_t(b.texels[4 * 9 + 2]) == rgb[3 * 9 + 2]);
	CHECK(uint8_t(b.texels[4 * 9 + 3]) == 255);
	CHECK(folder.file_count() == 3);
}

TEST_CASE("EXR: layers come back exactly, the main one is the picture") {
	const TemporaryFolder folder;
	const std::vector<float> main = { 0.1f, 2000.0f, -1.0f, 3e-8f, 5.0f, 6.0f };
	const std::vector<float> direct = { 1, 2, 3, 4, 5, 6 };
	const std::vector<float> depth = { 10.5f, INFINITY };
	const ExrLayer layers[] = { { "", { "R", "G", "B" }, main }, { "direct", { "R", "G", "B" }, direct }, { "depth", { "Z" }, depth } };
	REQUIRE(write_exr(folder.path + "a.exr", 2, 1, layers).ok());
	REQUIRE(write_exr(folder.path + "b.exr", 2, 1, layers).ok());
	CHECK(read_file(folder.path + "a.exr").value() == read_file(folder.path + "b.exr").value());
	const ExrImage exr = read_exr_layers(folder.path + "a.exr").take();
	CHECK(exr.channels.size() == 7);
	REQUIRE(exr.find("direct.G"));
	CHECK(exr.find("direct.G")->values == std::vector<float>{ 2, 5 });
	CHECK(exr.find("depth.Z")->values == depth);
	CHECK(exr.find("R")->values == std::vector<float>{ 0.1f, 3e-8f });
	const Image image = load_image(folder.path + "a.exr").take();
	CHECK(image.format == ImageFormat::RGBA32F);
	CHECK(float_at(image, 0, 1) == 2000.0f);
	CHECK(float_at(image, 1, 3) == 1.0f);
}

TEST_CASE("EXR: Y is grey, a layered picture is found, other channels are refused by name") {
	const TemporaryFolder folder;
	const std::vector<float> one = { 0.25f };
	const std::vector<float> three = { 1, 2, 3 };
	const ExrLayer grey[] = { { "", { "Y" }, one } };
	const ExrLayer layered[] = { { "depth", { "Z" }, one }, { "View.Combined", { "R", "G", "B" }, three } };
	const ExrLayer depth[] = { { "depth", { "Z" }, one } };
	REQUIRE(write_exr(folder.path + "grey.exr", 1, 1, grey).ok());
	REQUIRE(write_exr(folder.path + "layered.exr", 1, 1, layered).ok());
	REQUIRE(write_exr(folder.path + "depth.exr", 1, 1, depth).ok());
	CHECK(float_at(load_image(folder.path + "grey.exr").take(), 0, 2) == 0.25f);
	CHECK(float_at(load_image(folder.path + "layered.exr").take(), 0, 2) == 3.0f);
	const Result<Image> refused = load_image(folder.path + "depth.exr");
	REQUIRE(!refused.ok());
	CHECK(contains(refused.error().message, "depth.exr: expected the channels R, G and B, or Y"));
}

TEST_CASE("EXR: an attribute that claims more than the file holds is refused before it is allocated") {
	const TemporaryFolder folder;
	const std::vector<float> values(4 * 4 * 3, 0.5f);
	const ExrLayer layers[] = { { "", { "R", "G", "B" }, values } };
	REQUIRE(write_exr(folder.path + "a.exr", 4, 4, layers).ok());
	std::vector<std::byte> file = read_file(folder.path + "a.exr").take();
	const std::string type = "chlist";
	const auto found = std::search(file.begin(), file.end(), type.begin(), type.end(), [](std::byte p_a, char p_b) { return char(p_a) == p_b; });
	REQUIRE(found != file.end());
	const uint32_t claimed = 0x7FFFFFFF;
	std::memcpy(&*found + type.size() + 1, &claimed, 4);
	const Result<Image> image = load_image_from_memory(file, "a.exr");
	REQUIRE(!image.ok());
	CHECK(contains(image.error().message, "a.exr: broken or truncated EXR (an attribute of 2147483647 bytes where"));
}

TEST_CASE("HDR: RGBE texels are decoded") {
	std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
	file += std::string("\x80\x40\x20\x81", 4) + std::string("\0\0\0\0", 4);
	const Image image = load_image_from_memory(to_bytes(file), "a.hdr").take();
	REQUIRE(image.width == 2);
	CHECK(float_at(image, 0, 0) == doctest::Approx(1.0f));
	CHECK(float_at(image, 0, 1) == doctest::Approx(0.5f));
	CHECK(float_at(image, 1, 0) == 0.0f);
}

TEST_CASE("HDR: run-length encoded rows are decoded, cut ones are an error") {
	const std::string header = "#?RADIANCE\n# comment\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 9\n";
	// Red: 9 times 128. Green: 8 times 64, then 32. Blue: 9 single values. Exponent: 9 times 129.
	const std::string row = std::string("\2\2\0\11", 4) + "\x89\x80" + "\x88\x40\x01\x20" + "\x09" + std::string("\0\1\2\3\4\5\6\7\x10", 9) + "\x89\x81";
	const Image image = load_image_from_memory(to_bytes(header + row), "a.hdr").take();
	CHECK(float_at(image, 8, 0) == 1.0f);
	CHECK(float_at(image, 7, 1) == 0.5f);
	CHECK(float_at(image, 8, 1) == 0.25f);
	CHECK(float_at(image, 8, 2) == 0.125f);
	for (size_t size = 0; size < row.size(); size++) {
		CHECK(!load_image_from_memory(to_bytes(header + row.substr(0, size)), "a.hdr").ok());
	}
	CHECK(!load_image_from_memory(to_bytes(header + "\2\2" + std::string("\0\11", 2) + std::string(60, '\xff')), "a.hdr").ok());
}

TEST_CASE("JPEG: a grey picture is decoded, a cut one is an error") {
	const std::vector<std::byte> whole = tiny_jpeg();
	const Image image = load_image_from_memory(whole, "a.jpg").take();
	CHECK(image.width == 8);
	CHECK(image.height == 8);
	CHECK(int(image.texels[0]) == doctest::Approx(128).epsilon(0.02));
	CHECK(int(image.texels[3]) == 255);
	for (size_t size = 3; size < whole.size(); size += 7) {
		const Result<Image> cut = load_image_from_memory(std::span(whole).first(size), "a.jpg");
		CHECK_MESSAGE(!cut.ok(), "cut to " << size);
	}
}

TEST_CASE("JPEG: a few bytes don't ask for half a gigabyte") {
	std::vector<std::byte> file = tiny_jpeg();
	const std::byte marker[] = { std::byte(0xFF), std::byte(0xC0) };
	const auto frame = std::search(file.begin(), file.end(), std::begin(marker), std::end(marker));
	REQUIRE(file.end() - frame > 9);
	std::fill(frame + 5, frame + 9, std::byte(0x2D)); // 11565 x 11565
	const Result<Image> image = load_image_from_memory(file, "a.jpg");
	REQUIRE(!image.ok());
	CHECK(contains(image.error().message, "bytes can't hold 11565 x 11565 texels"));
}

TEST_CASE("JPEG: a Huffman table of more codes than there are is an error") {
	std::vector<std::byte> file = tiny_jpeg();
	const std::byte marker[] = { std::byte(0xFF), std::byte(0xC4) };
	const auto table = std::search(file.begin(), file.end(), std::begin(marker), std::end(marker));
	REQUIRE(table != file.end());
	std::fill(table + 5, table + 21, std::byte(255));
	const Result<Image> image = load_image_from_memory(file, "a.jpg");
	REQUIRE(!image.ok());
	CHECK(contains(image.error().message, "a.jpg: broken or truncated JPEG data (Bogus Huffman table definition)"));
}

TEST_CASE("BMP, TGA and WebP: two texels, red and half green") {
	// Rows from the bottom, blue first.
	const std::string bmp("BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\1\0\0\0\1\0\x18\0\0\0\0\0\x08\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xff\0\x80\0\0\0", 62);
	const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x18\x20\0\0\xff\0\x80\0", 24);
	for (const auto &[text, name] : { std::pair{ bmp, "a.bmp" }, std::pair{ tga, "a.tga" } }) {
		const Result<Image> image = load_image_from_memory(to_bytes(text), name);
		REQUIRE_MESSAGE(image.ok(), image.error().message);
		CHECK(image.value().width == 2);
		CHECK(image.value().height == 1);
		const Result<Image> cut = load_image_from_memory(to_bytes(text.substr(0, text.size() - 3)), name); // in the last texel
		REQUIRE_FALSE(cut.ok());
		CHECK(contains(cut.error().message, "ends too early"));
		const std::vector<int> expected = { 255, 0, 0, 255, 0, 128, 0, 255 };
		for (size_t i = 0; i < 8; i++) {
			CHECK(int(image.value().texels[i]) == expected[i]);
		}
	}
	CHECK_FALSE(load_image_from_memory(to_bytes(tga), "a.xyz").ok());
	// libwebp's own lossless encoding of the same two texels.
	const std::string webp("RIFF\x1e\0\0\0WEBPVP8L\x11\0\0\0\x2f\1\0\0\0\x0f\x50\xc0\xf9\x8f\xf9\x0f\x43\x46\xf4\x3f\0\0", 38);
	const Result<Image> image = load_image_from_memory(to_bytes(webp), "a.webp");
	REQUIRE_MESSAGE(image.ok(), image.error().message);
	CHECK(image.value().width == 2);
	CHECK(int(image.value().texels[0]) == 255);
	CHECK(int(image.value().texels[5]) == 128);
	CHECK_FALSE(load_image_from_memory(to_bytes(webp.substr(0, 24)), "a.webp").ok());
}

TEST_CASE("A broken image gives one error that names the file") {
	const TemporaryFolder folder;
	const Result<Image> missing = load_image(folder.path + "none.png");
	REQUIRE(!missing.ok());
	CHECK(contains(missing.error().message, "none.png: cannot read: No such file"));
	CHECK(contains(load_image(folder.path).error().message, "folder"));
	CHECK(contains(load_image_from_memory({}, "zero.png").error().message, "zero.png: the file is empty"));
	CHECK(contains(load_image_from_memory(to_bytes("hello"), "text.png").error().message, "text.png: expected a PNG"));

	std::vector<uint8_t> values(64 * 64 * 4);
	for (size_t i = 0; i < values.size(); i++) {
		values[i] = uint8_t(i * i >> 3);
	}
	REQUIRE(write_png(folder.path + "a.png", 64, 64, 4, values).ok());
	const std::vector<float> floats(64 * 64 * 3, 0.5f);
	const ExrLayer layers[] = { { "", { "R", "G", "B" }, floats } };
	REQUIRE(write_exr(folder.path + "a.exr", 64, 64, layers).ok());
	for (const char *name : { "a.png", "a.exr" }) {
		const std::vector<std::byte> whole = read_file(folder.path + name).take();
		REQUIRE(load_image_from_memory(whole, name).ok());
		for (size_t size = 4; size < whole.size() - 16; size += 1 + size / 7) {
			const Result<Image> cut = load_image_from_memory(std::span(whole).first(size), name);
			CHECK_MESSAGE(!cut.ok(), name << " cut to " << size);
			CHECK(contains(cut.error().message, name));
		}
	}
}

TEST_CASE("An image of 100000 x 100000 texels is refused before it is allocated") {
	const TemporaryFolder folder;
	const std::vector<uint8_t> grey(1);
	REQUIRE(write_png(folder.path + "a.png", 1, 1, 1, grey).ok());
	std::vector<std::byte> png = read_file(folder.path + "a.png").take();
	const uint8_t side[] = { 0, 1, 0x86, 0xa0, 0, 1, 0x86, 0xa0 };
	std::memcpy(png.data() + 16, side, 8);
	CHECK(!load_image_from_memory(png, "a.png").ok());

	const std::vector<float> one(1);
	const ExrLayer layers[] = { { "", { "Y" }, one } };
	REQUIRE(write_exr(folder.path + "a.exr", 1, 1, layers).ok());
	std::vector<std::byte> exr = read_file(folder.path + "a.exr").take();
	const std::string_view text(reinterpret_cast<const char *>(exr.data()), exr.size());
	const size_t box = text.find("box2i", text.find("dataWindow")) + 6 + 4 + 8;
	const int32_t corner[] = { 99999, 99999 };
	std::memcpy(exr.data() + box, corner, 8);
	CHECK(!load_image_from_memory(exr, "a.exr").ok());

	CHECK(!load_image_from_memory(to_bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n"), "a.hdr").ok());
}

TEST_CASE("An output that cannot be written is an error and leaves nothing behind") {
	const TemporaryFolder folder;
	const std::vector<uint8_t> grey(1);
	const Status no_folder = write_png(folder.path + "none/a.png", 1, 1, 1, grey);
	REQUIRE(!no_folder.ok());
	CHECK(contains(no_folder.error().message, "none/a.png: cannot write: No such file"));
	CHECK(!write_png(folder.path, 1, 1, 1, grey).ok());
	CHECK(!write_png("/dev/full", 1, 1, 1, grey).ok());
	CHECK(folder.file_count() == 0);
	CHECK(write_png("/dev/null", 1, 1, 1, grey).ok());
	CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("Replacing a file through a symbolic link keeps the link") {
	const TemporaryFolder folder;
	REQUIRE(write_file(folder.path + "real", to_bytes("old")).ok());
	std::filesystem::create_symlink("real", folder.path + "link");
	REQUIRE(write_file(folder.path + "link", to_bytes("new")).ok());
	CHECK(std::filesystem::is_symlink(folder.path + "link"));
	CHECK(read_file(folder.path + "real").value() == to_bytes("new"));
	CHECK(folder.file_count() == 2);
}
