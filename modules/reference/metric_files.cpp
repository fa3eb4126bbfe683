// SPDX-License-Identifier: MIT
#include "modules/reference/metric_files.h"

#include "modules/image/image_io.h"
#include "servers/core/file_io.h"
#include "servers/core/math_types.h"

#include <algorithm>
#include <cstring>

namespace lucent {

namespace {

// Three channels of a layer, also where a part or view stands before its name ("ViewLayer.Emit.R").
bool find_layer(const ExrImage &p_image, const std::string &p_layer, const ExrChannel *(&r_channels)[3]) {
	const std::string stem = p_layer.empty() ? "" : p_layer + ".";
	for (const std::string_view letters : { "RGB", "XYZ" }) {
		for (size_t c = 0; c < 3; c++) {
			const std::string name = stem + letters[c];
			r_channels[c] = p_image.find(name);
			for (size_t i = 0; !r_channels[c] && !stem.empty() && i < p_image.channels.size(); i++) {
				r_channels[c] = p_image.channels[i].name.ends_with("." + name) ? &p_image.channels[i] : nullptr;
			}
		}
		if (r_channels[0] && r_channels[1] && r_channels[2]) {
			return true;
		}
	}
	return false;
}

bool find_color(const ExrImage &p_image, const ExrChannel *(&r_channels)[3]) {
	return find_layer(p_image, "", r_channels) || find_layer(p_image, "Combined", r_channels);
}

std::string layer_list(const ExrImage &p_image) {
	std::string list;
	for (const ExrChannel &channel : p_image.channels) {
		list += (list.empty() ? "" : ", ") + channel.name;
	}
	return list;
}

Status add_layer(const std::string &p_path, const ExrImage &p_image, const std::string &p_layer, float p_sign, MetricImage &r_image) {
	const ExrChannel *channels[3] = {};
	if (!(p_layer == "color" ? find_color(p_image, channels) : find_layer(p_image, p_layer, channels))) {
		return make_error("{}: has no layer '{}' of three channels; its channels are {}", p_path, p_layer, layer_list(p_image));
	}
	for (size_t i = 0; i < r_image.values.size(); i++) {
		r_image.values[i] += p_sign * channels[i % 3]->values[i / 3];
	}
	return Ok();
}

Result<MetricImage> load_exr(const std::string &p_path, const std::string &p_layers) {
	const Result<ExrImage> file = read_exr_layers(p_path);
	if (!file) {
		return file.error();
	}
	MetricImage image = { file.value().width, file.value().height, {} };
	image.values.resize(3 * image.pixel_count());
	size_t start = 0;
	float sign = 1.0f;
	const std::string layers = p_layers.empty() ? "color" : p_layers;
	while (start <= layers.size()) {
		const size_t end = std::min(layers.find_first_of("+-", start), layers.size());
		if (end == start) {
			return make_error("{}: expected a layer's name in '{}' where there is none", p_path, p_layers);
		}
		if (const Status status = add_layer(p_path, file.value(), layers.substr(start, end - start), sign, image); !status) {
			return status.error();
		}
		sign = end < layers.size() && layers[end] == '-' ? -1.0f : 1.0f;
		start = end + 1;
	}
	return image;
}

} // namespace

Result<MetricImage> load_metric_image(const std::string &p_path, const std::string &p_layers) {
	if (path_extension(p_path) == "exr") {
		return load_exr(p_path, p_layers);
	}
	if (!p_layers.empty()) {
		return make_error("{}: only .exr files have layers ('{}')", p_path, p_layers);
	}
	const Result<Image> file = load_image(p_path);
	if (!file) {
		return file.error();
	}
	const Image &source = file.value();
	MetricImage image = { source.width, source.height, {} };
	image.values.resize(3 * image.pixel_count());
	for (size_t i = 0; i < image.values.size(); i++) {
		const std::byte *texel = source.texels.data() + (i / 3) * source.texel_size_bytes();
		if (source.format == ImageFormat::RGBA8) {
			image.values[i] = srgb_to_linear(float(uint8_t(texel[i % 3])) / 255.0f);
		} else {
			std::memcpy(&image.values[i], texel + (i % 3) * sizeof(float), sizeof(float));
		}
	}
	return image;
}

Result<std::vector<uint8_t>> load_metric_mask(const std::string &p_path, uint32_t p_width, uint32_t p_height) {
	const Result<MetricImage> file = load_metric_image(p_path, "");
	if (!file) {
		return file.error();
	}
	const MetricImage &image = file.value();
	if (image.width != p_width || image.height != p_height) {
		return make_error("{}: the mask is {}x{}, the pictures are {}x{}", p_path, image.width, image.height, p_width, p_height);
	}
	const float half = srgb_to_linear(0.5f);
	std::vector<uint8_t> mask(image.pixel_count());
	for (size_t i = 0; i < mask.size(); i++) {
		mask[i] = std::max({ image.values[3 * i], image.values[3 * i + 1], image.values[3 * i + 2] }) >= half;
	}
	return mask;
}

} // namespace lucent
