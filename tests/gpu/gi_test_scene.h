// SPDX-License-Identifier: MIT
#pragma once
// A scene for GI tests without server and raster passes: boxes and quads of plain materials, a constant sky, lamps.

#include "servers/rendering/device/rendering_device.h"
#include "servers/rendering/gi/sdfgi/sdfgi.h"
#include "servers/rendering/gpu_scene.h"

#include <vector>

namespace lucent {

struct GiTestOrder {
	bool reversed = false; // the last material and its last triangle come first
	bool split = false; // two surfaces a material
};

class GiTestScene {
public:
	explicit GiTestScene(RenderingDevice &p_device) :
			device(p_device) {}

	uint32_t add_material(const Vector3 &p_albedo, const Vector3 &p_emission = Vector3(0.0f), bool p_double_sided = false);
	// Counter-clockwise from the front: a, b, c, d.
	void add_quad(const Vector3 &p_a, const Vector3 &p_b, const Vector3 &p_c, const Vector3 &p_d, uint32_t p_material);
	void add_triangle(const Vector3 &p_a, const Vector3 &p_b, const Vector3 &p_c, uint32_t p_material);
	// Where what is added from now on stands: world from local.
	void set_frame(const Projection &p_frame) { frame = p_frame; }
	void add_box(const Vector3 &p_min, const Vector3 &p_max, uint32_t p_material, bool p_inward = false);
	void add_light(const shader::LightData &p_light) { lights.push_back(p_light); }
	void set_sky(const Vector3 &p_above, const Vector3 &p_below);

	// Sends all to the device: a surface a material. Call outside of a frame. Other orders hold the same triangles.
	GiSceneView upload(const GiTestOrder &p_order = {});
	const std::vector<Vector3> &triangle_corners() const { return corners; }

private:
	std::vector<std::vector<size_t>> surfaces(const GiTestOrder &p_order) const;

	RenderingDevice &device;
	Projection frame{ 1.0f };
	std::vector<Vector3> corners; // three a triangle
	std::vector<uint32_t> triangle_materials;
	std::vector<shader::MaterialData> materials;
	std::vector<shader::LightData> lights;
	Vector3 sky_above{ 0.0f };
	Vector3 sky_below{ 0.0f };
	uint64_t version = 0;
	OwnedBuffer positions, attributes, indices, instances, material_buffer, light_buffer;
	OwnedTexture textures, sky;
};

// A rectangle of a surface, seen by a pixel each `width` x `height` parts of it.
struct GiTestPatch {
	Vector3 center_m;
	Vector3 u_m; // its sides
	Vector3 v_m;
	Vector3 normal;
	Vector3 eye_m;
	uint32_t width = 1;
	uint32_t height = 1;
};
// Irradiance / pi of its pixels, row by row, as an opaque surface there would read it from GI.
std::vector<Vector3> gather_patch(RenderingDevice &p_device, Sdfgi &r_sdfgi, const GiTestPatch &p_patch);

// Irradiance / pi at points with normals, as an opaque surface there would read it from GI: fills a depth and a normal image of one
// row and runs the gather. View direction: the normal.
std::vector<Vector3> gather_at(RenderingDevice &p_device, Sdfgi &r_sdfgi, const std::vector<Vector3> &p_points_m, const std::vector<Vector3> &p_normals);

// Runs frames until SDFGI has settled or p_max_frames have passed; returns the frames.
uint32_t run_sdfgi(RenderingDevice &p_device, Sdfgi &r_sdfgi, const SdfgiSettings &p_settings, const GiSceneView &p_view, const Vector3 &p_camera_m, uint32_t p_max_frames);

} // namespace lucent
