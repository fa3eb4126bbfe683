// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_compression.h"

#include <meshoptimizer.h>

namespace lucent {

namespace {

void decode_filter(const JsonView &p_json, const std::string &p_filter, std::vector<std::byte> &r_bytes, size_t p_count, size_t p_stride) {
	if (p_filter == "NONE") {
		return;
	}
	const bool octahedral = p_filter == "OCTAHEDRAL" && (p_stride == 4 || p_stride == 8);
	const bool quaternion = p_filter == "QUATERNION" && p_stride == 8;
	if (octahedral) {
		meshopt_decodeFilterOct(r_bytes.data(), p_count, p_stride);
	} else if (quaternion) {
		meshopt_decodeFilterQuat(r_bytes.data(), p_count, p_stride);
	} else if (p_filter == "EXPONENTIAL") {
		meshopt_decodeFilterExp(r_bytes.data(), p_count, p_stride);
	} else {
		p_json.fail("expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL with a fitting byteStride, found '{}' with {}", p_filter, p_stride);
	}
}

} // namespace

std::vector<std::byte> decode_meshopt(GltfContext &r_context, const JsonView &p_json, std::span<const std::byte> p_bytes) {
	const uint64_t count = p_json.member("count").to_uint(UINT32_MAX);
	const uint64_t stride = p_json.member("byteStride").to_uint(256);
	const std::string mode = p_json.member("mode").to_string();
	const std::string filter = p_json.string_or("filter", "NONE");
	const bool attributes = mode == "ATTRIBUTES";
	if (!attributes && mode != "TRIANGLES" && mode != "INDICES") {
		p_json.member("mode").fail("expected ATTRIBUTES, TRIANGLES or INDICES, found '{}'", mode);
	}
	if (count == 0 || (attributes ? stride == 0 || stride % 4 != 0 : stride != 2 && stride != 4) || (mode == "TRIANGLES" && count % 3 != 0)) {
		p_json.fail("count {} and byteStride {} do not fit mode {}", count, stride, mode);
	}
	// The best that the codec does is a header and one byte for 16 vertices' bytes: a bound against absurd counts.
	if (count > uint64_t(p_bytes.size()) * 4096) {
		p_json.fail("{} elements cannot come from {} bytes", count, p_bytes.size());
	}
	r_context.charge(count, stride, p_json);
	std::vector<std::byte> decoded(count * stride);
	const unsigned char *input = reinterpret_cast<const unsigned char *>(p_bytes.data());
	int status = 0;
	if (attributes) {
		status = meshopt_decodeVertexBuffer(decoded.data(), count, stride, input, p_bytes.size());
	} else if (mode == "TRIANGLES") {
		status = meshopt_decodeIndexBuffer(decoded.data(), count, stride, input, p_bytes.size());
	} else {
		status = meshopt_decodeIndexSequence(decoded.data(), count, stride, input, p_bytes.size());
	}
	if (status != 0) {
		p_json.fail("broken meshopt data (mode {}, code {})", mode, status);
	}
	if (attributes) {
		decode_filter(p_json.member("filter"), filter, decoded, count, stride);
	}
	return decoded;
}

} // namespace lucent
