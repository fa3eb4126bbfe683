// SPDX-License-Identifier: MIT
#pragma once
// Pictures from files, for comparing.

#include "modules/reference/image_metrics.h"

#include <string>

namespace lucent {

// p_layers "": plain R, G, B or a layer called Combined, of any image file; PNG and JPEG are decoded from sRGB. Else EXR layers
// joined by + and -: "indirect_diffuse+indirect_specular", "color-direct"; "color" is the picture itself.
Result<MetricImage> load_metric_image(const std::string &p_path, const std::string &p_layers);

// A byte a pixel, not 0 where the picture is at least half bright in a channel. Fails where its size is another.
Result<std::vector<uint8_t>> load_metric_mask(const std::string &p_path, uint32_t p_width, uint32_t p_height);

} // namespace lucent
