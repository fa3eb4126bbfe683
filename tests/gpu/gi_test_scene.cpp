// SPDX-License-Identifier: MIT
#include "tests/gpu/gi_test_scene.h"

#include <cstring>

namespace lucent {

namespace {

template <typename T>
OwnedBuffer upload_vector(RenderingDevice &p_device, const std::vector<T> &p_values, const char *p_name, uint32_t p_usage = BUFFER_STORAGE) {
	const std::vector<T> values = p_values.empty() ? std::vector<T>(1) : p_values;
	OwnedBuffer buffer = p_device.create_buffer({ .size_bytes = values.size() * sizeof(T), .usage = p_usage, .name = p_name });
	p_device.upload_buffer(buffer, values);
	return buffer;
}

uint16_t half_from_float(float p_value) {
	return uint16_t(glm::packHalf2x16(Vector2(p_value, 0.0f)) & 0xFFFF);
}

Vector3 decode_half(const uint16_t *p_texel) {
	Vector3 result;
	for (int i = 0; i < 3; i++) {
		result[i] = glm::unpackHalf2x16(p_texel[i]).x;
	}
	return result;
}

} // namespace

uint32_t GiTestScene::add_material(const Vector3 &p_albedo, const Vector3 &p_emission, bool p_double_sided) {
	shader::MaterialData material{};
	material.gi_of_albedo = 1.0f;
	material.albedo = Vector4(p_albedo, 1.0f);
	material.emission = p_emission;
	material.roughness = 1.0f;
	material.gi_albedo_layer = -1;
	material.gi_emission_layer = -1;
	material.flags = p_double_sided ? MATERIAL_FLAG_DOUBLE_SIDED : 0;
	materials.push_back(material);
	return uint32_t(materials.size() - 1);
}

void GiTestScene::add_triangle(const Vector3 &p_a, const Vector3 &p_b, const Vector3 &p_c, uint32_t p_material) {
	corners.insert(corners.end(), { p_a, p_b, p_c });
	triangle_materials.push_back(p_material);
}

void GiTestScene::add_quad(const Vector3 &p_a, const Vector3 &p_b, const Vector3 &p_c, const Vector3 &p_d, uint32_t p_material) {
	add_triangle(p_a, p_b, p_c, p_material);
	add_triangle(p_a, p_c, p_d, p_material);
}

void GiTestScene::add_box(const Vector3 &p_min, const Vector3 &p_max, uint32_t p_material, bool p_inward) {
	for (int axis = 0; axis < 3; axis++) {
		for (int side = 0; side < 2; side++) {
			const int u = (axis + 1) % 3;
			const int v = (axis + 2) % 3;
			Vector3 quad[4];
			for (int i = 0; i < 4; i++) {
				quad[i][axis] = side ? p_max[axis] : p_min[axis];
				quad[i][u] = (i == 1 || i == 2) ? p_max[u] : p_min[u];
				quad[i][v] = i >= 2 ? p_max[v] : p_min[v];
			}
			if ((side == 1) != p_inward) {
				add_quad(quad[0], quad[1], quad[2], quad[3], p_material);
			} else {
				add_quad(quad[3], quad[2], quad[1], quad[0], p_material);
			}
		}
	}
}

void GiTestScene::set_sky(const Vector3 &p_above, const Vector3 &p_below) {
	sky_above = p_above;
	sky_below = p_below;
}

// Triangles of each surface.
std::vector<std::vector<size_t>> GiTestScene::surfaces(const GiTestOrder &p_order) const {
	std::vector<std::vector<size_t>> result;
	for (uint32_t material = 0; material < materials.size(); material++) {
		std::vector<size_t> triangles;
		for (size_t t = 0; t < triangle_materials.size(); t++) {
			if (triangle_materials[t] == material) {
				triangles.push_back(t);
			}
		}
		if (p_order.reversed) {
			std::reverse(triangles.begin(), triangles.end());
		}
		const auto middle = triangles.begin() + ptrdiff_t(p_order.split ? triangles.size() / 2 : 0);
		for (const std::vector<size_t> &part : { std::vector<size_t>(triangles.begin(), middle), std::vector<size_t>(middle, triangles.end()) }) {
			if (!part.empty()) {
				result.push_back(part);
			}
		}
	}
	if (p_order.reversed) {
		std::reverse(result.begin(), result.end());
	}
	return result;
}

GiSceneView GiTestScene::upload(const GiTestOrder &p_order) {
	std::vector<uint32_t> index_list;
	std::vector<Vector3> sorted;
	GiSceneView view;
	shader::InstanceData instance{};
	for (int i = 0; i < 3; i++) {
		instance.world_from_local[i][i] = 1.0f;
	}
	for (const std::vector<size_t> &triangles : surfaces(p_order)) {
		view.gi_surfaces.push_back({ .first_triangle = view.gi_triangle_count, .world_triangle = view.gi_triangle_count, .first_index = uint32_t(index_list.size()), .vertex_offset = 0, .instance = 0, .material = triangle_materials[triangles[0]] });
		AABB box;
		for (const size_t t : triangles) {
			for (size_t i = 0; i < 3; i++) {
				index_list.push_back(uint32_t(sorted.size()));
				sorted.push_back(corners[t * 3 + i]);
				box.expand_to(sorted.back());
			}
		}
		view.gi_triangle_count += uint32_t(triangles.size());
		view.gi_surface_boxes.push_back(box);
	}
	positions = upload_vector(device, sorted, "test.positions");
	attributes = upload_vector(device, std::vector<shader::VertexAttributes>(sorted.size() + 1), "test.attributes");
	indices = upload_vector(device, index_list, "test.indices", BUFFER_STORAGE | BUFFER_INDEX);
	instances = upload_vector(device, std::vector{ instance }, "test.instances");
	material_buffer = upload_vector(device, materials, "test.materials");
	light_buffer = upload_vector(device, lights, "test.lights");
	textures = device.create_texture({ .type = TextureType::TEXTURE_2D_ARRAY, .format = Format::RGBA8_SRGB, .layers = 1, .name = "test.gi_textures" });
	// Octahedral: y > 0 is x + y > 0 … in the inner square, so decide texel by texel.
	constexpr uint32_t SIZE = 64;
	sky = device.create_texture({ .format = Format::RGBA16_FLOAT, .width = SIZE, .height = SIZE, .name = "test.sky" });
	std::vector<uint16_t> texels;
	for (uint32_t y = 0; y < SIZE; y++) {
		for (uint32_t x = 0; x < SIZE; x++) {
			Vector2 p = (Vector2(float(x), float(y)) + 0.5f) / float(SIZE) * 2.0f - 1.0f;
			const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
			const float direction_y = z >= 0.0f ? p.y : (1.0f - std::abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f);
			const Vector3 color = direction_y >= 0.0f ? sky_above : sky_below;
			texels.insert(texels.end(), { half_from_float(color.x), half_from_float(color.y), half_from_float(color.z), half_from_float(1.0f) });
		}
	}
	device.upload_texture(sky, 0, 0, std::as_bytes(std::span(texels)));
	view.positions = positions;
	view.attributes = attributes;
	view.indices = indices;
	view.instances = instances;
	view.materials = material_buffer;
	view.lights = light_buffer;
	view.light_count = uint32_t(lights.size());
	view.gi_textures = textures;
	view.gi_sampler = device.sampler({});
	view.sky_octahedral = sky;
	view.geometry_version = ++version;
	view.light_version = version;
	return view;
}

std::vector<Vector3> gather_at(RenderingDevice &p_device, Sdfgi &r_sdfgi, const std::vector<Vector3> &p_points_m, const std::vector<Vector3> &p_normals) {
	std::vector<Vector3> result;
	const OwnedTexture depth = p_device.create_texture({ .format = Format::D32_FLOAT, .usage = TEXTURE_SAMPLED | TEXTURE_DEPTH_TARGET, .name = "test.depth" });
	const OwnedTexture normal = p_device.create_texture({ .format = Format::RGBA16_FLOAT, .usage = TEXTURE_SAMPLED | TEXTURE_COLOR_TARGET, .name = "test.normal" });
	const OwnedTexture irradiance = p_device.create_texture({ .format = Format::RGBA16_FLOAT, .usage = TEXTURE_SAMPLED | TEXTURE_STORAGE, .name = "test.irradiance" });
	const OwnedTexture radiance = p_device.create_texture({ .format = Format::RGBA16_FLOAT, .usage = TEXTURE_SAMPLED | TEXTURE_STORAGE, .name = "test.radiance" });
	for (size_t i = 0; i < p_points_m.size(); i++) {
		PassRecorder &recorder = p_device.begin_frame();
		recorder.render("test.surface").color(0, { normal }, LoadOp::CLEAR, Vector4(p_normals[i], 2.0f)).depth({ depth }, LoadOp::CLEAR, 0.5f).draw({});
		GiGatherInputs inputs = { .depth = depth, .normal_roughness = normal, .irradiance = irradiance, .radiance = radiance, .width = 1, .height = 1 };
		// Every clip position is the point.
		inputs.world_from_clip = Projection(0.0f);
		inputs.world_from_clip[3] = Vector4(p_points_m[i], 1.0f);
		inputs.camera_position_m = p_points_m[i] + p_normals[i];
		r_sdfgi.gather(recorder, inputs);
		p_device.end_frame();
		const std::vector<std::byte> texel = p_device.read_back_texture(irradiance);
		uint16_t values[4];
		std::memcpy(values, texel.data(), sizeof(values));
		result.push_back(decode_half(values));
	}
	return result;
}

uint32_t run_sdfgi(RenderingDevice &p_device, Sdfgi &r_sdfgi, const SdfgiSettings &p_settings, const GiSceneView &p_view, const Vector3 &p_camera_m, uint32_t p_max_frames) {
	uint32_t frames = 0;
	while (frames < p_max_frames && !r_sdfgi.stats().converged) {
		PassRecorder &recorder = p_device.begin_frame();
		r_sdfgi.update(recorder, p_settings, p_view, p_camera_m);
		p_device.end_frame();
		r_sdfgi.after_frame();
		frames++;
	}
	return frames;
}

} // namespace lucent
