// SPDX-License-Identifier: MIT
#include "modules/image/packed_images.h"

#include <cstring>
#include <vector>

#include <png.h>

namespace lucent {

namespace {

struct Source {
	std::span<const std::byte> bytes;
	size_t position = 0;
	char message[128] = "";
};

void read_bytes(png_structp p_png, png_bytep r_data, size_t p_size) {
	Source &source = *static_cast<Source *>(png_get_io_ptr(p_png));
	if (p_size > source.bytes.size() - source.position) {
		png_error(p_png, "the file ends too early");
	}
	std::memcpy(r_data, source.bytes.data() + source.position, p_size);
	source.position += p_size;
}

void fail(png_structp p_png, png_const_charp p_message) {
	Source &source = *static_cast<Source *>(png_get_error_ptr(p_png));
	std::strncpy(source.message, p_message, sizeof(source.message) - 1);
	png_longjmp(p_png, 1);
}

// No destructor may be between setjmp and longjmp: all memory is the caller's. False: see the source's message.
bool decode(png_structp p_png, png_infop p_info, Source &r_source, Image &r_image, std::vector<png_bytep> &r_rows, bool &r_too_large) {
	if (setjmp(png_jmpbuf(p_png))) {
		return false;
	}
	png_set_read_fn(p_png, &r_source, read_bytes);
	png_set_user_limits(p_png, 0x7fffffff, 0x7fffffff); // ours are checked below
	png_set_chunk_malloc_max(p_png, 64u << 20);
	png_read_info(p_png, p_info);
	r_image.width = png_get_image_width(p_png, p_info);
	r_image.height = png_get_image_height(p_png, p_info);
	r_too_large = !check_image_size(r_image.width, r_image.height, "", r_source.bytes.size()).ok();
	if (r_too_large) {
		return false;
	}
	png_set_expand(p_png); // palettes, few bits, transparent colours
	png_set_scale_16(p_png);
	png_set_gray_to_rgb(p_png);
	png_set_add_alpha(p_png, 0xff, PNG_FILLER_AFTER);
	png_set_interlace_handling(p_png);
	png_read_update_info(p_png, p_info);
	const size_t row_bytes = png_get_rowbytes(p_png, p_info);
	if (row_bytes != size_t(r_image.width) * 4) {
		png_error(p_png, "an unknown kind of texels");
	}
	r_image.texels.resize(row_bytes * r_image.height);
	r_rows.resize(r_image.height);
	for (uint32_t y = 0; y < r_image.height; y++) {
		r_rows[y] = reinterpret_cast<png_bytep>(r_image.texels.data()) + row_bytes * y;
	}
	png_read_image(p_png, r_rows.data());
	png_read_end(p_png, nullptr);
	return true;
}

} // namespace

Result<Image> load_png(std::span<const std::byte> p_bytes, const std::string &p_name) {
	Source source{ p_bytes };
	png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, fail, [](png_structp, png_const_charp) {});
	png_infop info = png ? png_create_info_struct(png) : nullptr;
	if (!info) {
		png_destroy_read_struct(&png, nullptr, nullptr);
		return make_error("{}: cannot read PNG files: out of memory", p_name);
	}
	Image image;
	std::vector<png_bytep> rows;
	bool too_large = false;
	const bool done = decode(png, info, source, image, rows, too_large);
	png_destroy_read_struct(&png, &info, nullptr);
	if (too_large) {
		return check_image_size(image.width, image.height, p_name, p_bytes.size()).error();
	}
	return done ? Result<Image>(std::move(image)) : Result<Image>(make_error("{}: broken or truncated PNG data ({})", p_name, source.message));
}

} // namespace lucent
