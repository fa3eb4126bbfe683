// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_compression.h"

#include <draco/compression/decode.h>

namespace lucent {

namespace {

DracoAttribute read_attribute(const draco::Mesh &p_mesh, const draco::PointAttribute &p_attribute, const JsonView &p_id) {
	DracoAttribute attribute;
	attribute.components = uint32_t(p_attribute.num_components());
	if (attribute.components == 0 || attribute.components > 4) {
		p_id.fail("expected 1 to 4 components, found {}", attribute.components);
	}
	if (p_attribute.data_type() == draco::DT_BOOL) { // Draco reads any byte as one, which C++ leaves undefined
		p_id.fail("expected numbers, found booleans");
	}
	if (!p_attribute.normalized()) {
		attribute.integer_max = p_attribute.data_type() == draco::DT_UINT8 ? 255.0f : p_attribute.data_type() == draco::DT_UINT16 ? 65535.0f
																																  : 0.0f;
	}
	attribute.values.resize(size_t(p_mesh.num_points()) * attribute.components);
	for (uint32_t i = 0; i < p_mesh.num_points(); i++) {
		const draco::AttributeValueIndex index = p_attribute.mapped_index(draco::PointIndex(i));
		if (index.value() >= p_attribute.size() || !p_attribute.ConvertValue<float>(index, int8_t(attribute.components), &attribute.values[size_t(i) * attribute.components])) {
			p_id.fail("vertex {} has no value in the compressed data", i);
		}
	}
	return attribute;
}

} // namespace

DracoMesh decode_draco(GltfContext &r_context, const JsonView &p_json, std::span<const std::byte> p_bytes) {
	draco::DecoderBuffer buffer;
	buffer.Init(reinterpret_cast<const char *>(p_bytes.data()), p_bytes.size());
	draco::Decoder decoder;
	draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded = decoder.DecodeMeshFromBuffer(&buffer);
	if (!decoded.ok()) {
		p_json.fail("broken Draco data ({})", decoded.status().error_msg_string());
	}
	const draco::Mesh &mesh = *decoded.value();
	DracoMesh result;
	result.vertex_count = mesh.num_points();
	r_context.charge(mesh.num_faces(), 12, p_json);
	result.indices.reserve(size_t(mesh.num_faces()) * 3);
	for (uint32_t f = 0; f < mesh.num_faces(); f++) {
		for (const draco::PointIndex &corner : mesh.face(draco::FaceIndex(f))) {
			if (corner.value() >= result.vertex_count) {
				p_json.fail("triangle {} has vertex {} of {}", f, corner.value(), result.vertex_count);
			}
			result.indices.push_back(corner.value());
		}
	}
	const JsonView attributes = p_json.member("attributes");
	attributes.for_each_key([&](const std::string &p_semantic) {
		const JsonView id = attributes.member(p_semantic.c_str());
		const draco::PointAttribute *attribute = mesh.GetAttributeByUniqueId(uint32_t(id.to_uint(UINT32_MAX)));
		if (!attribute) {
			id.fail("the compressed data has no such attribute");
		}
		r_context.charge(result.vertex_count, 16, id);
		result.attributes.emplace(p_semantic, read_attribute(mesh, *attribute, id));
	});
	if (result.attributes.find("POSITION") == result.attributes.end()) {
		attributes.fail("expected POSITION");
	}
	return result;
}

} // namespace lucent
