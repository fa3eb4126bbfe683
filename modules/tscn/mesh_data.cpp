// SPDX-License-Identifier: MIT
#include "modules/tscn/mesh_data.h"

#include "modules/scene/load_report.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <optional>

namespace lucent {

namespace {

// RenderingServer::ArrayFormat
constexpr uint64_t FORMAT_VERTEX = 1u << 0;
constexpr uint64_t FORMAT_NORMAL = 1u << 1;
constexpr uint64_t FORMAT_TANGENT = 1u << 2;
constexpr uint64_t FORMAT_COLOR = 1u << 3;
constexpr uint64_t FORMAT_UV = 1u << 4;
constexpr uint64_t FORMAT_UV2 = 1u << 5;
constexpr uint32_t CUSTOM_CHANNELS = 4;
constexpr uint32_t CUSTOM_FIRST_BIT = 6;
constexpr uint32_t CUSTOM_TYPE_FIRST_BIT = 13; // 3 bits a channel
constexpr uint32_t CUSTOM_TYPE_BYTES[8] = { 4, 4, 4, 8, 4, 8, 12, 16 };
constexpr uint64_t FLAG_2D_VERTICES = uint64_t(1) << 25;
constexpr uint64_t FLAG_COMPRESSED = uint64_t(1) << 29;
constexpr uint32_t VERSION_FIRST_BIT = 35; // 8 bits. 0: up to Godot 4.1, 1: since 4.2
constexpr int64_t PRIMITIVE_TRIANGLES = 3;
constexpr int64_t PRIMITIVE_TRIANGLE_STRIP = 4;
constexpr uint64_t MAX_16_BIT_VERTICES = 65536;

using Bytes = std::vector<uint8_t>;

// Where things lie. Version 0 interleaves positions with normals and tangents; version 1 puts the latter behind all positions.
struct Layout {
	uint64_t position_stride = 0; // bytes, here and below
	uint64_t normal_start = 0;
	uint64_t normal_stride = 0;
	uint64_t vertex_bytes = 0;
	uint64_t color = 0, uv = 0, uv2 = 0; // offsets in an element of attribute_data
	uint64_t attribute_stride = 0;
};

Layout make_layout(uint64_t p_format, uint64_t p_vertex_count) {
	const auto has = [&](uint64_t p_flag) { return (p_format & p_flag) != 0; };
	const bool compressed = has(FLAG_COMPRESSED);
	Layout layout;
	const uint64_t position_bytes = compressed ? 8 : 12;
	// A compressed tangent is an angle, beside the position.
	const uint64_t normal_bytes = (has(FORMAT_NORMAL) ? 4 : 0) + (has(FORMAT_TANGENT) && !compressed ? 4 : 0);
	if (((p_format >> VERSION_FIRST_BIT) & 0xFF) == 0) {
		layout.position_stride = layout.normal_stride = position_bytes + normal_bytes;
		layout.normal_start = position_bytes;
	} else {
		layout.position_stride = position_bytes;
		layout.normal_start = position_bytes * p_vertex_count;
		layout.normal_stride = normal_bytes;
	}
	layout.vertex_bytes = (position_bytes + normal_bytes) * p_vertex_count;
	const uint64_t uv_bytes = compressed ? 4 : 8;
	const auto place = [&](uint64_t p_flag, uint64_t p_bytes) {
		const uint64_t offset = layout.attribute_stride;
		layout.attribute_stride += has(p_flag) ? p_bytes : 0;
		return offset;
	};
	layout.color = place(FORMAT_COLOR, 4);
	layout.uv = place(FORMAT_UV, uv_bytes);
	layout.uv2 = place(FORMAT_UV2, uv_bytes);
	for (uint32_t i = 0; i < CUSTOM_CHANNELS; i++) {
		place(uint64_t(1) << (CUSTOM_FIRST_BIT + i), CUSTOM_TYPE_BYTES[(p_format >> (CUSTOM_TYPE_FIRST_BIT + 3 * i)) & 7]);
	}
	return layout;
}

template <typename T>
T read(const Bytes &p_bytes, uint64_t p_offset) {
	T value;
	std::memcpy(&value, &p_bytes[p_offset], sizeof(T));
	return value;
}

float read_unorm16(const Bytes &p_bytes, uint64_t p_offset) {
	return float(read<uint16_t>(p_bytes, p_offset)) / 65535.0f;
}

Vector2 read_unorm16_pair(const Bytes &p_bytes, uint64_t p_offset) {
	return { read_unorm16(p_bytes, p_offset), read_unorm16(p_bytes, p_offset + 2) };
}

// Meyer et al., "On Floating-Point Normal Vectors" (2010); both coordinates in -1 to 1.
Vector3 octahedral_decode(const Vector2 &p_oct) {
	Vector3 n(p_oct, 1.0f - std::abs(p_oct.x) - std::abs(p_oct.y));
	const float fold = std::max(-n.z, 0.0f);
	n.x += n.x >= 0.0f ? -fold : fold;
	n.y += n.y >= 0.0f ? -fold : fold;
	return glm::normalize(n);
}

// y carries the sign of the bitangent in its upper bit.
Vector4 tangent_decode(const Vector2 &p_unorm) {
	const float y = p_unorm.y * 2.0f - 1.0f;
	return { octahedral_decode({ p_unorm.x * 2.0f - 1.0f, std::abs(y) * 2.0f - 1.0f }), y >= 0.0f ? 1.0f : -1.0f };
}

// The frame (tangent, bitangent, normal) as rows of a rotation by an angle about an axis; the half in which p_angle lies is the sign.
void axis_angle_decode(const Vector3 &p_axis, float p_angle, Vector3 &r_normal, Vector4 &r_tangent) {
	const float angle = std::abs(p_angle * 2.0f - 1.0f) * glm::pi<float>();
	const float c = std::cos(angle);
	const Vector3 s = std::sin(angle) * p_axis;
	r_tangent = { (1.0f - c) * p_axis.x * p_axis + Vector3(c, -s.z, s.y), p_angle > 0.5f ? 1.0f : -1.0f };
	r_normal = (1.0f - c) * p_axis.z * p_axis + Vector3(-s.y, s.x, c);
}

class SurfaceReader {
public:
	explicit SurfaceReader(const Dictionary &p_surface) :
			source(p_surface) {}

