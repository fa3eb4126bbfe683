// SPDX-License-Identifier: MIT
// Surfaces from and to Godot's arrays.
#include "modules/scene/mesh.h"

#include <algorithm>

namespace lucent::scene {

namespace {

const char *const ARRAY_NAMES[] = { "ARRAY_VERTEX", "ARRAY_NORMAL", "ARRAY_TANGENT", "ARRAY_COLOR", "ARRAY_TEX_UV",
	"ARRAY_TEX_UV2", "", "", "", "", "", "", "ARRAY_INDEX" };

// p_arrays[p_array] as T; empty where there is none.
template <typename T>
Status read_array(const Array &p_arrays, MeshArray p_array, T &r_values) {
	const size_t index = size_t(p_array);
	if (index >= p_arrays.size() || p_arrays[index].is_nil()) {
		return Ok();
	}
	std::optional<T> values = variant_cast<T>(p_arrays[index]);
	if (!values) {
		return make_error("{}: expected {}, got {}", ARRAY_NAMES[index], Variant::get_type_name(variant_type_of<T>()),
				Variant::get_type_name(p_arrays[index].get_type()));
	}
	r_values = std::move(*values);
	return Ok();
}

template <typename T>
bool all_finite(const std::vector<T> &p_values, size_t &r_row) {
	for (r_row = 0; r_row < p_values.size(); r_row++) {
		if (glm::any(glm::isnan(p_values[r_row])) || glm::any(glm::isinf(p_values[r_row]))) {
			return false;
		}
	}
	return true;
}

template <typename T>
Status check_rows(const std::vector<T> &p_values, size_t p_count, const char *p_what, const std::string &p_name) {
	size_t row = 0;
	if (!p_values.empty() && p_values.size() != p_count) {
		return make_error("{}: {} has {} rows, but there are {} vertices", p_name, p_what, p_values.size(), p_count);
	}
	return all_finite(p_values, row) ? Status(Ok())
									 : Status(make_error("{}: {}, row {}: must be finite", p_name, p_what, row));
}

} // namespace

Status check_surface(const MeshSurface &p_surface, const std::string &p_name) {
	const size_t count = p_surface.positions.size();
	if (count == 0 || p_surface.indices.empty() || p_surface.indices.size() % 3 != 0) {
		return make_error("{}: {} vertices and {} indices are no triangles", p_name, count, p_surface.indices.size());
	}
	for (const Status &status : { check_rows(p_surface.positions, count, "positions", p_name),
				 check_rows(p_surface.normals, count, "normals", p_name),
				 check_rows(p_surface.tangents, count, "tangents", p_name),
				 check_rows(p_surface.uvs, count, "uvs", p_name), check_rows(p_surface.uv2s, count, "uv2s", p_name),
				 check_rows(p_surface.colors, count, "colors", p_name) }) {
		if (!status) {
			return status;
		}
	}
	const auto bad = std::find_if(
			p_surface.indices.begin(), p_surface.indices.end(), [&](uint32_t p_index) { return p_index >= count; });
	if (bad != p_surface.indices.end()) {
		return make_error("{}: indices, row {}: there is no vertex {} of {}", p_name,
				(bad - p_surface.indices.begin()) / 3, int32_t(*bad), count);
	}
	return Ok();
}

Result<MeshSurface> surface_from_arrays(const Array &p_arrays) {
	MeshSurface surface;
	std::vector<float> tangents;
	std::vector<Color> colors;
	std::vector<int32_t> indices;
	if (p_arrays.size() > 13) {
		return make_error("{} arrays, expected at most Mesh.ARRAY_MAX, 13", p_arrays.size());
	}
	for (const Status &status : { read_array(p_arrays, MeshArray::VERTEX, surface.positions),
				 read_array(p_arrays, MeshArray::NORMAL, surface.normals),
				 read_array(p_arrays, MeshArray::TANGENT, tangents), read_array(p_arrays, MeshArray::COLOR, colors),
				 read_array(p_arrays, MeshArray::TEX_UV, surface.uvs),
				 read_array(p_arrays, MeshArray::TEX_UV2, surface.uv2s),
				 read_array(p_arrays, MeshArray::INDEX, indices) }) {
		if (!status) {
			return status.error();
		}
	}
	if (tangents.size() % 4 != 0) {
		return make_error("ARRAY_TANGENT: {} floats aren't 4 a vertex", tangents.size());
	}
	for (size_t i = 0; i < tangents.size(); i += 4) {
		surface.tangents.emplace_back(tangents[i], tangents[i + 1], tangents[i + 2], tangents[i + 3]);
	}
	for (const Color &color : colors) {
		surface.colors.emplace_back(color.r, color.g, color.b, color.a);
	}
	surface.indices.assign(indices.begin(), indices.end());
	for (uint32_t i = 0; indices.empty() && i < surface.positions.size(); i++) {
		surface.indices.push_back(i);
	}
	const Status status = check_surface(surface, "arrays");
	return status ? Result<MeshSurface>(std::move(surface)) : Result<MeshSurface>(status.error());
}

Array arrays_from_surface(const MeshSurface &p_surface) {
	Array arrays = Array(size_t(MeshArray::COUNT));
	const auto put = [&](MeshArray p_array, auto p_values) {
		if (!p_values.empty()) {
			arrays[size_t(p_array)] = Variant(std::move(p_values));
		}
	};
	std::vector<float> tangents;
	for (const Vector4 &tangent : p_surface.tangents) {
		tangents.insert(tangents.end(), { tangent.x, tangent.y, tangent.z, tangent.w });
	}
	std::vector<Color> colors;
	for (const Vector4 &color : p_surface.colors) {
		colors.push_back({ color.r, color.g, color.b, color.a });
	}
	put(MeshArray::VERTEX, p_surface.positions);
	put(MeshArray::NORMAL, p_surface.normals);
	put(MeshArray::TANGENT, std::move(tangents));
	put(MeshArray::COLOR, std::move(colors));
	put(MeshArray::TEX_UV, p_surface.uvs);
	put(MeshArray::TEX_UV2, p_surface.uv2s);
	put(MeshArray::INDEX, std::vector<int32_t>(p_surface.indices.begin(), p_surface.indices.end()));
	return arrays;
}

Status ArrayMesh::add_surface_from_arrays(int p_primitive, const Array &p_arrays) {
	if (p_primitive != 3) {
		return make_error(
				"ArrayMesh.add_surface_from_arrays(): only PRIMITIVE_TRIANGLES can be drawn, got {}", p_primitive);
	}
	Result<MeshSurface> surface = surface_from_arrays(p_arrays);
	if (!surface) {
		return make_error("ArrayMesh.add_surface_from_arrays(): {}", surface.error().message);
	}
	add_surface(surface.take());
	return Ok();
}

void ArrayMesh::surface_remove(int p_surface) {
	ERR_FAIL_COND_MSG(
			p_surface < 0 || p_surface >= get_surface_count(), "surface {} of {}", p_surface, get_surface_count());
	surfaces.erase(surfaces.begin() + p_surface);
	geometry_changed();
}

} // namespace lucent::scene
