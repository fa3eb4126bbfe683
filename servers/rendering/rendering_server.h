// SPDX-License-Identifier: MIT
#pragma once
// The public rendering API: ids in, pictures out; works without any node. Godot's names. Setters with a stale id print an error and
// do nothing; getters return the documented default. One calling thread.

#include "servers/rendering/render_scene.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lucent {

class RenderingDevice;
struct PassTiming;
struct MemoryReport;

struct FrameStats {
	GiStats gi;
	uint64_t draws = 0;
	uint64_t triangles = 0;
	uint64_t lights = 0;
	std::vector<std::pair<std::string, double>> pass_ms; // GPU milliseconds by pass, in order
};

class RenderingServer {
public:
	// p_device null: scene data only (snapshots, tests); draw() fails.
	explicit RenderingServer(RenderingDevice *p_device);
	~RenderingServer();
	// Gives a server that was made without a device one, so that draw() works; it must have none yet.
	void open_device(RenderingDevice &r_device);
	RenderingServer(const RenderingServer &) = delete;
	RenderingServer &operator=(const RenderingServer &) = delete;

	// Textures. p_srgb: RGBA8 texels are sRGB-encoded.
	TextureRid texture_2d_create(std::shared_ptr<const Image> p_image, bool p_srgb);
	void texture_2d_update(TextureRid p_texture, std::shared_ptr<const Image> p_image, bool p_srgb);

	MaterialRid material_create();
	void material_set(MaterialRid p_material, const Material &p_parameters); // version is the server's

	MeshRid mesh_create();
	void mesh_clear(MeshRid p_mesh);
	void mesh_add_surface(MeshRid p_mesh, MeshSurface p_surface); // NaN positions, indices out of range: error, nothing added
	void mesh_surface_set_material(MeshRid p_mesh, uint32_t p_surface, MaterialRid p_material);
	AABB mesh_get_aabb(MeshRid p_mesh) const;

	LightRid directional_light_create();
	LightRid omni_light_create();
	LightRid spot_light_create();
	void light_set(LightRid p_light, const Light &p_parameters); // type and version are the server's

	ScenarioRid scenario_create();
	void scenario_set_environment(ScenarioRid p_scenario, EnvironmentRid p_environment);
	void scenario_set_fallback_environment(ScenarioRid p_scenario, EnvironmentRid p_environment);

	InstanceRid instance_create();
	void instance_set_base(InstanceRid p_instance, MeshRid p_mesh);
	void instance_set_base(InstanceRid p_instance, LightRid p_light);
	void instance_set_scenario(InstanceRid p_instance, ScenarioRid p_scenario);
	void instance_set_transform(InstanceRid p_instance, const Transform3D &p_transform);
	void instance_set_visible(InstanceRid p_instance, bool p_visible);
	void instance_set_layer_mask(InstanceRid p_instance, uint32_t p_mask);
	void instance_set_surface_override_material(InstanceRid p_instance, uint32_t p_surface, MaterialRid p_material);
	void instance_geometry_set_material_override(InstanceRid p_instance, MaterialRid p_material);
	void instance_geometry_set_gi_mode(InstanceRid p_instance, GiMode p_mode);
	void instance_geometry_set_cast_shadows_setting(InstanceRid p_instance, ShadowCasting p_setting);
	void instance_geometry_set_transparency(InstanceRid p_instance, float p_transparency);

	SkyRid sky_create();
	void sky_set(SkyRid p_sky, const Sky &p_parameters);

	EnvironmentRid environment_create();
	void environment_set_background(EnvironmentRid p_environment, BackgroundMode p_mode);
	void environment_set_bg_color(EnvironmentRid p_environment, const Vector3 &p_linear);
	void environment_set_bg_energy(EnvironmentRid p_environment, float p_energy);
	void environment_set_sky(EnvironmentRid p_environment, SkyRid p_sky);
	void environment_set_sky_custom_fov(EnvironmentRid p_environment, float p_fov_degrees); // up to 180; 0: the camera's
	void environment_set_sky_orientation(EnvironmentRid p_environment, const Basis &p_orientation);
	void environment_set_ambient_light(EnvironmentRid p_environment, const Vector3 &p_linear, AmbientSource p_source, float p_energy, float p_sky_contribution);
	void environment_set_tonemap(EnvironmentRid p_environment, ToneMapper p_tone_mapper, float p_exposure, float p_white);
	// Settings out of their ranges (sdfgi_settings.h): an error, and nothing changes.
	void environment_set_sdfgi(EnvironmentRid p_environment, const SdfgiSettings &p_settings);

	CameraRid camera_create();
	void camera_set(CameraRid p_camera, const Camera &p_parameters);
	void camera_set_transform(CameraRid p_camera, const Transform3D &p_transform);

	ViewportRid viewport_create();
	void viewport_set_size(ViewportRid p_viewport, uint32_t p_width, uint32_t p_height); // 1 to 16384 an axis, and the device's limit
	void viewport_set_scenario(ViewportRid p_viewport, ScenarioRid p_scenario);
	void viewport_attach_camera(ViewportRid p_viewport, CameraRid p_camera);
	// False: draw() advances the world's indirect light for this viewport and leaves its picture, whose light needs many frames, for later.
	void viewport_set_picture_enabled(ViewportRid p_viewport, bool p_enabled);
	void viewport_set_debug_view(ViewportRid p_viewport, const std::string &p_view);
	void viewport_set_aov(ViewportRid p_viewport, bool p_enabled);
	// Waits for the GPU. COLOR_LINEAR: scene-referred, before exposure and tone mapping; COLOR_DISPLAY: tone-mapped, sRGB-encoded 0..1.
	ViewportImage viewport_get_image(ViewportRid p_viewport, ViewportBuffer p_buffer);

	void free(TextureRid p_rid);
	void free(MaterialRid p_rid);
	void free(MeshRid p_rid);
	void free(LightRid p_rid);
	void free(InstanceRid p_rid);
	void free(SkyRid p_rid);
	void free(EnvironmentRid p_rid);
	void free(CameraRid p_rid);
	void free(ScenarioRid p_rid);
	void free(ViewportRid p_rid);

	// Draws every viewport that has a scenario, a camera and a size, once.
	void draw();
	FrameStats get_frame_stats() const;
	std::vector<std::string> get_debug_views() const;

	// The scene as it stands: CPU meshes, textures, lights, environments. Valid until the next edit.
	const RenderScene &scenario_snapshot() const;
	RenderingDevice *get_rendering_device() const;

private:
	struct Impl;
	std::unique_ptr<Impl> impl;
};

} // namespace lucent