	Result<MeshSurface> read_surface() {
		if (Status status = check(); !status) {
			return status.error();
		}
		for (uint64_t i = 0; i < vertex_count; i++) {
			read_vertex(i);
			read_attributes(i);
			if (!glm::all(glm::lessThan(glm::abs(surface.positions[i]), Vector3(std::numeric_limits<float>::max())))) {
				return make_error("position {} is not finite", i);
			}
		}
		if (Status status = read_indices(); !status) {
			return status.error();
		}
		return std::move(surface);
	}

private:
	bool has(uint64_t p_flag) const { return (format & p_flag) != 0; }

	template <typename T>
	T value(const char *p_key, T p_default = {}) const {
		const Variant *found = source.find(p_key);
		return found != nullptr ? variant_or<T>(*found, p_default) : p_default;
	}

	Status check() {
		format = uint64_t(value<int64_t>("format"));
		primitive = value<int64_t>("primitive", -1);
		const int64_t count = value<int64_t>("vertex_count");
		vertices = value<Bytes>("vertex_data");
		attributes = value<Bytes>("attribute_data");
		indices = value<Bytes>("index_data");
		box = value<AABB>("aabb");
		uv_scale = value<Vector4>("uv_scale");
		if (primitive != PRIMITIVE_TRIANGLES && primitive != PRIMITIVE_TRIANGLE_STRIP) {
			return make_error("primitive {} is no triangles (3) and no triangle strip (4)", primitive);
		}
		if (!has(FORMAT_VERTEX) || has(FLAG_2D_VERTICES) || ((format >> VERSION_FIRST_BIT) & 0xFF) > 1) {
			return make_error("format {} is not that of a mesh in space", format);
		}
		if (count <= 0 || count > std::numeric_limits<uint32_t>::max()) {
			return make_error("vertex_count is {}", count);
		}
		vertex_count = uint64_t(count);
		layout = make_layout(format, vertex_count);
		if (vertices.size() != layout.vertex_bytes || attributes.size() != layout.attribute_stride * vertex_count) {
			return make_error("vertex_data and attribute_data have {} and {} bytes; {} vertices of format {} have {} and {}", vertices.size(), attributes.size(), count, format, layout.vertex_bytes, layout.attribute_stride * vertex_count);
		}
		if (has(FLAG_COMPRESSED) && source.find("aabb") == nullptr) {
			return make_error("compressed positions need an aabb");
		}
		return Ok();
	}

	void read_vertex(uint64_t p_index) {
		const uint64_t at = layout.position_stride * p_index;
		const uint64_t normal_at = layout.normal_start + layout.normal_stride * p_index;
		if (!has(FLAG_COMPRESSED)) {
			surface.positions.push_back({ read<float>(vertices, at), read<float>(vertices, at + 4), read<float>(vertices, at + 8) });
			if (has(FORMAT_NORMAL)) {
				surface.normals.push_back(octahedral_decode(read_unorm16_pair(vertices, normal_at) * 2.0f - 1.0f));
			}
			if (has(FORMAT_TANGENT)) {
				surface.tangents.push_back(tangent_decode(read_unorm16_pair(vertices, normal_at + (has(FORMAT_NORMAL) ? 4 : 0))));
			}
			return;
		}
		const Vector3 part(read_unorm16_pair(vertices, at), read_unorm16(vertices, at + 4));
		surface.positions.push_back(box.min + (box.max - box.min) * part);
		if (has(FORMAT_NORMAL)) {
			Vector3 normal;
			Vector4 tangent;
			axis_angle_decode(octahedral_decode(read_unorm16_pair(vertices, normal_at) * 2.0f - 1.0f), read_unorm16(vertices, at + 6), normal, tangent);
			surface.normals.push_back(normal);
			if (has(FORMAT_TANGENT)) {
				surface.tangents.push_back(tangent);
			}
		}
	}

