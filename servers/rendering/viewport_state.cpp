// SPDX-License-Identifier: MIT
#include "servers/rendering/viewport_state.h"

#include <cstring>

namespace lucent {

void ScreenTargets::resize(RenderingDevice &p_device, uint32_t p_width, uint32_t p_height, bool p_aov) {
	const auto make = [&](Format p_format, uint32_t p_usage, const char *p_name) {
		return p_device.create_texture({ .format = p_format, .width = p_width, .height = p_height, .usage = p_usage, .name = p_name });
	};
	constexpr uint32_t COLOR = TEXTURE_SAMPLED | TEXTURE_COLOR_TARGET;
	if (width != p_width || height != p_height) {
		depth = make(Format::D32_FLOAT, TEXTURE_SAMPLED | TEXTURE_DEPTH_TARGET, "screen.depth");
		normal_roughness = make(Format::RGBA16_FLOAT, COLOR, "screen.normal_roughness");
		motion = make(Format::RG16_FLOAT, COLOR, "screen.motion");
		gi_irradiance = make(Format::RGBA16_FLOAT, TEXTURE_SAMPLED | TEXTURE_STORAGE, "screen.gi_irradiance");
		gi_radiance = make(Format::RGBA16_FLOAT, TEXTURE_SAMPLED | TEXTURE_STORAGE, "screen.gi_radiance");
		color = make(Format::RGBA16_FLOAT, COLOR | TEXTURE_STORAGE, "screen.color");
		display = make(Format::RGBA8_UNORM, TEXTURE_SAMPLED | TEXTURE_STORAGE, "screen.display");
		aov = false;
	}
	width = p_width;
	height = p_height;
	if (p_aov && !aov) {
		direct = make(Format::RGBA16_FLOAT, COLOR, "screen.direct");
		indirect_diffuse = make(Format::RGBA16_FLOAT, COLOR, "screen.indirect_diffuse");
		indirect_specular = make(Format::RGBA16_FLOAT, COLOR, "screen.indirect_specular");
		emission = make(Format::RGBA16_FLOAT, COLOR, "screen.emission");
		albedo = make(Format::RGBA16_FLOAT, COLOR, "screen.albedo");
	}
	aov = p_aov;
}

SkyMaps::SkyMaps(RenderingDevice &p_device) :
		device(p_device) {
	data_buffer = device.create_buffer({ sizeof(shader::SkyData), BUFFER_UNIFORM, "sky.data" });
	TextureDesc desc;
	desc.format = Format::RGBA16_FLOAT;
	desc.usage = TEXTURE_SAMPLED | TEXTURE_STORAGE;
	desc.width = desc.height = OCTAHEDRAL_SIZE_TEXELS;
	desc.name = "sky.octahedral";
	octahedral_map = device.create_texture(desc);
	desc.width = desc.height = IRRADIANCE_SIZE_TEXELS;
	desc.name = "sky.irradiance";
	irradiance_map = device.create_texture(desc);
	desc.width = desc.height = RADIANCE_SIZE_TEXELS;
	desc.type = TextureType::TEXTURE_2D_ARRAY;
	desc.layers = SKY_RADIANCE_LAYERS;
	desc.name = "sky.radiance";
	radiance_map = device.create_texture(desc);
}

bool SkyMaps::update(const shader::SkyData &p_sky, TextureHandle p_panorama) {
	if (drawn && std::memcmp(&p_sky, &uploaded, sizeof(p_sky)) == 0 && panorama == p_panorama) {
		return false;
	}
	device.upload_buffer(data_buffer, 0, std::as_bytes(std::span(&p_sky, 1)));
	// The maps hold no suns and do not see the camera.
	shader::SkyData before = uploaded;
	before.world_direction_from_clip = p_sky.world_direction_from_clip;
	before.sun_count = p_sky.sun_count;
	std::memcpy(before.suns, p_sky.suns, sizeof(before.suns));
	const bool redraw = !drawn || std::memcmp(&p_sky, &before, sizeof(p_sky)) != 0 || panorama != p_panorama;
	uploaded = p_sky;
	panorama = p_panorama;
	drawn = true;
	return redraw;
}

SkyInputs SkyMaps::inputs() const {
	SamplerDesc desc;
	desc.address_v = AddressMode::CLAMP_TO_EDGE;
	return { data_buffer, panorama, device.sampler(desc) };
}

void SkyMaps::draw(PassRecorder &r_recorder) {
	SamplerDesc clamped;
	clamped.address_u = clamped.address_v = AddressMode::CLAMP_TO_EDGE;
	sky_octahedral(r_recorder, inputs(), octahedral_map, OCTAHEDRAL_SIZE_TEXELS);
	sky_irradiance(r_recorder, octahedral_map, irradiance_map, IRRADIANCE_SIZE_TEXELS);
	sky_radiance(r_recorder, octahedral_map, device.sampler(clamped), radiance_map, RADIANCE_SIZE_TEXELS);
}

ViewportState::ViewportState(RenderingDevice &p_device) :
		sky(p_device), shadows(p_device) {
	frame_buffer = p_device.create_buffer({ sizeof(shader::FrameData), BUFFER_UNIFORM, "frame.data" });
}

} // namespace lucent
