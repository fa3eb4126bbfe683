// SPDX-License-Identifier: MIT
#pragma once
// Pipelines, found or made.

#include "servers/rendering/device/pass_recorder.h"
#include "servers/rendering/device/shader_library.h"

#include <unordered_map>

namespace lucent {

struct ComputePipeline {
	DriverPipeline pipeline;
	DriverSetLayout set_layout;
};

class PipelineStore {
public:
	using Specialization = std::vector<std::pair<uint32_t, uint32_t>>;
	static constexpr size_t MAX_COLOR_TARGETS = 8;
	struct Targets {
		std::array<Format, MAX_COLOR_TARGETS> colors{};
		uint32_t color_count = 0;
		Format depth = Format::UNDEFINED;
	};

	PipelineStore(RenderingDeviceDriver &p_driver, ShaderLibrary &p_shaders) :
			driver(p_driver), shaders(p_shaders), compute(size_t(Shader::COUNT)) {}
	~PipelineStore();
	PipelineStore(const PipelineStore &) = delete;
	PipelineStore &operator=(const PipelineStore &) = delete;

	const ComputePipeline &find_compute(Shader p_shader, const Specialization &p_specialization);
	// p_set1_kinds: what p_set1 was made from, for the check against the shaders.
	DriverPipeline find_graphics(const DrawState &p_state, const Targets &p_targets, DriverSetLayout p_set0, DriverSetLayout p_set1, std::span<const DescriptorKind> p_set1_kinds);
	// Hands over every pipeline (to be destroyed when no frame uses it) after shaders were replaced.
	void take_all(std::vector<DriverPipeline> &r_pipelines);

private:
	struct ComputeVariant {
		Specialization specialization;
		ComputePipeline pipeline;
	};
	using GraphicsKey = std::array<uint32_t, 12>;
	struct KeyHash {
		size_t operator()(const GraphicsKey &p_key) const;
	};
	DriverPipeline make_graphics(const DrawState &p_state, const Targets &p_targets, DriverSetLayout p_set0, DriverSetLayout p_set1);
	RenderingDeviceDriver &driver;
	ShaderLibrary &shaders;
	std::vector<std::vector<ComputeVariant>> compute; // by shader
	std::unordered_map<GraphicsKey, DriverPipeline, KeyHash> graphics;
};

} // namespace lucent
