// SPDX-License-Identifier: MIT
#include "modules/image/packed_images.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include <jerror.h>
#include <jpeglib.h>

namespace lucent {

namespace {

// A progressive file of a few kilobytes can ask for a day of work: every scan visits every block.
constexpr int MAX_SCANS = 512;
constexpr uint64_t MAX_SCANNED_TEXELS = uint64_t(1) << 32; // 32 scans of the largest image

struct Decoder {
	jpeg_decompress_struct state;
	jpeg_error_mgr errors;
	jpeg_progress_mgr progress;
	std::jmp_buf failed;
	char message[JMSG_LENGTH_MAX] = "";
};

Decoder &decoder_of(j_common_ptr p_state) {
	return *static_cast<Decoder *>(p_state->client_data);
}

void stop(j_common_ptr p_state) {
	Decoder &decoder = decoder_of(p_state);
	p_state->err->format_message(p_state, decoder.message);
	std::longjmp(decoder.failed, 1);
}

// Warnings (-1) mean lost data, but for stray bytes between segments and odd application markers.
void note(j_common_ptr p_state, int p_level) {
	const int code = p_state->err->msg_code;
	if (p_level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_ADOBE_XFORM && code != JWRN_JFIF_MAJOR) {
		stop(p_state);
	}
}

void check_scans(j_common_ptr p_state) {
	const jpeg_decompress_struct &state = decoder_of(p_state).state;
	const int scans = state.input_scan_number;
	if (scans > MAX_SCANS || uint64_t(scans) * state.image_width * state.image_height > MAX_SCANNED_TEXELS) {
		std::snprintf(decoder_of(p_state).message, JMSG_LENGTH_MAX, "more scans than an image of this size has: %d", scans);
		std::longjmp(decoder_of(p_state).failed, 1);
	}
}

// Four bytes a texel of CMYK, as Adobe writes them: inverted.
void cmyk_to_rgba(std::span<uint8_t> r_texels) {
	for (size_t i = 0; i + 3 < r_texels.size(); i += 4) {
		for (size_t c = 0; c < 3; c++) {
			r_texels[i + c] = uint8_t(r_texels[i + c] * r_texels[i + 3] / 255);
		}
		r_texels[i + 3] = 255;
	}
}

// No destructor may be between setjmp and longjmp: all memory is the caller's. False: see message.
bool decode(Decoder &r_decoder, std::span<const std::byte> p_bytes, Image &r_image, bool &r_too_large) {
	jpeg_decompress_struct &state = r_decoder.state;
	if (setjmp(r_decoder.failed)) {
		return false;
	}
	jpeg_mem_src(&state, reinterpret_cast<const unsigned char *>(p_bytes.data()), p_bytes.size());
	jpeg_read_header(&state, TRUE);
	r_image.width = state.image_width;
	r_image.height = state.image_height;
	r_too_large = !check_image_size(state.image_width, state.image_height, "", p_bytes.size()).ok();
	if (r_too_large) {
		return false;
	}
	const bool is_cmyk = state.jpeg_color_space == JCS_CMYK || state.jpeg_color_space == JCS_YCCK;
	state.out_color_space = is_cmyk ? JCS_CMYK : JCS_EXT_RGBA;
	jpeg_start_decompress(&state);
	r_image.texels.resize(size_t(state.output_width) * state.output_height * 4);
	uint8_t *texels = reinterpret_cast<uint8_t *>(r_image.texels.data());
	while (state.output_scanline < state.output_height) {
		JSAMPROW row = texels + size_t(state.output_scanline) * state.output_width * 4;
		jpeg_read_scanlines(&state, &row, 1);
	}
	jpeg_finish_decompress(&state);
	if (is_cmyk) {
		cmyk_to_rgba({ texels, r_image.texels.size() });
	}
	return true;
}

} // namespace

Result<Image> load_jpeg(std::span<const std::byte> p_bytes, const std::string &p_name) {
	Decoder decoder = {};
	decoder.state.err = jpeg_std_error(&decoder.errors);
	decoder.errors.error_exit = stop;
	decoder.errors.emit_message = note;
	decoder.errors.output_message = [](j_common_ptr) {};
	decoder.state.client_data = &decoder;
	if (setjmp(decoder.failed)) {
		return make_error("{}: cannot read JPEG files: {}", p_name, decoder.message);
	}
	jpeg_create_decompress(&decoder.state);
	decoder.progress.progress_monitor = check_scans;
	decoder.state.progress = &decoder.progress;
	Image image;
	bool too_large = false;
	const bool done = decode(decoder, p_bytes, image, too_large);
	jpeg_destroy_decompress(&decoder.state);
	if (too_large) {
		return check_image_size(image.width, image.height, p_name, p_bytes.size()).error();
	}
	return done ? Result<Image>(std::move(image)) : Result<Image>(make_error("{}: broken or truncated JPEG data ({})", p_name, decoder.message));
}

} // namespace lucent
