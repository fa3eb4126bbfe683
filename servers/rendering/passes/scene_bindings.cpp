// SPDX-License-Identifier: MIT
#include "servers/rendering/passes/scene_bindings.h"

namespace lucent {

RenderPass &bind_geometry(RenderPass &r_pass, const SceneBindings &p_scene) {
	return r_pass.read(RASTER_POSITIONS, p_scene.positions)
			.read(RASTER_ATTRIBUTES, p_scene.attributes)
			.read(RASTER_INSTANCES, p_scene.instances)
			.read(RASTER_DRAW_INSTANCES, p_scene.draw_instances)
			.indices(p_scene.indices);
}

RenderPass &bind_scene(RenderPass &r_pass, const SceneBindings &p_scene) {
	return bind_geometry(r_pass, p_scene).uniform(RASTER_FRAME, p_scene.frame).read(RASTER_MATERIALS, p_scene.materials);
}

RenderPass &bind_shading(RenderPass &r_pass, const ShadingBindings &p_shading) {
	return r_pass.read(SHADE_LIGHTS, p_shading.lights)
			.read(SHADE_CLUSTERS, p_shading.clusters)
			.read(SHADE_SHADOW_VIEWS, p_shading.shadow_views)
			.read(SHADE_SUN_SHADOWS, p_shading.sun_shadows)
			.read(SHADE_LIGHT_SHADOWS, p_shading.light_shadows)
			.sampler(SHADE_SHADOW_SAMPLER, p_shading.shadow_sampler)
			.read(SHADE_SKY_IRRADIANCE, p_shading.sky_irradiance)
			.read(SHADE_SKY_RADIANCE, p_shading.sky_radiance)
			.read(SHADE_ENVIRONMENT_BRDF, p_shading.environment_brdf)
			.sampler(SHADE_LINEAR_SAMPLER, p_shading.linear_sampler);
}

CullMode cull_mode(MaterialCull p_cull) {
	switch (p_cull) {
		case MaterialCull::FRONT:
			return CullMode::FRONT;
		case MaterialCull::DISABLED:
			return CullMode::NONE;
		default:
			return CullMode::BACK;
	}
}

DrawCommand make_draw(const DrawBatch &p_batch, const GpuAssets &p_assets, const DrawState &p_state) {
	const SceneDraw &draw = *p_batch.draw;
	DrawCommand command;
	command.state = p_state;
	command.state.front_face_clockwise = draw.mirrored;
	command.material = p_assets.material_set(draw.material);
	command.first_index = draw.geometry.first_index;
	command.index_count = draw.geometry.index_count;
	command.vertex_offset = draw.geometry.vertex_offset;
	command.instance_count = p_batch.instance_count;
	command.first_instance = p_batch.first_instance;
	command.set_constants(shader::DrawConstants{ draw.material });
	return command;
}

} // namespace lucent
