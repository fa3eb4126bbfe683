// SPDX-License-Identifier: MIT
#include "servers/rendering/device/rendering_device.h"

#include "servers/rendering/device/rendering_device_impl.h"

#include <algorithm>

namespace lucent {

namespace {

// Texture uploads outside a frame are submitted when this much waits.
constexpr uint64_t MAX_STAGED_BYTES = 256u << 20;

std::string check_desc(const TextureDesc &p_desc) {
	if (p_desc.format == Format::UNDEFINED || p_desc.usage == 0) {
		return "it has no format or no usage";
	}
	if (p_desc.width == 0 || p_desc.height == 0 || p_desc.depth == 0 || p_desc.layers == 0 || p_desc.mips == 0) {
		return "a size, layer or mip count is 0";
	}
	const uint32_t longest = std::max({ p_desc.width, p_desc.height, p_desc.type == TextureType::TEXTURE_3D ? p_desc.depth : 1u });
	if (p_desc.mips > 32 || (longest >> (p_desc.mips - 1)) == 0) {
		return "it has more mips than its size allows";
	}
	if (p_desc.type == TextureType::TEXTURE_CUBE && p_desc.width != p_desc.height) {
		return "a cube's faces must be square";
	}
	return {};
}

} // namespace

Result<std::unique_ptr<RenderingDevice>> RenderingDevice::create(std::unique_ptr<RenderingDeviceDriver> p_driver) {
	if (p_driver == nullptr) {
		return make_error("a rendering device needs a driver");
	}
	std::unique_ptr<RenderingDevice> device(new RenderingDevice(std::make_unique<Impl>(std::move(p_driver))));
	device->impl->recorder.reset(new PassRecorder(*device));
	return device;
}

RenderingDevice::RenderingDevice(std::unique_ptr<Impl> p_impl) :
		impl(std::move(p_impl)) {}

RenderingDevice::~RenderingDevice() = default;

const DeviceInfo &RenderingDevice::info() const {
	return impl->driver->info();
}

RenderingDeviceDriver &RenderingDevice::driver() {
	return *impl->driver;
}

OwnedTexture RenderingDevice::create_texture(const TextureDesc &p_desc) {
	const std::string wrong = check_desc(p_desc);
	ERR_FAIL_COND_V_MSG(!wrong.empty(), OwnedTexture(), "texture '{}': {}", p_desc.name, wrong);
	TextureResource resource;
	resource.desc = p_desc;
	resource.id = impl->driver->create_texture(p_desc, resource.allocated_bytes);
	ERR_FAIL_COND_V_MSG(!resource.id.is_valid(), OwnedTexture(), "texture '{}' can't be made", p_desc.name);
	resource.state = TextureState(p_desc.mips, p_desc.layer_count());
	return OwnedTexture(this, impl->textures.make(std::move(resource)));
}

OwnedBuffer RenderingDevice::create_buffer(const BufferDesc &p_desc) {
	ERR_FAIL_COND_V_MSG(p_desc.size_bytes == 0, OwnedBuffer(), "buffer '{}' has 0 bytes", p_desc.name);
	ERR_FAIL_COND_V_MSG((p_desc.usage & BUFFER_STORAGE) && p_desc.size_bytes > info().max_storage_buffer_bytes, OwnedBuffer(), "buffer '{}': {} bytes is more than the device's {}", p_desc.name, p_desc.size_bytes, info().max_storage_buffer_bytes);
	BufferResource resource;
	resource.desc = p_desc;
	BufferDesc padded = p_desc;
	padded.size_bytes = (p_desc.size_bytes + 3) / 4 * 4; // fills work on words
	resource.id = impl->driver->create_buffer(padded, MemoryKind::DEVICE, resource.allocated_bytes);
	ERR_FAIL_COND_V_MSG(!resource.id.is_valid(), OwnedBuffer(), "buffer '{}' can't be made", p_desc.name);
	return OwnedBuffer(this, impl->buffers.make(std::move(resource)));
}

OwnedBindingSet RenderingDevice::create_binding_set(std::span<const SetBinding> p_bindings, const std::string &p_name) {
	BindingSetResource set;
	set.name = p_name;
	set.bindings.assign(p_bindings.begin(), p_bindings.end());
	set.kinds.assign(p_bindings.size(), DescriptorKind::NONE);
	std::vector<DriverBinding> bindings;
	for (const SetBinding &binding : p_bindings) {
		const bool is_new = binding.binding < set.kinds.size() && set.kinds[binding.binding] == DescriptorKind::NONE;
		ERR_FAIL_COND_V_MSG(!is_new, OwnedBindingSet(), "binding set '{}': the bindings are not 0 to {}, each once", p_name, p_bindings.size() - 1);
		const TextureResource *texture = impl->textures.get(binding.texture);
		const BufferResource *buffer = impl->buffers.get(binding.buffer);
		ERR_FAIL_COND_V_MSG((texture == nullptr) == (buffer == nullptr), OwnedBindingSet(), "binding set '{}', binding {}: needs a live texture or a live buffer", p_name, binding.binding);
		DriverBinding driver_binding;
		driver_binding.binding = binding.binding;
		if (texture != nullptr) {
			constexpr ViewShape SHAPES[] = { ViewShape::D2, ViewShape::D2_ARRAY, ViewShape::D3, ViewShape::CUBE };
			const auto *sampler = impl->samplers.get(binding.sampler);
			ERR_FAIL_COND_V_MSG(sampler == nullptr, OwnedBindingSet(), "binding set '{}', binding {}: a texture needs a sampler", p_name, binding.binding);
			driver_binding.kind = DescriptorKind::TEXTURE_WITH_SAMPLER;
			driver_binding.texture = texture->id;
			driver_binding.range = texture->state.whole();
			driver_binding.shape = SHAPES[size_t(texture->desc.type)];
			driver_binding.layout = shader_layout(texture->desc);
			driver_binding.sampler = sampler->second;
		} else {
			driver_binding.kind = binding.buffer_is_uniform ? DescriptorKind::UNIFORM_BUFFER : DescriptorKind::STORAGE_BUFFER;
			driver_binding.buffer = buffer->id;
		}
		set.kinds[binding.binding] = driver_binding.kind;
		bindings.push_back(driver_binding);
	}
	set.layout = impl->driver->set_layout(set.kinds);
	set.id = impl->driver->create_set(set.layout, bindings, p_name);
	return OwnedBindingSet(this, impl->binding_sets.make(std::move(set)));
}

SamplerHandle RenderingDevice::sampler(const SamplerDesc &p_desc) {
	SamplerHandle found;
	impl->samplers.for_each([&](SamplerHandle p_handle, const auto &p_sampler) {
		if (p_sampler.first == p_desc) {
			found = p_handle;
		}
	});
	return found.is_valid() ? found : impl->samplers.make({ p_desc, impl->driver->create_sampler(p_desc) });
}

const TextureDesc &RenderingDevice::texture_desc(TextureHandle p_texture) const {
	return impl->texture(p_texture).desc;
}

const BufferDesc &RenderingDevice::buffer_desc(BufferHandle p_buffer) const {
	return impl->buffer(p_buffer).desc;
}

void RenderingDevice::upload_buffer(BufferHandle p_buffer, uint64_t p_offset_bytes, std::span<const std::byte> p_data) {
	if (p_data.empty()) {
		return;
	}
	BufferResource *buffer = impl->buffers.get(p_buffer);
	ERR_FAIL_COND_MSG(buffer == nullptr, "upload to a buffer that is gone");
	const uint64_t size = buffer->desc.size_bytes;
	ERR_FAIL_COND_MSG(p_offset_bytes > size || p_data.size() > size - p_offset_bytes, "'{}': {} bytes at {} do not fit into {}", buffer->desc.name, p_data.size(), p_offset_bytes, size);
	impl->open();
	const StagingRange staged = impl->staging.allocate(impl->slot, p_data.size());
	ERR_FAIL_COND_MSG(!staged.buffer.is_valid(), "'{}': no memory to upload {} bytes", buffer->desc.name, p_data.size());
	std::memcpy(staged.data, p_data.data(), p_data.size());
	impl->use(*buffer, ACCESS_COPY_WRITE, p_data.size() == size);
	impl->flush_barriers();
	impl->driver->cmd_copy_buffer(staged.buffer, buffer->id, p_data.size(), staged.offset, p_offset_bytes);
	if (!impl->in_frame && impl->staging.in_use_bytes(impl->slot) > MAX_STAGED_BYTES) {
		impl->submit();
	}
}

void RenderingDevice::upload_texture(TextureHandle p_texture, uint32_t p_mip, uint32_t p_layer, std::span<const std::byte> p_texels) {
	TextureResource *texture = impl->textures.get(p_texture);
	ERR_FAIL_COND_MSG(texture == nullptr, "upload to a texture that is gone");
	const TextureDesc &desc = texture->desc;
	ERR_FAIL_COND_MSG(p_mip >= desc.mips || p_layer >= desc.layer_count(), "'{}' has no mip {} of layer {}", desc.name, p_mip, p_layer);
	ERR_FAIL_COND_MSG(p_texels.size() != desc.mip_size_bytes(p_mip), "'{}': mip {} takes {} bytes, not {}", desc.name, p_mip, desc.mip_size_bytes(p_mip), p_texels.size());
	impl->open();
	const StagingRange staged = impl->staging.allocate(impl->slot, p_texels.size());
	ERR_FAIL_COND_MSG(!staged.buffer.is_valid(), "'{}': no memory to upload {} bytes", desc.name, p_texels.size());
	std::memcpy(staged.data, p_texels.data(), p_texels.size());
	impl->use(*texture, { p_mip, 1, p_layer, 1 }, ACCESS_COPY_WRITE, TextureLayout::COPY_TARGET, true);
	impl->flush_barriers();
	impl->driver->cmd_copy_buffer_to_texture(staged.buffer, staged.offset, texture->id, p_mip, p_layer);
	if (!impl->in_frame && impl->staging.in_use_bytes(impl->slot) > MAX_STAGED_BYTES) {
		impl->submit();
	}
}

std::vector<std::byte> RenderingDevice::read_back_buffer(BufferHandle p_buffer, uint64_t p_offset_bytes, uint64_t p_size_bytes) {
	INVARIANT(!impl->in_frame, "read-back inside a frame");
	BufferResource *buffer = impl->buffers.get(p_buffer);
	ERR_FAIL_COND_V_MSG(buffer == nullptr, {}, "read-back of a buffer that is gone");
	ERR_FAIL_COND_V_MSG(p_offset_bytes > buffer->desc.size_bytes || p_size_bytes > buffer->desc.size_bytes - p_offset_bytes, {}, "'{}': {} bytes at {} is beyond its {}", buffer->desc.name, p_size_bytes, p_offset_bytes, buffer->desc.size_bytes);
	return impl->read_back(p_size_bytes, [&](DriverBuffer p_to) {
		impl->use(*buffer, ACCESS_COPY_READ);
		impl->flush_barriers();
		impl->driver->cmd_copy_buffer(buffer->id, p_to, p_size_bytes, p_offset_bytes, 0);
	});
}

std::vector<std::byte> RenderingDevice::read_back_texture(TextureHandle p_texture, uint32_t p_mip, uint32_t p_layer) {
	INVARIANT(!impl->in_frame, "read-back inside a frame");
	TextureResource *texture = impl->textures.get(p_texture);
	ERR_FAIL_COND_V_MSG(texture == nullptr, {}, "read-back of a texture that is gone");
	ERR_FAIL_COND_V_MSG(p_mip >= texture->desc.mips || p_layer >= texture->desc.layer_count(), {}, "'{}' has no mip {} of layer {}", texture->desc.name, p_mip, p_layer);
	return impl->read_back(texture->desc.mip_size_bytes(p_mip), [&](DriverBuffer p_to) {
		impl->use(*texture, { p_mip, 1, p_layer, 1 }, ACCESS_COPY_READ, TextureLayout::COPY_SOURCE);
		impl->flush_barriers();
		impl->driver->cmd_copy_texture_to_buffer(texture->id, p_mip, p_layer, p_to, 0);
	});
}

PassRecorder &RenderingDevice::begin_frame() {
	INVARIANT(!impl->in_frame, "begin_frame twice");
	impl->open();
	impl->in_frame = true;
	impl->recorder->passes.clear();
	impl->profiler.begin_frame(impl->slot);
	return *impl->recorder;
}

void RenderingDevice::end_frame() {
	INVARIANT(impl->in_frame, "end_frame without begin_frame");
	impl->in_frame = false;
	impl->submit();
}

void RenderingDevice::wait_idle() {
	INVARIANT(!impl->in_frame, "wait_idle inside a frame");
	impl->wait_idle();
}

const std::vector<PassTiming> &RenderingDevice::timings() const {
	return impl->profiler.timings();
}

MemoryReport RenderingDevice::memory_report() const {
	MemoryReport report;
	const auto add = [&](const auto &p_resource) {
		report.entries.push_back({ p_resource.desc.name, p_resource.allocated_bytes });
		report.total_bytes += p_resource.allocated_bytes;
	};
	impl->textures.for_each([&](TextureHandle, const TextureResource &p_texture) { add(p_texture); });
	impl->buffers.for_each([&](BufferHandle, const BufferResource &p_buffer) { add(p_buffer); });
	return report;
}

bool RenderingDevice::reload_shaders(const std::string &p_source_root) {
	INVARIANT(!impl->in_frame, "reload_shaders inside a frame");
	if (impl->shaders.reload(p_source_root, impl->pending_garbage.shaders).empty()) {
		return false;
	}
	impl->pipelines.take_all(impl->pending_garbage.pipelines);
	return true;
}

void RenderingDevice::free_handle(TextureHandle p_texture) {
	if (const TextureResource *texture = impl->textures.get(p_texture)) {
		impl->pending_garbage.textures.push_back(texture->id);
		impl->textures.free(p_texture);
	}
}

void RenderingDevice::free_handle(BufferHandle p_buffer) {
	if (const BufferResource *buffer = impl->buffers.get(p_buffer)) {
		impl->pending_garbage.buffers.push_back(buffer->id);
		impl->buffers.free(p_buffer);
	}
}

void RenderingDevice::free_handle(BindingSetHandle p_set) {
	if (const BindingSetResource *set = impl->binding_sets.get(p_set)) {
		impl->pending_garbage.sets.push_back(set->id);
		impl->binding_sets.free(p_set);
	}
}

} // namespace lucent
