// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/scene_context.h"
#include "servers/core/image.h"

namespace lucent::scene {

// An image that materials and skies read.
class Texture2D : public ServerResource {
	LUCENT_CLASS(Texture2D, Resource)
public:
	~Texture2D() override { leave_context(); }

	// Null: nothing to show.
	virtual std::shared_ptr<const Image> get_image() const { return nullptr; }
	int get_width() const;
	int get_height() const;
	// p_srgb: the user reads RGBA8 texels as sRGB-encoded colour. One image can serve as both; each has a server object of its own.
	// Invalid: no image.
	TextureRid get_rid(SceneContext &p_context, bool p_srgb);

protected:
	void send(SceneContext &p_context) override;
	void free_server_objects(RenderingServer &p_server) override;

private:
	TextureRid rids[2]; // by p_srgb; made when first asked for
};

// A texture of an image in memory.
class ImageTexture : public Texture2D {
	LUCENT_CLASS(ImageTexture, Texture2D)
public:
	ImageTexture() = default;
	explicit ImageTexture(std::shared_ptr<const Image> p_image) :
			image(std::move(p_image)) {}

	std::shared_ptr<const Image> get_image() const override { return image; }
	void set_image(std::shared_ptr<const Image> p_image);

private:
	std::shared_ptr<const Image> image;
};

} // namespace lucent::scene
