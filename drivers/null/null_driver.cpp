// SPDX-License-Identifier: MIT
#include "drivers/null/null_driver.h"

#include <fmt/format.h>

#include <map>

namespace lucent {

namespace {

std::string access_text(uint32_t p_access) {
	constexpr const char *NAMES[] = { "compute_sample", "compute_read", "compute_write", "compute_uniform", "graphics_sample", "graphics_read", "graphics_uniform", "index_read",
		"indirect_read", "color_read", "color_write", "depth_read", "depth_write", "copy_read", "copy_write", "host_read" };
	std::string text;
	for (size_t bit = 0; bit < std::size(NAMES); bit++) {
		if (p_access & (1u << bit)) {
			text += (text.empty() ? "" : "|") + std::string(NAMES[bit]);
		}
	}
	return text.empty() ? "none" : text;
}

const char *layout_text(TextureLayout p_layout) {
	constexpr const char *NAMES[] = { "undefined", "general", "shader_read", "color_target", "depth_target", "depth_read", "copy_source", "copy_target" };
	return NAMES[size_t(p_layout)];
}

std::string range_text(const TextureRange &p_range) {
	return fmt::format("mips {}+{} layers {}+{}", p_range.first_mip, p_range.mip_count, p_range.first_layer, p_range.layer_count);
}

std::string binding_text(const DriverBinding &p_binding) {
	if (p_binding.buffer.is_valid()) {
		return fmt::format("{}:{} {}", p_binding.binding, p_binding.kind == DescriptorKind::UNIFORM_BUFFER ? "uniform" : "buffer", p_binding.buffer.value);
	}
	if (p_binding.texture.is_valid()) {
		return fmt::format("{}:{} {} {} {}", p_binding.binding, p_binding.kind == DescriptorKind::STORAGE_TEXTURE ? "image" : "texture", p_binding.texture.value, range_text(p_binding.range), layout_text(p_binding.layout));
	}
	return fmt::format("{}:sampler {}", p_binding.binding, p_binding.sampler.value);
}

std::string target_text(const RenderTarget &p_target) {
	constexpr const char *LOADS[] = { "load", "clear", "dont_care" };
	return fmt::format("{} {} {}", p_target.texture.value, range_text(p_target.range), LOADS[size_t(p_target.load)]);
}

class NullDriverImpl final : public NullDriver {
public:
	NullDriverImpl() {
		device_info.name = "null";
		device_info.driver = "null";
		device_info.max_texture_2d_texels = 16384;
		device_info.max_storage_buffer_bytes = uint64_t(1) << 32;
	}
	const std::vector<std::string> &log() const override { return lines; }
	void clear_log() override { lines.clear(); }
	void set_logging(bool p_enabled) override { logging = p_enabled; }
	const DeviceInfo &info() const override { return device_info; }

