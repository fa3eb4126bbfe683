// SPDX-License-Identifier: MIT
#pragma once
// Buffers, buffer views and accessors. The constructor checks all of them against the bytes that are there; reading afterwards
// cannot fail but for the memory limit.

#include "modules/gltf/gltf_context.h"

namespace lucent {

struct GltfBufferView {
	std::span<const std::byte> bytes;
	uint32_t stride = 0; // 0: tightly packed
	uint64_t length = 0; // bytes.size(), or what it should be
	int32_t missing_buffer = -1; // a buffer without uri, which is legal until someone needs its bytes
};

struct GltfAccessor {
	JsonView json;
	uint32_t component_type = 0; // 5120 … 5126
	uint32_t components = 1;
	bool normalized = false;
	uint32_t count = 0;
	uint32_t element_bytes = 0;
	uint32_t stride = 0;
	const std::byte *base = nullptr; // null: zeros
	std::vector<uint32_t> sparse_indices; // ascending
	const std::byte *sparse_values = nullptr;
	int32_t missing_buffer = -1;

	const std::byte *element(uint32_t p_index) const;
};

class GltfBuffers {
public:
	explicit GltfBuffers(GltfContext &r_context);

	size_t accessor_count() const { return accessors.size(); }
	const GltfAccessor &accessor(int32_t p_index) const { return accessors[size_t(p_index)]; }
	size_t view_count() const { return views.size(); }
	// Fails when the buffer is not there.
	const GltfBufferView &view(int32_t p_index) const;

private:
	void load_buffer(GltfContext &r_context, const JsonView &p_json, bool p_first);
	void load_view(GltfContext &r_context, const JsonView &p_json);
	void load_accessor(GltfContext &r_context, const JsonView &p_json);
	void load_sparse(GltfContext &r_context, const JsonView &p_json, GltfAccessor &r_accessor);
	void load_meshopt_view(GltfContext &r_context, const JsonView &p_json);

	struct Buffer {
		std::span<const std::byte> bytes;
		uint64_t length = 0;
		bool missing = false;
	};
	std::vector<Buffer> buffers;
	std::vector<std::vector<std::byte>> storage; // what buffers and views point into, when not the binary chunk
	std::vector<GltfBufferView> views;
	std::vector<GltfAccessor> accessors;
};

// p_components floats an element (normalised integers are mapped as the specification says), for the given elements.
std::vector<float> read_floats(GltfContext &r_context, const GltfAccessor &p_accessor, std::span<const uint32_t> p_elements);

// Unsigned integers, all elements.
std::vector<uint32_t> read_uints(GltfContext &r_context, const GltfAccessor &p_accessor);

} // namespace lucent