	Vector2 read_uv(uint64_t p_at, const Vector2 &p_scale) const {
		if (!has(FLAG_COMPRESSED)) {
			const Vector2 uv(read<float>(attributes, p_at), read<float>(attributes, p_at + 4));
			return std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : Vector2(0.0f);
		}
		const Vector2 uv = read_unorm16_pair(attributes, p_at);
		return uv_scale == Vector4(0.0f) ? uv : (uv - 0.5f) * p_scale;
	}

	void read_attributes(uint64_t p_index) {
		const uint64_t at = layout.attribute_stride * p_index;
		if (has(FORMAT_COLOR)) {
			const uint8_t *rgba = &attributes[at + layout.color];
			surface.colors.push_back(Vector4(rgba[0], rgba[1], rgba[2], rgba[3]) / 255.0f);
		}
		if (has(FORMAT_UV)) {
			surface.uvs.push_back(read_uv(at + layout.uv, { uv_scale.x, uv_scale.y }));
		}
		if (has(FORMAT_UV2)) {
			surface.uv2s.push_back(read_uv(at + layout.uv2, { uv_scale.z, uv_scale.w }));
		}
	}

	Status read_indices() {
		std::vector<uint32_t> corners;
		if (indices.empty()) {
			corners.resize(vertex_count);
			for (uint32_t i = 0; i < corners.size(); i++) {
				corners[i] = i;
			}
		} else {
			const uint64_t bytes = vertex_count <= MAX_16_BIT_VERTICES ? 2 : 4;
			corners.resize(indices.size() / bytes);
			if (indices.size() % bytes != 0 || int64_t(corners.size()) != value<int64_t>("index_count")) {
				return make_error("index_data has {} bytes for {} indices of {} bytes", indices.size(), value<int64_t>("index_count"), bytes);
			}
			for (size_t i = 0; i < corners.size(); i++) {
				corners[i] = bytes == 2 ? read<uint16_t>(indices, 2 * i) : read<uint32_t>(indices, 4 * i);
			}
			if (const uint32_t largest = *std::max_element(corners.begin(), corners.end()); largest >= vertex_count) {
				return make_error("index {} is out of range, the surface has {} vertices", largest, vertex_count);
			}
		}
		const bool strip = primitive == PRIMITIVE_TRIANGLE_STRIP;
		if (corners.size() < 3 || (!strip && corners.size() % 3 != 0)) {
			return make_error("{} corners are no whole number of triangles", corners.size());
		}
		for (size_t i = 0; i + 2 < corners.size(); i += strip ? 1 : 3) {
			const bool odd = strip && i % 2 == 1;
			surface.indices.insert(surface.indices.end(), { corners[i], corners[odd ? i + 1 : i + 2], corners[odd ? i + 2 : i + 1] });
		}
		return Ok();
	}

	const Dictionary &source;
	uint64_t format = 0;
	int64_t primitive = 0;
	uint64_t vertex_count = 0;
	Bytes vertices, attributes, indices;
	AABB box;
	Vector4 uv_scale{ 0.0f };
	Layout layout;
	MeshSurface surface;
};

} // namespace

Result<MeshSurface> decode_mesh_surface(const Dictionary &p_surface) {
	return SurfaceReader(p_surface).read_surface();
}

void add_mesh_surfaces(scene::ArrayMesh &r_mesh, const Variant &p_surfaces, const std::string &p_source, int p_line) {
	const std::optional<Array> surfaces = variant_cast<Array>(p_surfaces);
	if (!surfaces) {
		scene::LoadReport::error(fmt::format("{}:{}: _surfaces is no array; the mesh stays empty", p_source, p_line));
		return;
	}
	for (size_t i = 0; i < surfaces->size(); i++) {
		const Dictionary entry = variant_or<Dictionary>((*surfaces)[i], {});
		Result<MeshSurface> surface = decode_mesh_surface(entry);
		if (!surface) {
			scene::LoadReport::error(fmt::format("{}:{}: surface {} of the mesh is left out: {}", p_source, p_line, i, surface.error().message));
			continue;
		}
		const Variant *material = entry.find("material");
		const Variant *name = entry.find("name");
		r_mesh.add_surface(surface.take(), material != nullptr ? variant_or<Ref<scene::Material>>(*material, nullptr) : nullptr, name != nullptr ? variant_or<std::string>(*name, "") : "");
	}
}

} // namespace lucent