	DriverBuffer create_buffer(const BufferDesc &p_desc, MemoryKind p_kind, uint64_t &r_allocated_bytes) override {
		const DriverBuffer id = { ++last_buffer };
		r_allocated_bytes = p_desc.size_bytes;
		if (p_kind != MemoryKind::DEVICE) {
			host_memory[id.value].resize(p_desc.size_bytes);
		}
		add("create_buffer {} '{}' {} bytes", id.value, p_desc.name, p_desc.size_bytes);
		return id;
	}
	std::byte *mapped(DriverBuffer p_buffer) override { return host_memory[p_buffer.value].data(); }
	DriverTexture create_texture(const TextureDesc &p_desc, uint64_t &r_allocated_bytes) override {
		r_allocated_bytes = 0;
		for (uint32_t mip = 0; mip < p_desc.mips; mip++) {
			r_allocated_bytes += p_desc.mip_size_bytes(mip) * p_desc.layer_count();
		}
		add("create_texture {} '{}' {} {}x{}x{}", last_texture + 1, p_desc.name, format_name(p_desc.format), p_desc.width, p_desc.height, p_desc.depth);
		return { ++last_texture };
	}
	DriverSampler create_sampler(const SamplerDesc &) override {
		add("create_sampler {}", last_sampler + 1);
		return { ++last_sampler };
	}
	DriverShader create_shader(std::span<const uint32_t>, const std::string &p_name) override {
		add("create_shader {} '{}'", last_shader + 1, p_name);
		return { ++last_shader };
	}
	DriverSetLayout set_layout(std::span<const DescriptorKind> p_kinds) override {
		const std::vector<DescriptorKind> key(p_kinds.begin(), p_kinds.end());
		return { set_layouts.emplace(key, set_layouts.size() + 1).first->second };
	}
	DriverSet create_set(DriverSetLayout, std::span<const DriverBinding> p_bindings, const std::string &p_name) override {
		add("create_set {} '{}' {}", last_set + 1, p_name, bindings_text(p_bindings));
		return { ++last_set };
	}
	DriverPipeline create_compute_pipeline(const ComputePipelineDesc &p_desc) override {
		add("create_compute_pipeline {} '{}'", last_pipeline + 1, p_desc.name);
		return { ++last_pipeline };
	}
	DriverPipeline create_graphics_pipeline(const GraphicsPipelineDesc &p_desc) override {
		add("create_graphics_pipeline {} '{}'", last_pipeline + 1, p_desc.name);
		return { ++last_pipeline };
	}
	void destroy(DriverBuffer p_buffer) override {
		host_memory.erase(p_buffer.value);
		add("destroy buffer {}", p_buffer.value);
	}
	void destroy(DriverTexture p_texture) override { add("destroy texture {}", p_texture.value); }
	void destroy(DriverSampler p_sampler) override { add("destroy sampler {}", p_sampler.value); }
	void destroy(DriverShader p_shader) override { add("destroy shader {}", p_shader.value); }
	void destroy(DriverSet p_set) override { add("destroy set {}", p_set.value); }
	void destroy(DriverPipeline p_pipeline) override { add("destroy pipeline {}", p_pipeline.value); }

	void begin_commands(uint32_t p_slot) override { add("begin_commands {}", p_slot); }
	void submit_commands() override { add("submit"); }
	void wait_idle() override { add("wait_idle"); }
	bool read_timestamps(uint32_t, std::span<double>) override { return false; }

