// SPDX-License-Identifier: MIT
#include "servers/rendering/device/pass_recorder.h"

#include "servers/rendering/device/rendering_device_impl.h"

namespace lucent {

namespace {

constexpr uint64_t MAX_UPDATE_BYTES = 65536; // vkCmdUpdateBuffer's

} // namespace

void RenderingDevice::Impl::begin_pass(const std::string &p_name) {
	INVARIANT(in_frame, "'{}' is recorded outside begin_frame and end_frame", p_name);
	pass_serial++;
	driver->cmd_begin_label(p_name);
	flush_barriers();
}

void RenderingDevice::Impl::end_pass(PassRecorder &r_recorder, PassInfo p_info) {
	driver->cmd_end_label();
	profiler.end_pass(slot, p_info.name);
	r_recorder.passes.push_back(std::move(p_info));
	if (r_recorder.hook && !in_hook) {
		in_hook = true;
		const PassInfo info = r_recorder.passes.back(); // the hook's own copies move the list
		r_recorder.hook(info);
		in_hook = false;
	}
}

void PassRecorder::clear_buffer(BufferHandle p_buffer, uint32_t p_word) {
	RenderingDevice::Impl &impl = *device.impl;
	BufferResource &buffer = impl.buffer(p_buffer);
	impl.use(buffer, ACCESS_COPY_WRITE, true);
	PassInfo info = { "clear " + buffer.desc.name, {}, {}, { buffer.desc.name } };
	impl.begin_pass(info.name);
	impl.driver->cmd_fill_buffer(buffer.id, 0, (buffer.desc.size_bytes + 3) / 4 * 4, p_word);
	impl.end_pass(*this, std::move(info));
}

void PassRecorder::clear_texture(TextureHandle p_texture, Vector4 p_value) {
	RenderingDevice::Impl &impl = *device.impl;
	TextureResource &texture = impl.texture(p_texture);
	impl.use(texture, texture.state.whole(), ACCESS_COPY_WRITE, TextureLayout::COPY_TARGET, true);
	PassInfo info = { "clear " + texture.desc.name, {}, {}, { texture.desc.name } };
	impl.begin_pass(info.name);
	impl.driver->cmd_clear_texture(texture.id, texture.state.whole(), p_value);
	impl.end_pass(*this, std::move(info));
}

void PassRecorder::copy_buffer(BufferHandle p_from, BufferHandle p_to, uint64_t p_size_bytes, uint64_t p_from_offset, uint64_t p_to_offset) {
	RenderingDevice::Impl &impl = *device.impl;
	BufferResource &from = impl.buffer(p_from);
	BufferResource &to = impl.buffer(p_to);
	const bool fits = p_from_offset + p_size_bytes <= from.desc.size_bytes && p_to_offset + p_size_bytes <= to.desc.size_bytes;
	INVARIANT(fits && p_size_bytes != 0 && &from != &to, "{} bytes from {} of '{}' to {} of '{}'", p_size_bytes, p_from_offset, from.desc.name, p_to_offset, to.desc.name);
	impl.use(from, ACCESS_COPY_READ);
	impl.use(to, ACCESS_COPY_WRITE, p_size_bytes == to.desc.size_bytes);
	PassInfo info = { "copy " + from.desc.name, {}, { from.desc.name }, { to.desc.name } };
	impl.begin_pass(info.name);
	impl.driver->cmd_copy_buffer(from.id, to.id, p_size_bytes, p_from_offset, p_to_offset);
	impl.end_pass(*this, std::move(info));
}

void PassRecorder::copy_texture(TextureHandle p_from, TextureHandle p_to) {
	RenderingDevice::Impl &impl = *device.impl;
	TextureResource &from = impl.texture(p_from);
	TextureResource &to = impl.texture(p_to);
	const TextureDesc &a = from.desc, &b = to.desc;
	const bool same = a.format == b.format && a.mip_size(0) == b.mip_size(0) && a.mips == b.mips && a.layer_count() == b.layer_count();
	INVARIANT(same && &from != &to, "'{}' and '{}' differ in size, mips, layers or format, or are one", a.name, b.name);
	impl.use(from, from.state.whole(), ACCESS_COPY_READ, TextureLayout::COPY_SOURCE);
	impl.use(to, to.state.whole(), ACCESS_COPY_WRITE, TextureLayout::COPY_TARGET, true);
	PassInfo info = { "copy " + a.name, {}, { a.name }, { b.name } };
	impl.begin_pass(info.name);
	impl.driver->cmd_copy_texture(from.id, to.id);
	impl.end_pass(*this, std::move(info));
}

void PassRecorder::update_buffer(BufferHandle p_buffer, uint64_t p_offset_bytes, std::span<const std::byte> p_data) {
	RenderingDevice::Impl &impl = *device.impl;
	BufferResource &buffer = impl.buffer(p_buffer);
	const bool fits = p_offset_bytes + p_data.size() <= buffer.desc.size_bytes && p_data.size() <= MAX_UPDATE_BYTES;
	INVARIANT(fits && !p_data.empty() && p_offset_bytes % 4 == 0 && p_data.size() % 4 == 0, "'{}': {} bytes at {}: at most 64 KiB, in words, within {}", buffer.desc.name, p_data.size(), p_offset_bytes, buffer.desc.size_bytes);
	impl.use(buffer, ACCESS_COPY_WRITE, p_data.size() == buffer.desc.size_bytes);
	PassInfo info = { "update " + buffer.desc.name, {}, {}, { buffer.desc.name } };
	impl.begin_pass(info.name);
	impl.driver->cmd_update_buffer(buffer.id, p_offset_bytes, p_data);
	impl.end_pass(*this, std::move(info));
}

} // namespace lucent
