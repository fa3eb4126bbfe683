// SPDX-License-Identifier: MIT
// Primitives as triangle lists. A primitive reads only the vertices that its triangles use, so many primitives may share one
// large vertex buffer.
#include "modules/gltf/gltf_loader.h"

#include "modules/gltf/gltf_compression.h"

namespace lucent {

namespace {

enum Mode {
	TRIANGLES = 4,
	TRIANGLE_STRIP = 5,
	TRIANGLE_FAN = 6
};

// glTF 2.0, 3.7.2.1: the vertices of triangle i of a strip and of a fan, so that all keep their winding.
std::vector<uint32_t> to_triangle_list(uint64_t p_mode, const std::vector<uint32_t> &p_indices) {
	std::vector<uint32_t> triangles;
	if (p_mode == TRIANGLES) {
		triangles.assign(p_indices.begin(), p_indices.end() - ptrdiff_t(p_indices.size() % 3));
		return triangles;
	}
	for (size_t i = 0; i + 2 < p_indices.size(); i++) {
		const uint32_t strip[3] = { p_indices[i], p_indices[i + 1 + i % 2], p_indices[i + 2 - i % 2] };
		const uint32_t fan[3] = { p_indices[i + 1], p_indices[i + 2], p_indices[0] };
		const uint32_t *triangle = p_mode == TRIANGLE_STRIP ? strip : fan;
		// Exporters join strips by triangles without area.
		if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
			triangles.insert(triangles.end(), triangle, triangle + 3);
		}
	}
	return triangles;
}

// The used vertices in ascending order; r_indices is renumbered to them.
std::vector<uint32_t> compact_vertices(std::vector<uint32_t> &r_indices, uint32_t p_vertex_count) {
	std::vector<uint32_t> used;
	if (p_vertex_count / 16 <= r_indices.size()) {
		std::vector<uint32_t> renumbered(p_vertex_count, 0);
		for (const uint32_t index : r_indices) {
			renumbered[index] = 1;
		}
		for (uint32_t i = 0; i < p_vertex_count; i++) {
			if (renumbered[i] == 1) {
				renumbered[i] = uint32_t(used.size());
				used.push_back(i);
			}
		}
		for (uint32_t &index : r_indices) {
			index = renumbered[index];
		}
		return used;
	}
	used = r_indices;
	std::sort(used.begin(), used.end());
	used.erase(std::unique(used.begin(), used.end()), used.end());
	for (uint32_t &index : r_indices) {
		index = uint32_t(std::lower_bound(used.begin(), used.end(), index) - used.begin());
	}
	return used;
}

// Vectors from tightly packed floats; components that the source lacks become p_fill.
template <typename V>
std::vector<V> to_vectors(const std::vector<float> &p_values, uint32_t p_components, float p_fill) {
	std::vector<V> vectors(p_values.size() / p_components, V(p_fill));
	for (size_t i = 0; i < vectors.size(); i++) {
		for (uint32_t c = 0; c < std::min<uint32_t>(p_components, uint32_t(V::length())); c++) {
			vectors[i][int(c)] = p_values[i * p_components + c];
		}
	}
	return vectors;
}

class PrimitiveLoader {
public:
	PrimitiveLoader(GltfContext &r_context, const GltfBuffers &p_buffers, const JsonView &p_json) :
			context(r_context), buffers(p_buffers), json(p_json), attributes(p_json.member("attributes")) {}

	// False: nothing to draw, a warning says why.
	bool load(GltfRawPrimitive &r_primitive);

private:
	bool load_indices(uint64_t p_mode, std::vector<uint32_t> &r_indices);
	bool has_attribute(const char *p_semantic) const;
	void load_draco();
	void load_attributes(GltfRawPrimitive &r_primitive);
	void load_morph_targets(GltfRawPrimitive &r_primitive);
	void load_skin(GltfRawPrimitive &r_primitive);
	template <typename V>
	std::vector<V> read(const JsonView &p_owner, const char *p_semantic, float p_fill, uint32_t p_min_components);

