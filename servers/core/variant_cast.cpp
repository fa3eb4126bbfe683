// SPDX-License-Identifier: MIT
#include "servers/core/variant_cast.h"

#include "servers/core/object.h"

namespace lucent {

std::optional<int64_t> variant_to_int(const Variant &p_variant) {
	if (const int64_t *number = p_variant.get_if<int64_t>()) {
		return *number;
	}
	if (const bool *flag = p_variant.get_if<bool>()) {
		return int64_t(*flag);
	}
	// 2^53: beyond it doubles skip integers.
	const double *number = p_variant.get_if<double>();
	return number && std::trunc(*number) == *number && std::abs(*number) <= 9007199254740992.0 ? std::optional<int64_t>(int64_t(*number)) : std::nullopt;
}

std::optional<double> variant_to_float(const Variant &p_variant) {
	if (const double *number = p_variant.get_if<double>()) {
		return *number;
	}
	if (const int64_t *number = p_variant.get_if<int64_t>()) {
		return double(*number);
	}
	const bool *flag = p_variant.get_if<bool>();
	return flag ? std::optional<double>(*flag) : std::nullopt;
}

std::optional<std::string> variant_to_string(const Variant &p_variant) {
	if (const std::string *text = p_variant.get_if<std::string>()) {
		return *text;
	}
	const NodePath *path = p_variant.get_if<NodePath>();
	return path ? std::optional<std::string>(path->text) : std::nullopt;
}

template <typename T>
struct IsVector : std::false_type {};
template <typename T>
struct IsVector<std::vector<T>> : std::true_type {};

template <typename T>
std::optional<T> variant_to_exact(const Variant &p_variant) {
	if (const T *value = p_variant.get_if<T>()) {
		return *value;
	}
	const auto convert = [&](auto *p_value) { return p_value ? std::optional<T>(T(*p_value)) : std::nullopt; };
	if constexpr (std::is_same_v<T, Vector2>) {
		return convert(p_variant.get_if<Vector2i>());
	} else if constexpr (std::is_same_v<T, Vector2i>) {
		return convert(p_variant.get_if<Vector2>());
	} else if constexpr (std::is_same_v<T, Vector3>) {
		return convert(p_variant.get_if<Vector3i>());
	} else if constexpr (std::is_same_v<T, Vector3i>) {
		return convert(p_variant.get_if<Vector3>());
	} else if constexpr (std::is_same_v<T, Quaternion>) {
		const Basis *basis = p_variant.get_if<Basis>();
		return basis ? std::optional<T>(glm::quat_cast(*basis)) : std::nullopt;
	} else if constexpr (std::is_same_v<T, Basis>) {
		const Quaternion *quaternion = p_variant.get_if<Quaternion>();
		return quaternion ? std::optional<T>(glm::mat3_cast(*quaternion)) : std::nullopt;
	} else if constexpr (IsVector<T>::value && !std::is_same_v<T, Array>) {
		const Array *array = p_variant.get_if<Array>();
		if (!array) {
			return std::nullopt;
		}
		T result;
		for (const Variant &element : *array) {
			auto value = variant_cast<typename T::value_type>(element);
			if (!value) {
				return std::nullopt;
			}
			result.push_back(std::move(*value));
		}
		return result;
	}
	return std::nullopt;
}

template std::optional<Vector2> variant_to_exact(const Variant &);
template std::optional<Vector2i> variant_to_exact(const Variant &);
template std::optional<Vector3> variant_to_exact(const Variant &);
template std::optional<Vector3i> variant_to_exact(const Variant &);
template std::optional<Vector4> variant_to_exact(const Variant &);
template std::optional<Quaternion> variant_to_exact(const Variant &);
template std::optional<Basis> variant_to_exact(const Variant &);
template std::optional<Transform3D> variant_to_exact(const Variant &);
template std::optional<AABB> variant_to_exact(const Variant &);
template std::optional<Color> variant_to_exact(const Variant &);
template std::optional<Array> variant_to_exact(const Variant &);
template std::optional<Dictionary> variant_to_exact(const Variant &);
template std::optional<std::vector<uint8_t>> variant_to_exact(const Variant &);
template std::optional<std::vector<int32_t>> variant_to_exact(const Variant &);
template std::optional<std::vector<float>> variant_to_exact(const Variant &);
template std::optional<std::vector<Vector2>> variant_to_exact(const Variant &);
template std::optional<std::vector<Vector3>> variant_to_exact(const Variant &);
template std::optional<std::vector<Color>> variant_to_exact(const Variant &);
template std::optional<std::vector<std::string>> variant_to_exact(const Variant &);
template std::optional<Callable> variant_to_exact(const Variant &);

} // namespace lucent
