// SPDX-License-Identifier: MIT
#include "modules/app/output_files.h"

#include "modules/image/image_io.h"
#include "servers/core/file_io.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lucent {

Status check_writable(const std::string &p_path) {
	struct stat info = {};
	if (stat(p_path.c_str(), &info) == 0 && S_ISDIR(info.st_mode)) {
		return make_error("{}: is a folder", p_path);
	}
	std::string probe = path_folder(p_path) + ".lucent-probe-XXXXXX";
	const int file = mkstemp(probe.data());
	if (file < 0) {
		return make_error("{}: can't be written: {}", p_path, std::strerror(errno));
	}
	close(file);
	unlink(probe.c_str());
	return Ok();
}

static Status write_display_picture(RenderingServer &p_server, ViewportRid p_viewport, const std::string &p_path) {
	const ViewportImage image = p_server.viewport_get_image(p_viewport, ViewportBuffer::COLOR_DISPLAY);
	std::vector<uint8_t> values(image.values.size());
	std::transform(image.values.begin(), image.values.end(), values.begin(), [](float p_value) {
		return uint8_t((p_value > 0.0f ? std::min(p_value, 1.0f) : 0.0f) * 255.0f + 0.5f); // NaN is black
	});
	return write_png(p_path, image.width, image.height, image.channels, values);
}

// In AOV_NAMES' order.
static constexpr ViewportBuffer AOV_BUFFERS[] = { ViewportBuffer::DIRECT, ViewportBuffer::INDIRECT_DIFFUSE, ViewportBuffer::INDIRECT_SPECULAR, ViewportBuffer::EMISSION, ViewportBuffer::ALBEDO, ViewportBuffer::NORMAL, ViewportBuffer::DEPTH, ViewportBuffer::MOTION };
static_assert(std::size(AOV_BUFFERS) == std::size(AOV_NAMES));

static std::vector<std::string> channel_names(const std::string &p_layer, uint32_t p_channels) {
	if (p_layer == "depth") {
		return { "Z" };
	}
	const bool vector = p_layer == "normal" || p_layer == "motion";
	const std::array<std::string, 3> names = vector ? std::array<std::string, 3>{ "X", "Y", "Z" } : std::array<std::string, 3>{ "R", "G", "B" };
	return { names.begin(), names.begin() + std::min<uint32_t>(p_channels, 3) };
}

static Status write_linear_picture(RenderingServer &p_server, ViewportRid p_viewport, const RenderOptions &p_options, const std::string &p_path) {
	std::deque<ViewportImage> images; // what the layers' spans point to
	std::vector<ExrLayer> layers;
	const auto add_layer = [&](const std::string &p_name, ViewportBuffer p_buffer) {
		const ViewportImage &image = images.emplace_back(p_server.viewport_get_image(p_viewport, p_buffer));
		layers.push_back({ p_name, channel_names(p_name, image.channels), image.values });
	};
	add_layer("", ViewportBuffer::COLOR_LINEAR);
	for (const std::string &aov : p_options.aovs) {
		const auto *const name = std::find(std::begin(AOV_NAMES), std::end(AOV_NAMES), aov);
		add_layer(aov, AOV_BUFFERS[name - std::begin(AOV_NAMES)]);
	}
	return write_exr(p_path, images.front().width, images.front().height, layers);
}

Status write_pictures(RenderingServer &p_server, ViewportRid p_viewport, const RenderOptions &p_options) {
	for (const std::string &path : p_options.outputs) {
		const Status status = path_extension(path) == "png" ? write_display_picture(p_server, p_viewport, path) : write_linear_picture(p_server, p_viewport, p_options, path);
		if (!status) {
			return status;
		}
	}
	return Ok();
}

} // namespace lucent
