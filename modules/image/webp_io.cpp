// SPDX-License-Identifier: MIT
#include "modules/image/packed_images.h"

#include <webp/decode.h>

namespace lucent {

Result<Image> load_webp(std::span<const std::byte> p_bytes, const std::string &p_name) {
	const uint8_t *bytes = reinterpret_cast<const uint8_t *>(p_bytes.data());
	WebPBitstreamFeatures features;
	if (WebPGetFeatures(bytes, p_bytes.size(), &features) != VP8_STATUS_OK) {
		return make_error("{}: broken WebP header", p_name);
	}
	if (features.has_animation) {
		return make_error("{}: an animated WebP is no texture", p_name);
	}
	if (const Status status = check_image_size(uint64_t(features.width), uint64_t(features.height), p_name); !status) {
		return status.error();
	}
	Image image;
	image.width = uint32_t(features.width);
	image.height = uint32_t(features.height);
	image.texels.resize(size_t(image.width) * image.height * 4);
	if (!WebPDecodeRGBAInto(bytes, p_bytes.size(), reinterpret_cast<uint8_t *>(image.texels.data()), image.texels.size(), int(image.width * 4))) {
		return make_error("{}: broken or truncated WebP data", p_name);
	}
	return image;
}

} // namespace lucent