	void cmd_barriers(std::span<const Barrier> p_barriers) override {
		for (const Barrier &barrier : p_barriers) {
			const std::string accesses = access_text(barrier.source) + " -> " + access_text(barrier.target);
			if (barrier.buffer.is_valid()) {
				add("barrier buffer {} {}", barrier.buffer.value, accesses);
			} else {
				add("barrier texture {} {} {}, {} -> {}", barrier.texture.value, range_text(barrier.range), accesses, layout_text(barrier.old_layout), layout_text(barrier.new_layout));
			}
		}
	}
	void cmd_begin_label(const std::string &p_name) override { add("begin '{}'", p_name); }
	void cmd_end_label() override { add("end"); }
	void cmd_timestamp(uint32_t p_index) override { add("timestamp {}", p_index); }
	void cmd_fill_buffer(DriverBuffer p_buffer, uint64_t p_offset, uint64_t p_size, uint32_t p_word) override { add("fill buffer {} {}+{} {:#x}", p_buffer.value, p_offset, p_size, p_word); }
	void cmd_update_buffer(DriverBuffer p_buffer, uint64_t p_offset, std::span<const std::byte> p_data) override { add("update buffer {} {}+{}", p_buffer.value, p_offset, p_data.size()); }
	void cmd_copy_buffer(DriverBuffer p_from, DriverBuffer p_to, uint64_t p_size, uint64_t p_from_offset, uint64_t p_to_offset) override {
		add("copy buffer {} at {} to buffer {} at {}, {} bytes", p_from.value, p_from_offset, p_to.value, p_to_offset, p_size);
	}
	void cmd_clear_texture(DriverTexture p_texture, const TextureRange &p_range, Vector4 p_value) override { add("clear texture {} {} {} {} {} {}", p_texture.value, range_text(p_range), p_value.x, p_value.y, p_value.z, p_value.w); }
	void cmd_copy_texture(DriverTexture p_from, DriverTexture p_to) override { add("copy texture {} to texture {}", p_from.value, p_to.value); }
	void cmd_copy_buffer_to_texture(DriverBuffer p_from, uint64_t p_offset, DriverTexture p_to, uint32_t p_mip, uint32_t p_layer) override {
		add("copy buffer {} at {} to texture {} mip {} layer {}", p_from.value, p_offset, p_to.value, p_mip, p_layer);
	}
	void cmd_copy_texture_to_buffer(DriverTexture p_from, uint32_t p_mip, uint32_t p_layer, DriverBuffer p_to, uint64_t p_offset) override {
		add("copy texture {} mip {} layer {} to buffer {} at {}", p_from.value, p_mip, p_layer, p_to.value, p_offset);
	}
	void cmd_bind_pipeline(DriverPipeline p_pipeline) override { add("bind pipeline {}", p_pipeline.value); }
	void cmd_bind_transient(DriverSetLayout, std::span<const DriverBinding> p_bindings) override { add("bind {}", bindings_text(p_bindings)); }
	void cmd_bind_set(DriverSet p_set) override { add("bind set {}", p_set.value); }
	void cmd_push_constants(std::span<const std::byte> p_data) override { add("push_constants {} bytes", p_data.size()); }
	void cmd_dispatch(uint32_t p_x, uint32_t p_y, uint32_t p_z) override { add("dispatch {} {} {}", p_x, p_y, p_z); }
	void cmd_dispatch_indirect(DriverBuffer p_buffer, uint64_t p_offset) override { add("dispatch_indirect buffer {} at {}", p_buffer.value, p_offset); }
	void cmd_begin_rendering(const RenderTargets &p_targets) override {
		for (const RenderTarget &target : p_targets.color) {
			add("color target {}", target_text(target));
		}
		if (p_targets.depth.texture.is_valid()) {
			add("depth target {}", target_text(p_targets.depth));
		}
		add("begin_rendering {}x{}", p_targets.size.x, p_targets.size.y);
	}
	void cmd_bind_indices(DriverBuffer p_buffer) override { add("bind indices {}", p_buffer.value); }
	void cmd_draw(uint32_t p_first_vertex, uint32_t p_count, uint32_t p_instances, uint32_t p_first_instance) override { add("draw {}+{} instances {}+{}", p_first_vertex, p_count, p_first_instance, p_instances); }
	void cmd_draw_indexed(uint32_t p_first_index, uint32_t p_count, int32_t p_vertex_offset, uint32_t p_instances, uint32_t p_first_instance) override {
		add("draw_indexed {}+{} vertex {} instances {}+{}", p_first_index, p_count, p_vertex_offset, p_first_instance, p_instances);
	}
	void cmd_end_rendering() override { add("end_rendering"); }

private:
	template <typename... Args>
	void add(fmt::format_string<Args...> p_format, Args &&...p_args) {
		if (logging) {
			lines.push_back(fmt::format(p_format, std::forward<Args>(p_args)...));
		}
	}
	static std::string bindings_text(std::span<const DriverBinding> p_bindings) {
		std::string text;
		for (const DriverBinding &binding : p_bindings) {
			text += (text.empty() ? "" : ", ") + binding_text(binding);
		}
		return text;
	}
	DeviceInfo device_info;
	bool logging = true;
	std::vector<std::string> lines;
	std::map<uint64_t, std::vector<std::byte>> host_memory;
	std::map<std::vector<DescriptorKind>, uint64_t> set_layouts;
	uint64_t last_buffer = 0, last_texture = 0, last_sampler = 0, last_shader = 0, last_set = 0, last_pipeline = 0;
};

} // namespace

std::unique_ptr<NullDriver> create_null_driver() {
	return std::make_unique<NullDriverImpl>();
}

} // namespace lucent
