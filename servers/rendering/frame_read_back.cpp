// SPDX-License-Identifier: MIT
#include "servers/rendering/frame_renderer.h"

#include <glm/gtc/packing.hpp>

namespace lucent {

namespace {
// Depth of what is infinitely far away, m.
constexpr float BACKGROUND_DEPTH_M = 1e10f;

// Halves of p_from_channels a texel to floats of 3; missing channels are 0.
ViewportImage read_half(RenderingDevice &p_device, TextureHandle p_texture, uint32_t p_from_channels) {
	const TextureDesc &desc = p_device.texture_desc(p_texture);
	const std::vector<std::byte> bytes = p_device.read_back_texture(p_texture);
	ViewportImage image{ desc.width, desc.height, 3, std::vector<float>(size_t(desc.width) * desc.height * 3) };
	for (size_t i = 0; i < size_t(desc.width) * desc.height; i++) {
		for (uint32_t k = 0; k < std::min(p_from_channels, 3u); k++) {
			uint16_t half;
			std::memcpy(&half, &bytes[(i * p_from_channels + k) * 2], 2);
			image.values[i * 3 + k] = glm::unpackHalf1x16(half);
		}
	}
	return image;
}

ViewportImage read_display(RenderingDevice &p_device, TextureHandle p_texture) {
	const TextureDesc &desc = p_device.texture_desc(p_texture);
	const std::vector<std::byte> bytes = p_device.read_back_texture(p_texture);
	ViewportImage image{ desc.width, desc.height, 3, std::vector<float>(size_t(desc.width) * desc.height * 3) };
	for (size_t i = 0; i < image.values.size(); i++) {
		image.values[i] = float(bytes[i / 3 * 4 + i % 3]) / 255.0f;
	}
	return image;
}

ViewportImage read_depth(RenderingDevice &p_device, TextureHandle p_texture, const Projection &p_view_from_clip) {
	const TextureDesc &desc = p_device.texture_desc(p_texture);
	const std::vector<std::byte> bytes = p_device.read_back_texture(p_texture);
	ViewportImage image{ desc.width, desc.height, 1, std::vector<float>(size_t(desc.width) * desc.height) };
	std::memcpy(image.values.data(), bytes.data(), bytes.size());
	for (float &depth : image.values) {
		const Vector4 point = p_view_from_clip * Vector4(0.0f, 0.0f, depth, 1.0f);
		depth = depth > 0.0f ? -point.z / point.w : BACKGROUND_DEPTH_M;
	}
	return image;
}
} // namespace

ViewportImage FrameRenderer::read_back(ViewportRid p_viewport, ViewportBuffer p_buffer) {
	const auto found = viewports.find(p_viewport.index);
	if (found == viewports.end() || !(found->second.first == p_viewport)) {
		return {};
	}
	const ViewportState &state = *found->second.second;
	const ScreenTargets &targets = state.targets;
	const auto aov = [&](const OwnedTexture &p_texture) { return targets.aov ? read_half(device, p_texture, 4) : ViewportImage(); };
	switch (p_buffer) {
		case ViewportBuffer::COLOR_LINEAR:
			return read_half(device, targets.color, 4);
		case ViewportBuffer::COLOR_DISPLAY:
			return read_display(device, targets.display);
		case ViewportBuffer::DIRECT:
			return aov(targets.direct);
		case ViewportBuffer::INDIRECT_DIFFUSE:
			return aov(targets.indirect_diffuse);
		case ViewportBuffer::INDIRECT_SPECULAR:
			return aov(targets.indirect_specular);
		case ViewportBuffer::EMISSION:
			return aov(targets.emission);
		case ViewportBuffer::ALBEDO:
			return aov(targets.albedo);
		case ViewportBuffer::NORMAL:
			return read_half(device, targets.normal_roughness, 4);
		case ViewportBuffer::DEPTH:
			return read_depth(device, targets.depth, glm::inverse(state.previous_clip_from_view));
		case ViewportBuffer::MOTION:
			return read_half(device, targets.motion, 2);
	}
	return {};
}

} // namespace lucent
