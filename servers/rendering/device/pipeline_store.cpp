// SPDX-License-Identifier: MIT
#include "servers/rendering/device/pipeline_store.h"

#include "servers/rendering/device/pass_checks.h"

#include <algorithm>
#include <bit>

namespace lucent {

PipelineStore::~PipelineStore() {
	std::vector<DriverPipeline> pipelines;
	take_all(pipelines);
	for (DriverPipeline pipeline : pipelines) {
		driver.destroy(pipeline);
	}
}

void PipelineStore::take_all(std::vector<DriverPipeline> &r_pipelines) {
	for (std::vector<ComputeVariant> &variants : compute) {
		for (const ComputeVariant &variant : variants) {
			r_pipelines.push_back(variant.pipeline.pipeline);
		}
		variants.clear();
	}
	for (const auto &[key, pipeline] : graphics) {
		r_pipelines.push_back(pipeline);
	}
	graphics.clear();
}

const ComputePipeline &PipelineStore::find_compute(Shader p_shader, const Specialization &p_specialization) {
	const LoadedShader &shader = shaders.get(p_shader);
	std::vector<ComputeVariant> &variants = compute[size_t(p_shader)];
	for (const ComputeVariant &variant : variants) {
		if (variant.specialization == p_specialization) {
			return variant.pipeline;
		}
	}
	INVARIANT(shader.reflection.stage == ShaderStage::COMPUTE, "'{}' is no compute shader", shader.name);
	for (const auto &[id, value] : p_specialization) {
		const std::vector<uint32_t> &ids = shader.reflection.specialization_ids;
		INVARIANT(std::find(ids.begin(), ids.end(), id) != ids.end(), "'{}' has no specialization constant {}", shader.name, id);
	}
	std::vector<DescriptorKind> kinds;
	for (const ReflectedBinding &binding : shader.reflection.bindings) {
		INVARIANT(binding.set == 0, "'{}': '{}' is in set {}; a compute shader has set 0 only", shader.name, binding.name, binding.set);
		kinds.resize(std::max(kinds.size(), size_t(binding.binding) + 1), DescriptorKind::NONE);
		kinds[binding.binding] = binding.kind;
	}
	ComputePipeline pipeline;
	pipeline.set_layout = driver.set_layout(kinds);
	pipeline.pipeline = driver.create_compute_pipeline({ shader.name, shader.module, pipeline.set_layout, p_specialization });
	INVARIANT(pipeline.pipeline.is_valid(), "'{}': the driver made no pipeline", shader.name);
	return variants.emplace_back(ComputeVariant{ p_specialization, pipeline }).pipeline;
}

size_t PipelineStore::KeyHash::operator()(const GraphicsKey &p_key) const {
	uint64_t hash = 14695981039346656037ull; // FNV-1a over words
	for (uint32_t word : p_key) {
		hash = (hash ^ word) * 1099511628211ull;
	}
	return size_t(hash ^ (hash >> 29));
}

DriverPipeline PipelineStore::find_graphics(const DrawState &p_state, const Targets &p_targets, DriverSetLayout p_set0, DriverSetLayout p_set1, std::span<const DescriptorKind> p_set1_kinds) {
	GraphicsKey key = {};
	key[0] = uint32_t(p_state.vertex_shader) | uint32_t(p_state.fragment_shader) << 16;
	key[1] = uint32_t(p_state.cull) | uint32_t(p_state.depth_compare) << 4 | uint32_t(p_state.blend) << 8 | uint32_t(p_state.front_face_clockwise) << 16 |
			uint32_t(p_state.depth_test) << 17 | uint32_t(p_state.depth_write) << 18 | uint32_t(p_state.depth_clamp) << 19 | p_targets.color_count << 24;
	key[2] = std::bit_cast<uint32_t>(p_state.depth_bias_constant);
	key[3] = std::bit_cast<uint32_t>(p_state.depth_bias_slope);
	for (size_t i = 0; i < MAX_COLOR_TARGETS; i++) {
		key[4 + i / 4] |= uint32_t(p_targets.colors[i]) << (i % 4 * 8);
	}
	key[6] = uint32_t(p_targets.depth);
	key[7] = uint32_t(p_set0.value);
	key[8] = uint32_t(p_set0.value >> 32);
	key[9] = uint32_t(p_set1.value);
	key[10] = uint32_t(p_set1.value >> 32);
	DriverPipeline &pipeline = graphics[key];
	if (!pipeline.is_valid()) {
		for (Shader shader : { p_state.vertex_shader, p_state.fragment_shader }) {
			if (shader != Shader::NONE) {
				const LoadedShader &loaded = shaders.get(shader);
				const std::string wrong = check_set1(p_set1_kinds, loaded.reflection);
				INVARIANT(wrong.empty(), "'{}': {}", loaded.name, wrong);
			}
		}
		pipeline = make_graphics(p_state, p_targets, p_set0, p_set1);
	}
	return pipeline;
}

DriverPipeline PipelineStore::make_graphics(const DrawState &p_state, const Targets &p_targets, DriverSetLayout p_set0, DriverSetLayout p_set1) {
	const LoadedShader &vertex = shaders.get(p_state.vertex_shader);
	INVARIANT(vertex.reflection.stage == ShaderStage::VERTEX, "'{}' is no vertex shader", vertex.name);
	GraphicsPipelineDesc desc;
	desc.name = vertex.name;
	desc.vertex_shader = vertex.module;
	if (p_state.fragment_shader != Shader::NONE) {
		const LoadedShader &fragment = shaders.get(p_state.fragment_shader);
		INVARIANT(fragment.reflection.stage == ShaderStage::FRAGMENT, "'{}' is no fragment shader", fragment.name);
		desc.name = fragment.name;
		desc.fragment_shader = fragment.module;
	}
	desc.set_layouts[0] = p_set0;
	desc.set_layouts[1] = p_set1;
	desc.color_formats.assign(p_targets.colors.begin(), p_targets.colors.begin() + p_targets.color_count);
	desc.depth_format = p_targets.depth;
	desc.cull = p_state.cull;
	desc.front_face_clockwise = p_state.front_face_clockwise;
	desc.depth_test = p_state.depth_test;
	desc.depth_write = p_state.depth_write;
	desc.depth_compare = p_state.depth_compare;
	desc.blend = p_state.blend;
	desc.depth_bias_constant = p_state.depth_bias_constant;
	desc.depth_bias_slope = p_state.depth_bias_slope;
	desc.depth_clamp = p_state.depth_clamp;
	const DriverPipeline pipeline = driver.create_graphics_pipeline(desc);
	INVARIANT(pipeline.is_valid(), "'{}': the driver made no pipeline", desc.name);
	return pipeline;
}

} // namespace lucent
