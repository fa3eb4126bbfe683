// SPDX-License-Identifier: MIT
#include "servers/rendering/passes/surface_passes.h"

namespace lucent {

void depth_prepass(PassRecorder &r_recorder, const DepthPrepassInputs &p_in) {
	std::vector<DrawCommand> draws;
	draws.reserve(p_in.batches.size());
	for (const DrawBatch &batch : p_in.batches) {
		DrawState state;
		state.vertex_shader = Shader::DEPTH_PREPASS_VERT;
		state.fragment_shader = batch.draw->scissor ? Shader::DEPTH_PREPASS_SCISSOR_FRAG : Shader::DEPTH_PREPASS_FRAG;
		state.cull = cull_mode(batch.draw->cull);
		draws.push_back(make_draw(batch, p_in.assets, state));
	}
	RenderPass pass = r_recorder.render("depth_prepass");
	pass.color(0, { p_in.normal_roughness }, LoadOp::CLEAR)
			.color(1, { p_in.motion }, LoadOp::CLEAR)
			.depth({ p_in.depth }, LoadOp::CLEAR, 0.0f);
	bind_scene(pass, p_in.scene).draw(draws);
}

void opaque(PassRecorder &r_recorder, const OpaqueInputs &p_in) {
	std::vector<DrawCommand> draws;
	draws.reserve(p_in.batches.size());
	for (const DrawBatch &batch : p_in.batches) {
		DrawState state;
		state.vertex_shader = Shader::OPAQUE_VERT;
		state.fragment_shader = p_in.aov != nullptr ? Shader::OPAQUE_AOV_FRAG : Shader::OPAQUE_FRAG;
		state.cull = cull_mode(batch.draw->cull);
		state.depth_write = false;
		// The prepass decided what is seen, alpha scissors included.
		state.depth_compare = CompareOp::EQUAL;
		draws.push_back(make_draw(batch, p_in.assets, state));
	}
	RenderPass pass = r_recorder.render("opaque");
	pass.color(0, { p_in.color }, LoadOp::CLEAR);
	if (p_in.aov != nullptr) {
		uint32_t index = 1;
		for (const TextureHandle target : { p_in.aov->direct, p_in.aov->indirect_diffuse, p_in.aov->indirect_specular, p_in.aov->emission, p_in.aov->albedo }) {
			pass.color(index++, { target }, LoadOp::CLEAR);
		}
	}
	pass.depth_read_only({ p_in.depth })
			.read(SHADE_GI_IRRADIANCE, p_in.gi_irradiance)
			.read(SHADE_GI_RADIANCE, p_in.gi_radiance);
	bind_scene(pass, p_in.scene);
	bind_shading(pass, p_in.shading).draw(draws);
}

namespace {
BlendMode blend_mode(MaterialBlend p_blend) {
	switch (p_blend) {
		case MaterialBlend::ADD:
			return BlendMode::ADD;
		case MaterialBlend::SUB:
			return BlendMode::SUB;
		case MaterialBlend::MUL:
			return BlendMode::MUL;
		case MaterialBlend::PREMULTIPLIED:
			return BlendMode::PREMULTIPLIED;
		default:
			return BlendMode::MIX;
	}
}
} // namespace

void transparent(PassRecorder &r_recorder, const TransparentInputs &p_in) {
	std::vector<DrawCommand> draws;
	draws.reserve(p_in.batches.size());
	for (const DrawBatch &batch : p_in.batches) {
		DrawState state;
		state.vertex_shader = Shader::OPAQUE_VERT;
		state.fragment_shader = p_in.bind_gi ? Shader::TRANSPARENT_GI_FRAG : Shader::TRANSPARENT_FRAG;
		state.cull = cull_mode(batch.draw->cull);
		state.depth_write = false;
		state.blend = blend_mode(batch.draw->blend);
		draws.push_back(make_draw(batch, p_in.assets, state));
	}
	RenderPass pass = r_recorder.render("transparent");
	pass.color(0, { p_in.color }, LoadOp::LOAD)
			.depth_read_only({ p_in.depth });
	bind_scene(pass, p_in.scene);
	if (p_in.bind_gi) {
		p_in.bind_gi(pass);
	}
	bind_shading(pass, p_in.shading).draw(draws);
}

} // namespace lucent