	GltfContext &context;
	const GltfBuffers &buffers;
	const JsonView json;
	const JsonView attributes;
	uint32_t vertex_count = 0;
	std::vector<uint32_t> used;
	DracoMesh draco;
	bool is_draco = false;
};

bool PrimitiveLoader::has_attribute(const char *p_semantic) const {
	return attributes.member(p_semantic).present();
}

template <typename V>
std::vector<V> PrimitiveLoader::read(const JsonView &p_owner, const char *p_semantic, float p_fill, uint32_t p_min_components) {
	const JsonView index = p_owner.member(p_semantic);
	std::vector<float> values;
	uint32_t components = 0;
	const GltfAccessor &accessor = buffers.accessor(index.to_index(buffers.accessor_count()));
	const auto compressed = draco.attributes.find(p_semantic);
	if (compressed != draco.attributes.end() && p_owner.get_path() == attributes.get_path()) {
		const DracoAttribute &attribute = compressed->second;
		components = attribute.components;
		context.charge(used.size(), components * sizeof(float), index);
		const float divisor = accessor.normalized && attribute.integer_max > 0.0f ? attribute.integer_max : 1.0f;
		values.reserve(used.size() * components);
		for (const uint32_t vertex : used) {
			for (uint32_t c = 0; c < components; c++) {
				values.push_back(attribute.values[size_t(vertex) * components + c] / divisor);
			}
		}
	} else {
		components = accessor.components;
		if (accessor.count != vertex_count) {
			index.fail("expected {} elements as in POSITION, found {}", vertex_count, accessor.count);
		}
		values = read_floats(context, accessor, used);
	}
	if (components < p_min_components || components > uint32_t(V::length())) {
		index.fail("expected {} components, found {}", V::length(), components);
	}
	std::vector<V> vectors = to_vectors<V>(values, components, p_fill);
	for (size_t i = 0; i < vectors.size(); i++) {
		for (int c = 0; c < V::length(); c++) {
			if (!std::isfinite(vectors[i][c])) {
				index.fail("element {} is not a finite number", used[i]);
			}
		}
	}
	return vectors;
}

void PrimitiveLoader::load_draco() {
	const JsonView extension = json.extension("KHR_draco_mesh_compression");
	if (!extension.present()) {
		return;
	}
	const GltfBufferView &view = buffers.view(extension.member("bufferView").to_index(buffers.view_count()));
	draco = decode_draco(context, extension, view.bytes);
	is_draco = true;
}

bool PrimitiveLoader::load_indices(uint64_t p_mode, std::vector<uint32_t> &r_indices) {
	std::vector<uint32_t> source;
	const JsonView json_indices = json.member("indices");
	if (is_draco) {
		vertex_count = draco.vertex_count;
		r_indices = draco.indices;
		return !r_indices.empty();
	}
	vertex_count = buffers.accessor(attributes.member("POSITION").to_index(buffers.accessor_count())).count;
	if (json_indices.present()) {
		const GltfAccessor &accessor = buffers.accessor(json_indices.to_index(buffers.accessor_count()));
		if (accessor.components != 1) {
			json_indices.fail("expected SCALAR, found {} components", accessor.components);
		}
		source = read_uints(context, accessor);
		for (size_t i = 0; i < source.size(); i++) {
			if (source[i] >= vertex_count) {
				json_indices.fail("index {} is {}, the primitive has {} vertices", i, source[i], vertex_count);
			}
		}
	} else {
		context.charge(vertex_count, sizeof(uint32_t), json);
		source.resize(vertex_count);
		for (uint32_t i = 0; i < vertex_count; i++) {
			source[i] = i;
		}
	}
	context.charge(source.size(), (p_mode == TRIANGLES ? 1 : 3) * sizeof(uint32_t), json);
	r_indices = to_triangle_list(p_mode, source);
	if (p_mode == TRIANGLES && source.size() % 3 != 0) {
		context.warn("{}: {} indices are not whole triangles; the last are left out", json.get_path(), source.size());
	}
	return !r_indices.empty();
}

void PrimitiveLoader::load_attributes(GltfRawPrimitive &r_primitive) {
	MeshSurface &surface = r_primitive.surface;
	surface.positions = read<Vector3>(attributes, "POSITION", 0.0f, 3);
	if (has_attribute("NORMAL")) {
		surface.normals = read<Vector3>(attributes, "NORMAL", 0.0f, 3);
		if (has_attribute("TANGENT")) {
			surface.tangents = read<Vector4>(attributes, "TANGENT", 0.0f, 4);
		}
	}
	if (has_attribute("TEXCOORD_0")) {
		surface.uvs = read<Vector2>(attributes, "TEXCOORD_0", 0.0f, 2);
	}
	if (has_attribute("TEXCOORD_1")) {
		surface.uv2s = read<Vector2>(attributes, "TEXCOORD_1", 0.0f, 2);
	}
	if (has_attribute("COLOR_0")) {
		surface.colors = read<Vector4>(attributes, "COLOR_0", 1.0f, 3);
	}
}

void PrimitiveLoader::load_skin(GltfRawPrimitive &r_primitive) {
	if (!has_attribute("JOINTS_0") || !has_attribute("WEIGHTS_0")) {
		return;
	}
	if (has_attribute("JOINTS_1")) {
		context.warn("{}: only the first four joints of a vertex are used", json.get_path());
	}
	r_primitive.joints = read<Vector4>(attributes, "JOINTS_0", 0.0f, 4);
	r_primitive.weights = read<Vector4>(attributes, "WEIGHTS_0", 0.0f, 4);
	for (Vector4 &weights : r_primitive.weights) {
		weights = glm::max(weights, Vector4(0.0f));
		const float sum = weights.x + weights.y + weights.z + weights.w;
		weights = sum > 0.0f && std::isfinite(sum) ? weights / sum : Vector4(1.0f, 0.0f, 0.0f, 0.0f);
	}
}

void PrimitiveLoader::load_morph_targets(GltfRawPrimitive &r_primitive) {
	const JsonView targets = json.member("targets");
	for (size_t i = 0; i < targets.array_size(); i++) {
		const JsonView target = targets.element(i);
		GltfRawPrimitive::MorphTarget &morph = r_primitive.morph_targets.emplace_back();
		if (target.member("POSITION").present()) {
			morph.positions = read<Vector3>(target, "POSITION", 0.0f, 3);
		}
		if (target.member("NORMAL").present()) {
			morph.normals = read<Vector3>(target, "NORMAL", 0.0f, 3);
		}
	}
}

bool PrimitiveLoader::load(GltfRawPrimitive &r_primitive) {
	r_primitive.path = json.get_path();
	r_primitive.material = json.index_or_none("material", context.document.materials.size());
	const uint64_t mode = json.uint_or("mode", TRIANGLES, 6);
	if (mode < TRIANGLES) {
		context.warn("points and lines are left out");
		return false;
	}
	if (!has_attribute("POSITION")) {
		context.warn("{}: the primitive has no positions and is left out", json.get_path());
		return false;
	}
	load_draco();
	MeshSurface &surface = r_primitive.surface;
	if (!load_indices(mode, surface.indices)) {
		context.warn("{}: the primitive has no triangles and is left out", json.get_path());
		return false;
	}
	if (has_attribute("NORMAL")) {
		used = compact_vertices(surface.indices, vertex_count);
	} else {
		// Flat shading (glTF 2.0, 3.7.2.1): each corner gets a vertex of its own.
		used = surface.indices;
		for (uint32_t i = 0; i < used.size(); i++) {
			surface.indices[i] = i;
		}
	}
	load_attributes(r_primitive);
	load_skin(r_primitive);
	load_morph_targets(r_primitive);
	if (!surface.colors.empty() && r_primitive.material >= 0) {
		context.document.materials[size_t(r_primitive.material)].uses_vertex_colors = true;
	}
	return true;
}

} // namespace

std::vector<GltfRawMesh> load_meshes(GltfContext &r_context, const GltfBuffers &p_buffers) {
	std::vector<GltfRawMesh> meshes;
	const JsonView json_meshes = r_context.root.member("meshes");
	for (size_t i = 0; i < json_meshes.array_size(); i++) {
		const JsonView json = json_meshes.element(i);
		GltfRawMesh &mesh = meshes.emplace_back();
		mesh.name = json.string_or("name", "");
		const JsonView primitives = json.member("primitives");
		for (size_t p = 0; p < primitives.array_size(); p++) {
			GltfRawPrimitive primitive;
			if (PrimitiveLoader(r_context, p_buffers, primitives.element(p)).load(primitive)) {
				mesh.primitives.push_back(std::move(primitive));
			}
		}
		const JsonView weights = json.member("weights");
		for (size_t w = 0; w < weights.array_size(); w++) {
			mesh.weights.push_back(weights.element(w).to_float());
		}
	}
	return meshes;
}

} // namespace lucent
