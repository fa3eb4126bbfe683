// SPDX-License-Identifier: MIT
#include "servers/rendering/device/rendering_device_impl.h"

#include <cstdlib>

namespace lucent {

RenderingDevice::Impl::Impl(std::unique_ptr<RenderingDeviceDriver> p_driver) :
		driver(std::move(p_driver)), shaders(*driver), pipelines(*driver, shaders), staging(*driver), profiler(*driver) {
	if (const char *poison = std::getenv("LUCENT_POISON"); poison != nullptr) {
		fill_byte = uint8_t(std::strtoul(poison, nullptr, 16));
	}
}

RenderingDevice::Impl::~Impl() {
	if (is_open) {
		submit();
	}
	wait_idle();
	textures.for_each([&](TextureHandle, TextureResource &r_texture) { driver->destroy(r_texture.id); });
	buffers.for_each([&](BufferHandle, BufferResource &r_buffer) { driver->destroy(r_buffer.id); });
	binding_sets.for_each([&](BindingSetHandle, BindingSetResource &r_set) { driver->destroy(r_set.id); });
	samplers.for_each([&](SamplerHandle, auto &r_sampler) { driver->destroy(r_sampler.second); });
}

void RenderingDevice::Impl::open() {
	if (!is_open) {
		driver->begin_commands(slot);
		finish_slot(slot);
		is_open = true;
	}
}

void RenderingDevice::Impl::submit() {
	driver->submit_commands();
	slot_garbage[slot] = std::move(pending_garbage);
	pending_garbage = {};
	slot = (slot + 1) % RenderingDeviceDriver::SLOT_COUNT;
	is_open = false;
}

void RenderingDevice::Impl::finish_slot(uint32_t p_slot) {
	profiler.collect(p_slot);
	staging.recycle(p_slot);
	destroy(slot_garbage[p_slot]);
}

void RenderingDevice::Impl::wait_idle() {
	if (is_open) {
		submit();
	}
	driver->wait_idle();
	// Oldest first, so that the timings left are the newest frame's.
	for (uint32_t i = 0; i < RenderingDeviceDriver::SLOT_COUNT; i++) {
		finish_slot((slot + i) % RenderingDeviceDriver::SLOT_COUNT);
	}
	destroy(pending_garbage);
}

void RenderingDevice::Impl::destroy(Garbage &r_garbage) {
	// Sets before what they point to.
	for (DriverSet set : r_garbage.sets) {
		driver->destroy(set);
	}
	for (DriverTexture texture_id : r_garbage.textures) {
		driver->destroy(texture_id);
	}
	for (DriverBuffer buffer_id : r_garbage.buffers) {
		driver->destroy(buffer_id);
	}
	for (DriverPipeline pipeline : r_garbage.pipelines) {
		driver->destroy(pipeline);
	}
	for (DriverShader shader : r_garbage.shaders) {
		driver->destroy(shader);
	}
	r_garbage = {};
}

std::vector<std::byte> RenderingDevice::Impl::read_back(uint64_t p_size_bytes, const std::function<void(DriverBuffer)> &p_record) {
	std::vector<std::byte> result;
	if (p_size_bytes == 0) {
		return result;
	}
	uint64_t allocated = 0;
	const DriverBuffer target = driver->create_buffer({ p_size_bytes, 0, "read_back" }, MemoryKind::READ_BACK, allocated);
	ERR_FAIL_COND_V_MSG(!target.is_valid(), result, "no memory to read back {} bytes", p_size_bytes);
	open();
	p_record(target);
	Barrier barrier;
	barrier.buffer = target;
	barrier.source = ACCESS_COPY_WRITE;
	barrier.target = ACCESS_HOST_READ;
	driver->cmd_barriers({ &barrier, 1 });
	wait_idle();
	const std::byte *mapped = driver->mapped(target);
	result.assign(mapped, mapped + p_size_bytes);
	driver->destroy(target);
	return result;
}

TextureResource &RenderingDevice::Impl::texture(TextureHandle p_handle) {
	TextureResource *resource = textures.get(p_handle);
	INVARIANT(resource != nullptr, "a texture is used that is null or was freed");
	return *resource;
}

BufferResource &RenderingDevice::Impl::buffer(BufferHandle p_handle) {
	BufferResource *resource = buffers.get(p_handle);
	INVARIANT(resource != nullptr, "a buffer is used that is null or was freed");
	return *resource;
}

BindingSetResource &RenderingDevice::Impl::binding_set(BindingSetHandle p_handle) {
	BindingSetResource *resource = binding_sets.get(p_handle);
	INVARIANT(resource != nullptr, "a binding set is used that is null or was freed");
	return *resource;
}

void RenderingDevice::Impl::use(BufferResource &r_buffer, uint32_t p_access, bool p_overwrites_all) {
	if (!r_buffer.initialized && !p_overwrites_all) {
		fill_new(r_buffer);
	}
	r_buffer.initialized = true;
	tracker.use_buffer(r_buffer.id, r_buffer.state, p_access);
}

void RenderingDevice::Impl::use(TextureResource &r_texture, const TextureRange &p_range, uint32_t p_access, TextureLayout p_layout, bool p_overwrites_range) {
	if (!r_texture.initialized && !p_overwrites_range) {
		fill_new(r_texture);
	}
	const bool agreed = tracker.use_texture(r_texture.id, r_texture.state, p_range, p_access, p_layout, p_overwrites_range);
	INVARIANT(agreed, "one pass uses '{}' in two ways that exclude each other, such as target and texture", r_texture.desc.name);
}

void RenderingDevice::Impl::flush_barriers() {
	if (!tracker.barriers().empty()) {
		driver->cmd_barriers(tracker.barriers());
	}
	tracker.next_command();
}

void RenderingDevice::Impl::fill_new(BufferResource &r_buffer) {
	// Nothing used it before, so nothing need be waited for.
	driver->cmd_fill_buffer(r_buffer.id, 0, (r_buffer.desc.size_bytes + 3) / 4 * 4, 0x01010101u * fill_byte);
	r_buffer.state.last = ACCESS_COPY_WRITE;
	r_buffer.initialized = true;
}

void RenderingDevice::Impl::fill_new(TextureResource &r_texture) {
	const FormatKind kind = format_kind(r_texture.desc.format);
	float value = 0.0f;
	if (fill_byte != 0) {
		const bool is_float = kind == FormatKind::FLOAT;
		value = is_float ? std::numeric_limits<float>::quiet_NaN() : (kind == FormatKind::UINT ? std::numeric_limits<float>::max() : 1.0f);
	}
	ResourceStateTracker own(0); // the pass's own barriers come after the fill
	std::vector<TextureRange> ranges;
	for (uint32_t layer = 0; layer < r_texture.desc.layer_count(); layer++) {
		for (uint32_t mip = 0; mip < r_texture.desc.mips; mip++) {
			if (r_texture.state.at(mip, layer).layout == TextureLayout::UNDEFINED) {
				ranges.push_back({ mip, 1, layer, 1 });
			}
		}
	}
	if (ranges.size() == size_t(r_texture.desc.layer_count()) * r_texture.desc.mips) {
		ranges.assign(1, r_texture.state.whole());
	}
	for (const TextureRange &range : ranges) {
		own.use_texture(r_texture.id, r_texture.state, range, ACCESS_COPY_WRITE, TextureLayout::COPY_TARGET, true);
	}
	if (!own.barriers().empty()) {
		driver->cmd_barriers(own.barriers());
	}
	for (const TextureRange &range : ranges) {
		driver->cmd_clear_texture(r_texture.id, range, Vector4(value));
	}
	r_texture.initialized = true;
}

TextureRange resolve_range(const TextureDesc &p_desc, const TextureView &p_view) {
	TextureRange range = { 0, p_desc.mips, 0, p_desc.layer_count() };
	if (p_view.mip != TextureView::ALL) {
		range.first_mip = p_view.mip;
		range.mip_count = 1;
	}
	if (p_view.layer != TextureView::ALL) {
		range.first_layer = p_view.layer;
		range.layer_count = 1;
	}
	return range;
}

TextureLayout shader_layout(const TextureDesc &p_desc) {
	if (p_desc.usage & TEXTURE_DEPTH_TARGET) {
		return TextureLayout::DEPTH_READ;
	}
	return p_desc.usage & TEXTURE_STORAGE ? TextureLayout::GENERAL : TextureLayout::SHADER_READ;
}

} // namespace lucent
