// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_buffers.h"

#include "modules/gltf/gltf_compression.h"

#include <algorithm>
#include <cstring>

namespace lucent {

namespace {

constexpr uint64_t MAX_BYTES = uint64_t(1) << 40; // keeps sums of offsets and lengths far from overflow
constexpr uint64_t MAX_COUNT = UINT32_MAX - 1;

uint32_t component_size(const JsonView &p_type, uint32_t p_component_type) {
	switch (p_component_type) {
		case 5120:
		case 5121:
			return 1;
		case 5122:
		case 5123:
			return 2;
		case 5125:
		case 5126:
			return 4;
	}
	p_type.fail("expected 5120 to 5123, 5125 or 5126, found {}", p_component_type);
}

struct Shape {
	const char *name;
	uint32_t components;
	uint32_t columns; // matrices start each column at a multiple of 4 bytes
};

constexpr Shape SHAPES[] = { { "SCALAR", 1, 0 }, { "VEC2", 2, 0 }, { "VEC3", 3, 0 }, { "VEC4", 4, 0 }, { "MAT2", 4, 2 }, { "MAT3", 9, 3 }, { "MAT4", 16, 4 } };

const Shape &shape_of(const JsonView &p_type) {
	const std::string name = p_type.to_string();
	for (const Shape &shape : SHAPES) {
		if (name == shape.name) {
			return shape;
		}
	}
	p_type.fail("expected SCALAR, VEC2 to VEC4 or MAT2 to MAT4, found '{}'", name);
}

// What p_count elements need in a view of p_view_bytes from p_offset; fails when they are not there.
void check_extent(const JsonView &p_json, uint64_t p_offset, uint64_t p_count, uint64_t p_stride, uint64_t p_element_bytes, uint64_t p_view_bytes) {
	const uint64_t needed = p_count == 0 ? 0 : p_offset + (p_count - 1) * p_stride + p_element_bytes;
	if (needed > p_view_bytes) {
		p_json.fail("{} elements from byte {} need {} bytes, the buffer view has {}", p_count, p_offset, needed, p_view_bytes);
	}
}

[[noreturn]] void fail_missing(int32_t p_buffer) {
	throw GltfFailure{ fmt::format("/buffers/{}: the buffer has no uri, and {}", p_buffer, p_buffer == 0 ? "the file has no binary chunk" : "only the first buffer may be the binary chunk") };
}

template <typename T>
T load_as(const std::byte *p_bytes) {
	T value;
	std::memcpy(&value, p_bytes, sizeof(T));
	return value;
}

float component_to_float(const std::byte *p_bytes, uint32_t p_type, bool p_normalized) {
	switch (p_type) {
		case 5120:
			return p_normalized ? std::max(float(load_as<int8_t>(p_bytes)) / 127.0f, -1.0f) : float(load_as<int8_t>(p_bytes));
		case 5121:
			return float(load_as<uint8_t>(p_bytes)) / (p_normalized ? 255.0f : 1.0f);
		case 5122:
			return p_normalized ? std::max(float(load_as<int16_t>(p_bytes)) / 32767.0f, -1.0f) : float(load_as<int16_t>(p_bytes));
		case 5123:
			return float(load_as<uint16_t>(p_bytes)) / (p_normalized ? 65535.0f : 1.0f);
		case 5125:
			return float(load_as<uint32_t>(p_bytes)) / (p_normalized ? 4294967295.0f : 1.0f);
	}
	return load_as<float>(p_bytes);
}

std::vector<uint32_t> read_sparse_indices(const std::byte *p_bytes, uint32_t p_count, uint32_t p_type) {
	std::vector<uint32_t> indices(p_count);
	for (uint32_t i = 0; i < p_count; i++) {
		indices[i] = p_type == 5121 ? load_as<uint8_t>(p_bytes + i) : p_type == 5123 ? load_as<uint16_t>(p_bytes + size_t(i) * 2)
																					 : load_as<uint32_t>(p_bytes + size_t(i) * 4);
	}
	return indices;
}

} // namespace

GltfBuffers::GltfBuffers(GltfContext &r_context) {
	const JsonView json_buffers = r_context.root.member("buffers");
	const JsonView json_views = r_context.root.member("bufferViews");
	const JsonView json_accessors = r_context.root.member("accessors");
	for (size_t i = 0; i < json_buffers.array_size(); i++) {
		load_buffer(r_context, json_buffers.element(i), i == 0);
	}
	for (size_t i = 0; i < json_views.array_size(); i++) {
		load_view(r_context, json_views.element(i));
	}
	for (size_t i = 0; i < json_accessors.array_size(); i++) {
		load_accessor(r_context, json_accessors.element(i));
	}
}

void GltfBuffers::load_buffer(GltfContext &r_context, const JsonView &p_json, bool p_first) {
	const uint64_t length = p_json.member("byteLength").to_uint(MAX_BYTES);
	const JsonView uri = p_json.member("uri");
	std::span<const std::byte> bytes;
	if (length == 0) {
		r_context.warn("{}: the buffer is empty", p_json.get_path());
	}
	if (uri.present()) {
		storage.push_back(r_context.read_uri(uri));
		bytes = storage.back();
	} else if (p_first && r_context.has_binary_chunk) {
		bytes = r_context.binary_chunk;
	} else {
		buffers.push_back({ {}, length, true });
		return;
	}
	if (bytes.size() < length) {
		p_json.member("byteLength").fail("the buffer should have {} bytes, found {}", length, bytes.size());
	}
	buffers.push_back({ bytes.first(length), length, false });
}

void GltfBuffers::load_view(GltfContext &r_context, const JsonView &p_json) {
	const int32_t buffer = p_json.member("buffer").to_index(buffers.size());
	const uint64_t offset = p_json.uint_or("byteOffset", 0, MAX_BYTES);
	const uint64_t length = p_json.member("byteLength").to_uint(MAX_BYTES);
	const uint32_t stride = uint32_t(p_json.uint_or("byteStride", 0, 252));
	if (p_json.extension("EXT_meshopt_compression").present()) {
		load_meshopt_view(r_context, p_json);
		return;
	}
	if (length == 0) {
		r_context.warn("{}: the view is empty", p_json.get_path());
	}
	const Buffer &source = buffers[size_t(buffer)];
	if (offset + length > source.length) {
		p_json.fail("bytes {} to {} are outside the buffer of {} bytes", offset, offset + length, source.length);
	}
	if (source.missing) {
		views.push_back({ {}, stride, length, buffer });
	} else {
		views.push_back({ source.bytes.subspan(offset, length), stride, length, -1 });
	}
}

void GltfBuffers::load_meshopt_view(GltfContext &r_context, const JsonView &p_json) {
	const JsonView json = p_json.extension("EXT_meshopt_compression");
	const int32_t buffer = json.member("buffer").to_index(buffers.size());
	const uint64_t offset = json.uint_or("byteOffset", 0, MAX_BYTES);
	const uint64_t length = json.member("byteLength").to_uint(MAX_BYTES);
	if (offset + length > buffers[size_t(buffer)].bytes.size()) {
		json.fail("bytes {} to {} are outside the buffer of {} bytes", offset, offset + length, buffers[size_t(buffer)].bytes.size());
	}
	storage.push_back(decode_meshopt(r_context, json, buffers[size_t(buffer)].bytes.subspan(offset, length)));
	views.push_back({ storage.back(), uint32_t(p_json.uint_or("byteStride", 0, 252)), storage.back().size(), -1 });
}

void GltfBuffers::load_accessor(GltfContext &r_context, const JsonView &p_json) {
	GltfAccessor accessor;
	accessor.json = p_json;
	const JsonView type = p_json.member("componentType");
	accessor.component_type = uint32_t(type.to_uint(UINT32_MAX));
	const uint32_t size = component_size(type, accessor.component_type);
	const Shape &shape = shape_of(p_json.member("type"));
	accessor.components = shape.components;
	accessor.element_bytes = shape.columns == 0 ? size * shape.components : shape.columns * ((size * shape.columns + 3) / 4 * 4);
	accessor.normalized = p_json.bool_or("normalized", false);
	accessor.count = uint32_t(p_json.member("count").to_uint(MAX_COUNT));
	if (accessor.count == 0) {
		r_context.warn("{}: the accessor is empty", p_json.get_path());
	}
	const int32_t view_index = p_json.index_or_none("bufferView", views.size());
	const uint64_t offset = p_json.uint_or("byteOffset", 0, MAX_BYTES);
	accessor.stride = accessor.element_bytes;
	if (view_index >= 0) {
		const GltfBufferView &view = views[size_t(view_index)];
		if (view.stride != 0 && view.stride < accessor.element_bytes) {
			p_json.fail("elements of {} bytes do not fit bufferViews/{}'s byteStride of {}", accessor.element_bytes, view_index, view.stride);
		}
		accessor.stride = view.stride != 0 ? view.stride : accessor.element_bytes;
		check_extent(p_json, offset, accessor.count, accessor.stride, accessor.element_bytes, view.length);
		accessor.missing_buffer = view.missing_buffer;
		accessor.base = view.missing_buffer < 0 && accessor.count > 0 ? view.bytes.data() + offset : nullptr;
	}
	const JsonView sparse = p_json.member("sparse");
	if (sparse.present()) {
		load_sparse(r_context, sparse, accessor);
	}
	accessors.push_back(std::move(accessor));
}

void GltfBuffers::load_sparse(GltfContext &r_context, const JsonView &p_json, GltfAccessor &r_accessor) {
	const uint32_t count = uint32_t(p_json.member("count").to_uint(r_accessor.count));
	if (count == 0) {
		return;
	}
	const JsonView indices = p_json.member("indices");
	const JsonView type = indices.member("componentType");
	const uint32_t component_type = uint32_t(type.to_uint(UINT32_MAX));
	if (component_type != 5121 && component_type != 5123 && component_type != 5125) {
		type.fail("expected 5121, 5123 or 5125, found {}", component_type);
	}
	const uint32_t index_bytes = component_size(type, component_type);
	const GltfBufferView &index_view = views[size_t(indices.member("bufferView").to_index(views.size()))];
	const uint64_t index_offset = indices.uint_or("byteOffset", 0, MAX_BYTES);
	check_extent(indices, index_offset, count, index_bytes, index_bytes, index_view.length);
	const JsonView values = p_json.member("values");
	const GltfBufferView &value_view = views[size_t(values.member("bufferView").to_index(views.size()))];
	const uint64_t value_offset = values.uint_or("byteOffset", 0, MAX_BYTES);
	check_extent(values, value_offset, count, r_accessor.element_bytes, r_accessor.element_bytes, value_view.length);
	r_accessor.missing_buffer = std::max({ r_accessor.missing_buffer, index_view.missing_buffer, value_view.missing_buffer });
	if (r_accessor.missing_buffer >= 0) {
		return;
	}
	r_context.charge(count, 4, p_json);
	r_accessor.sparse_indices = read_sparse_indices(index_view.bytes.data() + index_offset, count, component_type);
	r_accessor.sparse_values = value_view.bytes.data() + value_offset;
	for (uint32_t i = 0; i < count; i++) {
		const uint32_t index = r_accessor.sparse_indices[i];
		if (index >= r_accessor.count || (i > 0 && index <= r_accessor.sparse_indices[i - 1])) {
			indices.fail("index {} is {}: expected ascending indices below {}", i, index, r_accessor.count);
		}
	}
}

const std::byte *GltfAccessor::element(uint32_t p_index) const {
	if (!sparse_indices.empty()) {
		const auto found = std::lower_bound(sparse_indices.begin(), sparse_indices.end(), p_index);
		if (found != sparse_indices.end() && *found == p_index) {
			return sparse_values + size_t(found - sparse_indices.begin()) * element_bytes;
		}
	}
	return base ? base + size_t(p_index) * stride : nullptr;
}

const GltfBufferView &GltfBuffers::view(int32_t p_index) const {
	const GltfBufferView &view = views[size_t(p_index)];
	if (view.missing_buffer >= 0) {
		fail_missing(view.missing_buffer);
	}
	return view;
}

std::vector<float> read_floats(GltfContext &r_context, const GltfAccessor &p_accessor, std::span<const uint32_t> p_elements) {
	const uint32_t components = p_accessor.components;
	r_context.charge(p_elements.size(), components * sizeof(float), p_accessor.json);
	if (p_accessor.missing_buffer >= 0) {
		fail_missing(p_accessor.missing_buffer);
	}
	std::vector<float> values(p_elements.size() * components);
	const uint32_t size = component_size(p_accessor.json, p_accessor.component_type);
	float *out = values.data();
	for (const uint32_t index : p_elements) {
		INVARIANT(index < p_accessor.count, "element {} of {}", index, p_accessor.count);
		const std::byte *element = p_accessor.element(index);
		if (element && p_accessor.component_type == 5126) {
			std::memcpy(out, element, components * sizeof(float));
		} else if (element) {
			for (uint32_t c = 0; c < components; c++) {
				out[c] = component_to_float(element + size_t(c) * size, p_accessor.component_type, p_accessor.normalized);
			}
		}
		out += components;
	}
	return values;
}

std::vector<uint32_t> read_uints(GltfContext &r_context, const GltfAccessor &p_accessor) {
	const uint32_t components = p_accessor.components;
	r_context.charge(p_accessor.count, components * sizeof(uint32_t), p_accessor.json);
	if (p_accessor.missing_buffer >= 0) {
		fail_missing(p_accessor.missing_buffer);
	}
	const uint32_t type = p_accessor.component_type;
	if (type != 5121 && type != 5123 && type != 5125) {
		p_accessor.json.member("componentType").fail("expected unsigned integers (5121, 5123 or 5125), found {}", type);
	}
	const uint32_t size = component_size(p_accessor.json, type);
	std::vector<uint32_t> values(size_t(p_accessor.count) * components);
	for (uint32_t i = 0; i < p_accessor.count; i++) {
		const std::byte *element = p_accessor.element(i);
		for (uint32_t c = 0; element && c < components; c++) {
			const std::byte *bytes = element + size_t(c) * size;
			values[size_t(i) * components + c] = type == 5121 ? load_as<uint8_t>(bytes) : type == 5123 ? load_as<uint16_t>(bytes)
																									   : load_as<uint32_t>(bytes);
		}
	}
	return values;
}

} // namespace lucent
