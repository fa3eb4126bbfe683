// SPDX-License-Identifier: MIT
#pragma once
// Writes small .glb files in memory for the glTF tests.

#include "modules/gltf/gltf_document.h"

#include <cstring>

namespace lucent::test {

class GltfBuilder {
public:
	// Adds a view and an accessor of p_count elements; returns the accessor's index. p_more is inserted into the accessor's JSON.
	template <typename T>
	int add(const std::vector<T> &p_values, const char *p_type, int p_component_type, size_t p_count, const std::string &p_more = "") {
		const int view = add_view(p_values);
		accessors += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}", accessors.empty() ? "" : ",", view, p_component_type, p_count, p_type, p_more);
		return accessor_count++;
	}
	template <typename T>
	int add_view(const std::vector<T> &p_values, const std::string &p_more = "") {
		const size_t bytes = p_values.size() * sizeof(T);
		const size_t offset = binary.size();
		binary.resize(offset + bytes);
		std::memcpy(binary.data() + offset, p_values.data(), bytes);
		views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}{}}}", views.empty() ? "" : ",", offset, bytes, p_more);
		return view_count++;
	}
	// p_json: the other top-level members, each with a trailing comma.
	std::vector<std::byte> glb(const std::string &p_json) const {
		std::string json = fmt::format("{{{}\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{{\"byteLength\":{}}}],\"bufferViews\":[{}],\"accessors\":[{}]}}", p_json, binary.size(), views, accessors);
		json.resize((json.size() + 3) / 4 * 4, ' ');
		std::vector<std::byte> file(12 + 8 + json.size() + 8 + binary.size());
		const uint32_t header[] = { 0x46546C67, 2, uint32_t(file.size()), uint32_t(json.size()), 0x4E4F534A };
		const uint32_t chunk[] = { uint32_t(binary.size()), 0x004E4942 };
		std::memcpy(file.data(), header, sizeof(header));
		std::memcpy(file.data() + 20, json.data(), json.size());
		std::memcpy(file.data() + 20 + json.size(), chunk, sizeof(chunk));
		std::memcpy(file.data() + 28 + json.size(), binary.data(), binary.size());
		return file;
	}
	Result<GltfDocument> parse(const std::string &p_json) const { return parse_gltf(glb(p_json), "test.glb", nullptr); }

private:
	std::string views;
	std::string accessors;
	std::vector<std::byte> binary;
	int view_count = 0;
	int accessor_count = 0;
};

inline std::span<const std::byte> text_bytes(std::string_view p_text) {
	return std::as_bytes(std::span(p_text.data(), p_text.size()));
}

inline Result<GltfDocument> parse_text(const std::string &p_text) {
	return parse_gltf(text_bytes(p_text), "test.gltf", nullptr);
}

// One mesh with one primitive, shown by one node.
inline std::string one_primitive(const std::string &p_primitive, const std::string &p_more = "") {
	return fmt::format("\"nodes\":[{{\"mesh\":0}}],\"scenes\":[{{\"nodes\":[0]}}],\"meshes\":[{{\"primitives\":[{{{}}}]}}],{}", p_primitive, p_more);
}

} // namespace lucent::test
