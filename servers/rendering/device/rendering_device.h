// SPDX-License-Identifier: MIT
#pragma once
// The thin device: resources, uploads, read-back, frames. Its one user-facing way to run GPU work is the PassRecorder.

#include "servers/rendering/device/gpu_profiler.h"
#include "servers/rendering/device/pass_recorder.h"
#include "servers/rendering/device/rendering_device_driver.h"
#include "servers/rendering/device/resource_types.h"

#include <map>
#include <memory>
#include <span>
#include <vector>

namespace lucent {

// A set-1 binding: a texture with its sampler (combined image sampler in GLSL: `sampler2D`), or a buffer.
struct SetBinding {
	uint32_t binding = 0;
	TextureHandle texture;
	SamplerHandle sampler;
	BufferHandle buffer;
	bool buffer_is_uniform = false;
};

struct MemoryReport {
	struct Entry {
		std::string name; // debug name
		uint64_t bytes = 0; // as allocated
	};
	std::vector<Entry> entries;
	uint64_t total_bytes = 0;
};

class RenderingDevice {
public:
	// The device takes over the driver.
	static Result<std::unique_ptr<RenderingDevice>> create(std::unique_ptr<RenderingDeviceDriver> p_driver);
	~RenderingDevice();

	const DeviceInfo &info() const;

	OwnedTexture create_texture(const TextureDesc &p_desc);
	OwnedBuffer create_buffer(const BufferDesc &p_desc);
	// Set 1 of the draws' shaders: the layout is derived from the bindings given, numbered from 0 without gaps.
	OwnedBindingSet create_binding_set(std::span<const SetBinding> p_bindings, const std::string &p_name);
	SamplerHandle sampler(const SamplerDesc &p_desc); // cached, lives as long as the device

	const TextureDesc &texture_desc(TextureHandle p_texture) const;
	const BufferDesc &buffer_desc(BufferHandle p_buffer) const;

	// Staged; visible to every pass recorded after the call (also in the frame being recorded, if no pass of it used the resource yet).
	void upload_buffer(BufferHandle p_buffer, uint64_t p_offset_bytes, std::span<const std::byte> p_data);
	void upload_texture(TextureHandle p_texture, uint32_t p_mip, uint32_t p_layer, std::span<const std::byte> p_texels);
	template <typename T>
	void upload_buffer(BufferHandle p_buffer, const std::vector<T> &p_values, uint64_t p_offset_bytes = 0) {
		upload_buffer(p_buffer, p_offset_bytes, std::as_bytes(std::span(p_values)));
	}

	// Waits for the GPU. Outside begin_frame/end_frame only. Texels are tightly packed; a 3D texture's slices follow one another.
	std::vector<std::byte> read_back_buffer(BufferHandle p_buffer, uint64_t p_offset_bytes, uint64_t p_size_bytes);
	std::vector<std::byte> read_back_texture(TextureHandle p_texture, uint32_t p_mip = 0, uint32_t p_layer = 0);
	template <typename T>
	std::vector<T> read_back_buffer(BufferHandle p_buffer) {
		const std::vector<std::byte> bytes = read_back_buffer(p_buffer, 0, buffer_desc(p_buffer).size_bytes);
		std::vector<T> values(bytes.size() / sizeof(T));
		std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
		return values;
	}

	// Two frames in flight. begin_frame waits for the frame two before.
	PassRecorder &begin_frame();
	void end_frame();
	void wait_idle();

	// GPU milliseconds of each pass of the last finished frame, in order. Empty where the device has no timestamps.
	const std::vector<PassTiming> &timings() const;
	MemoryReport memory_report() const;

	// Debug option: recompile changed .glsl files of p_source_root between frames (uses glslangValidator). False: nothing changed.
	bool reload_shaders(const std::string &p_source_root);

	RenderingDeviceDriver &driver();

	struct Impl; // rendering_device_impl.h

private:
	friend class PassRecorder;
	friend class ComputePass;
	friend class RenderPass;
	template <typename H>
	friend class Owned;
	explicit RenderingDevice(std::unique_ptr<Impl> p_impl);
	std::unique_ptr<Impl> impl;
	void free_handle(TextureHandle p_texture);
	void free_handle(BufferHandle p_buffer);
	void free_handle(BindingSetHandle p_set);
};

template <typename Handle>
void Owned<Handle>::reset() {
	if (device != nullptr && owned_handle.is_valid()) {
		device->free_handle(owned_handle);
	}
	device = nullptr;
	owned_handle = Handle();
}

} // namespace lucent
