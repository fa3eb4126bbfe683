// SPDX-License-Identifier: MIT
#include "tests/gpu/gpu_fixture.h"

#include "drivers/vulkan/vulkan_driver.h"
#include "tests/test_support.h"

#include <doctest/doctest.h>

namespace lucent::test {

GpuFixture::GpuFixture() {
	VulkanDriverOptions settings;
	settings.device_filter = options().device;
	settings.validation = true;
	Result<std::unique_ptr<RenderingDeviceDriver>> driver = create_vulkan_driver(settings);
	INFO(driver.error().message);
	REQUIRE(driver.ok());
	rendering_device = RenderingDevice::create(driver.take()).take();
}

GpuFixture::~GpuFixture() {
	if (rendering_device != nullptr) {
		rendering_device->wait_idle();
		const uint64_t messages = rendering_device->driver().validation_message_count();
		CHECK(messages == 0);
	}
}

void GpuFixture::frame(const std::function<void(PassRecorder &)> &p_record) {
	p_record(device().begin_frame());
	device().end_frame();
	device().wait_idle();
}

OwnedBuffer GpuFixture::buffer(const std::string &p_name, uint64_t p_size_bytes, uint32_t p_usage) {
	return device().create_buffer({ p_size_bytes, p_usage, p_name });
}

OwnedTexture GpuFixture::texture(const std::string &p_name, Format p_format, uint32_t p_width, uint32_t p_height, uint32_t p_usage) {
	TextureDesc desc;
	desc.name = p_name;
	desc.format = p_format;
	desc.width = p_width;
	desc.height = p_height;
	desc.usage = p_usage;
	return device().create_texture(desc);
}

} // namespace lucent::test
