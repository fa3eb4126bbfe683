// SPDX-License-Identifier: MIT
#pragma once

namespace lucent::scene {

// Makes ResourceLoader read pictures (.png, .jpg, .jpeg, .webp, .tga, .bmp, .hdr, .exr) into ImageTextures.
void register_image_loaders();

} // namespace lucent::scene
