// SPDX-License-Identifier: MIT
// Pictures, the kind told by the first bytes as everywhere; what has no known ones is tried as .tga.
#include "modules/image/image_io.h"

#include <cstdlib>

using namespace lucent;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *p_data, size_t p_size) {
	const Result<Image> image = load_image_from_memory(std::as_bytes(std::span(p_data, p_size)), "fuzz.tga");
	if (image) {
		const Image &read = image.value();
		if (read.is_empty() || read.texels.size() != size_t(read.texel_size_bytes()) * read.width * read.height) {
			std::abort();
		}
	}
	return 0;
}
