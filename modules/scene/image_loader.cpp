// SPDX-License-Identifier: MIT
#include "modules/scene/image_loader.h"

#include "modules/image/image_io.h"
#include "modules/scene/resource_loader.h"
#include "modules/scene/texture.h"

namespace lucent::scene {

static Result<Ref<Resource>> load_texture(const std::string &p_path) {
	Result<Image> image = load_image(p_path);
	if (!image) {
		return image.error();
	}
	return Ref<Resource>(std::make_shared<ImageTexture>(std::make_shared<const Image>(image.take())));
}

void register_image_loaders() {
	for (const char *extension : { "png", "jpg", "jpeg", "webp", "tga", "bmp", "hdr", "exr" }) {
		ResourceLoader::register_loader(extension, load_texture);
	}
}

} // namespace lucent::scene
