// SPDX-License-Identifier: MIT
#include "modules/tscn/variant_constructors.h"

#include <algorithm>
#include <cmath>

namespace lucent {

namespace {

Basis basis_from_rows(Numbers p_n) {
	return Basis(p_n[0], p_n[3], p_n[6], p_n[1], p_n[4], p_n[7], p_n[2], p_n[5], p_n[8]);
}

// Types that no property here has (2D, double precision) stay readable as arrays of their numbers.
Variant plain_array(Numbers p_n) {
	return Array(p_n.begin(), p_n.end());
}

const NumberConstructor NUMBER_CONSTRUCTORS[] = {
	{ "Vector2", 2, [](Numbers p_n) -> Variant { return Vector2(p_n[0], p_n[1]); } },
	{ "Vector2i", 2, [](Numbers p_n) -> Variant { return Vector2i(p_n[0], p_n[1]); } },
	{ "Vector3", 3, [](Numbers p_n) -> Variant { return Vector3(p_n[0], p_n[1], p_n[2]); } },
	{ "Vector3i", 3, [](Numbers p_n) -> Variant { return Vector3i(p_n[0], p_n[1], p_n[2]); } },
	{ "Vector4", 4, [](Numbers p_n) -> Variant { return Vector4(p_n[0], p_n[1], p_n[2], p_n[3]); } },
	{ "Color", 4, [](Numbers p_n) -> Variant { return Color{ float(p_n[0]), float(p_n[1]), float(p_n[2]), float(p_n[3]) }; } },
	{ "Quaternion", 4, [](Numbers p_n) -> Variant { return Quaternion(float(p_n[3]), float(p_n[0]), float(p_n[1]), float(p_n[2])); } },
	{ "Basis", 9, [](Numbers p_n) -> Variant { return basis_from_rows(p_n); } },
	{ "Transform3D", 12, [](Numbers p_n) -> Variant { return Transform3D{ basis_from_rows(p_n), Vector3(p_n[9], p_n[10], p_n[11]) }; } },
	{ "AABB", 6, [](Numbers p_n) -> Variant { return lucent::AABB{ Vector3(p_n[0], p_n[1], p_n[2]), Vector3(p_n[0] + p_n[3], p_n[1] + p_n[4], p_n[2] + p_n[5]) }; } },
	{ "Rect2", 4, plain_array },
	{ "Rect2i", 4, plain_array },
	{ "Vector4i", 4, plain_array },
	{ "Plane", 4, plain_array },
	{ "Transform2D", 6, plain_array },
	{ "Projection", 16, plain_array },
};

template <typename T>
Variant packed_scalars(Numbers p_n) {
	std::vector<T> values;
	values.reserve(p_n.size());
	for (const double number : p_n) {
		if constexpr (std::is_integral_v<T>) { // out of range is undefined, so clamp
			values.push_back(T(std::clamp(std::isnan(number) ? 0.0 : number, double(std::numeric_limits<T>::min()), double(std::numeric_limits<T>::max()))));
		} else {
			values.push_back(T(number));
		}
	}
	return values;
}

template <typename T, size_t N>
Variant packed_vectors(Numbers p_n) {
	std::vector<T> values(p_n.size() / N);
	for (size_t i = 0; i < values.size(); i++) {
		for (size_t j = 0; j < N; j++) {
			values[i][glm::length_t(j)] = float(p_n[i * N + j]);
		}
	}
	return values;
}

Variant packed_colors(Numbers p_n) {
	std::vector<Color> values(p_n.size() / 4);
	for (size_t i = 0; i < values.size(); i++) {
		values[i] = { float(p_n[4 * i]), float(p_n[4 * i + 1]), float(p_n[4 * i + 2]), float(p_n[4 * i + 3]) };
	}
	return values;
}

const NumberConstructor PACKED_CONSTRUCTORS[] = {
	{ "PackedByteArray", 1, packed_scalars<uint8_t> },
	{ "PackedInt32Array", 1, packed_scalars<int32_t> },
	{ "PackedInt64Array", 1, plain_array },
	{ "PackedFloat32Array", 1, packed_scalars<float> },
	{ "PackedFloat64Array", 1, packed_scalars<float> },
	{ "PackedVector2Array", 2, packed_vectors<Vector2, 2> },
	{ "PackedVector3Array", 3, packed_vectors<Vector3, 3> },
	{ "PackedVector4Array", 4, plain_array },
	{ "PackedColorArray", 4, packed_colors },
};

template <size_t N>
const NumberConstructor *find_in(const NumberConstructor (&p_table)[N], std::string_view p_type) {
	const NumberConstructor *found = std::find_if(p_table, p_table + N, [&](const NumberConstructor &p_entry) { return p_type == p_entry.name; });
	return found == p_table + N ? nullptr : found;
}

} // namespace

const NumberConstructor *find_number_constructor(std::string_view p_type) {
	return find_in(NUMBER_CONSTRUCTORS, p_type);
}

const NumberConstructor *find_packed_constructor(std::string_view p_type) {
	return find_in(PACKED_CONSTRUCTORS, p_type);
}

} // namespace lucent
