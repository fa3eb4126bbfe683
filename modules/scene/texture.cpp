// SPDX-License-Identifier: MIT
#include "modules/scene/texture.h"

#include "servers/core/class_builder.h"

namespace lucent::scene {

int Texture2D::get_width() const {
	const std::shared_ptr<const Image> image = get_image();
	return image ? int(image->width) : 0;
}

int Texture2D::get_height() const {
	const std::shared_ptr<const Image> image = get_image();
	return image ? int(image->height) : 0;
}

TextureRid Texture2D::get_rid(SceneContext &p_context, bool p_srgb) {
	const std::shared_ptr<const Image> image = get_image();
	if (!image || image->is_empty() || !attach(p_context)) {
		return {};
	}
	// Floating-point texels are always linear.
	TextureRid &rid = rids[p_srgb && image->format == ImageFormat::RGBA8];
	if (!rid.is_valid()) {
		rid = p_context.server().texture_2d_create(image, p_srgb && image->format == ImageFormat::RGBA8);
	}
	return rid;
}

void Texture2D::send(SceneContext &p_context) {
	const std::shared_ptr<const Image> image = get_image();
	for (const bool srgb : { false, true }) {
		if (rids[srgb].is_valid() && image && !image->is_empty()) {
			p_context.server().texture_2d_update(rids[srgb], image, srgb && image->format == ImageFormat::RGBA8);
		}
	}
}

void Texture2D::free_server_objects(RenderingServer &p_server) {
	for (TextureRid &rid : rids) {
		if (rid.is_valid()) {
			p_server.free(rid);
			rid = {};
		}
	}
}

void ImageTexture::set_image(std::shared_ptr<const Image> p_image) {
	image = std::move(p_image);
	state_changed();
}

void Texture2D::bind(ClassBuilder<Texture2D> &r_class) {
	r_class.doc("An image that materials and skies read.");
	r_class.method("get_width", &Texture2D::get_width).doc("Width in texels; 0 without an image.");
	r_class.method("get_height", &Texture2D::get_height).doc("Height in texels; 0 without an image.");
}

void ImageTexture::bind(ClassBuilder<ImageTexture> &r_class) {
	r_class.doc("A texture of an image in memory, as loaded from a file.");
}

} // namespace lucent::scene
