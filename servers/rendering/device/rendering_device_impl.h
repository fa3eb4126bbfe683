// SPDX-License-Identifier: MIT
#pragma once
// What RenderingDevice keeps, shared with the recorder.

#include "servers/rendering/device/gpu_profiler.h"
#include "servers/rendering/device/pipeline_store.h"
#include "servers/rendering/device/rendering_device.h"
#include "servers/rendering/device/resource_state_tracker.h"
#include "servers/rendering/device/shader_library.h"
#include "servers/rendering/device/staging.h"

namespace lucent {

struct TextureResource {
	TextureDesc desc;
	DriverTexture id;
	TextureState state;
	uint64_t allocated_bytes = 0;
	bool initialized = false; // no mip or layer is left undefined
};

struct BufferResource {
	BufferDesc desc;
	DriverBuffer id;
	AccessState state;
	uint64_t allocated_bytes = 0;
	bool initialized = false;
};

struct BindingSetResource {
	std::string name;
	DriverSet id;
	DriverSetLayout layout;
	std::vector<DescriptorKind> kinds;
	std::vector<SetBinding> bindings;
	uint64_t last_pass = 0; // the pass that last put its barriers
};

// Objects to destroy when the commands that may use them have finished.
struct Garbage {
	std::vector<DriverTexture> textures;
	std::vector<DriverBuffer> buffers;
	std::vector<DriverSet> sets;
	std::vector<DriverPipeline> pipelines;
	std::vector<DriverShader> shaders;
};

struct RenderingDevice::Impl {
	explicit Impl(std::unique_ptr<RenderingDeviceDriver> p_driver);
	~Impl();

	// Opens the command list if none is open.
	void open();
	void submit();
	void finish_slot(uint32_t p_slot); // its commands have finished
	void wait_idle();
	void destroy(Garbage &r_garbage);
	// Waits for what p_record copies into the buffer that it is given.
	std::vector<std::byte> read_back(uint64_t p_size_bytes, const std::function<void(DriverBuffer)> &p_record);

	TextureResource &texture(TextureHandle p_handle);
	BufferResource &buffer(BufferHandle p_handle);
	BindingSetResource &binding_set(BindingSetHandle p_handle);

	// Put into the tracker what the next command touches; fill what was never written before it is read.
	void use(BufferResource &r_buffer, uint32_t p_access, bool p_overwrites_all = false);
	void use(TextureResource &r_texture, const TextureRange &p_range, uint32_t p_access, TextureLayout p_layout, bool p_overwrites_range = false);
	void flush_barriers();
	void fill_new(BufferResource &r_buffer);
	void fill_new(TextureResource &r_texture);

	// pass_recorder.cpp
	void begin_pass(const std::string &p_name);
	void end_pass(PassRecorder &r_recorder, PassInfo p_info);

	std::unique_ptr<RenderingDeviceDriver> driver;
	ShaderLibrary shaders;
	PipelineStore pipelines;
	StagingMemory staging;
	GpuProfiler profiler;
	ResourceStateTracker tracker;
	RidOwner<TextureResource, TextureTag> textures;
	RidOwner<BufferResource, BufferTag> buffers;
	RidOwner<BindingSetResource, BindingSetTag> binding_sets;
	RidOwner<std::pair<SamplerDesc, DriverSampler>, SamplerTag> samplers;
	std::unique_ptr<PassRecorder> recorder;

	uint32_t slot = 0; // being recorded, or next to be
	bool is_open = false;
	bool in_frame = false;
	bool in_hook = false;
	uint64_t pass_serial = 0;
	uint8_t fill_byte = 0; // of new resources: LUCENT_POISON
	Garbage pending_garbage; // since the last submission
	std::array<Garbage, RenderingDeviceDriver::SLOT_COUNT> slot_garbage;

	// Kept between passes so that recording does not allocate.
	std::vector<DriverBinding> scratch_bindings;
	std::vector<DescriptorKind> scratch_kinds;
	std::vector<const ShaderReflection *> scratch_shaders;
	RenderTargets scratch_targets;
};

TextureRange resolve_range(const TextureDesc &p_desc, const TextureView &p_view);
// The layout in which shaders see a texture: storage textures and those sampled beside them stay in GENERAL.
TextureLayout shader_layout(const TextureDesc &p_desc);

} // namespace lucent
