// SPDX-License-Identifier: MIT
#pragma once
// A device for the tests of suite "gpu", with core and synchronization validation on. Any validation message fails the case.

#include "servers/rendering/device/rendering_device.h"

#include <functional>
#include <memory>

namespace lucent::test {

class GpuFixture {
public:
	GpuFixture(); // throws what fails the case when there is no device
	~GpuFixture();
	GpuFixture(const GpuFixture &) = delete;
	GpuFixture &operator=(const GpuFixture &) = delete;

	RenderingDevice &device() { return *rendering_device; }
	// One frame, submitted and finished.
	void frame(const std::function<void(PassRecorder &)> &p_record);

	OwnedBuffer buffer(const std::string &p_name, uint64_t p_size_bytes, uint32_t p_usage = BUFFER_STORAGE);
	template <typename T>
	OwnedBuffer buffer(const std::string &p_name, const std::vector<T> &p_values, uint32_t p_usage = BUFFER_STORAGE) {
		OwnedBuffer made = buffer(p_name, p_values.size() * sizeof(T), p_usage);
		device().upload_buffer(made, p_values);
		return made;
	}
	OwnedTexture texture(const std::string &p_name, Format p_format, uint32_t p_width, uint32_t p_height, uint32_t p_usage);
	template <typename T>
	std::vector<T> texels(TextureHandle p_texture, uint32_t p_mip = 0, uint32_t p_layer = 0) {
		const std::vector<std::byte> bytes = device().read_back_texture(p_texture, p_mip, p_layer);
		std::vector<T> values(bytes.size() / sizeof(T));
		std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
		return values;
	}

private:
	std::unique_ptr<RenderingDevice> rendering_device;
};

} // namespace lucent::test
