// SPDX-License-Identifier: MIT
#pragma once
// Checked conversion between Variant and the C++ types that setters, getters and methods use.

#include "servers/core/variant.h"

#include <optional>

namespace lucent {

template <typename T>
struct RefTarget {
	using Type = void;
};
template <typename T>
struct RefTarget<std::shared_ptr<T>> {
	using Type = T;
};
template <typename T>
constexpr bool is_ref_v = !std::is_void_v<typename RefTarget<T>::Type>;
template <typename T>
constexpr bool is_object_pointer_v = std::is_pointer_v<T>;

// INT, or FLOAT without a fraction, or BOOL.
std::optional<int64_t> variant_to_int(const Variant &p_variant);
// FLOAT, INT or BOOL.
std::optional<double> variant_to_float(const Variant &p_variant);
std::optional<std::string> variant_to_string(const Variant &p_variant); // STRING or NODE_PATH
// As T exactly, or from the type of the same shape: Vector3i for Vector3 and back, Basis from Quaternion, packed from Array.
template <typename T>
std::optional<T> variant_to_exact(const Variant &p_variant);

template <typename T>
constexpr Variant::Type variant_type_of() {
	if constexpr (std::is_same_v<T, Variant> || std::is_void_v<T>) {
		return Variant::Type::NIL;
	} else if constexpr (std::is_same_v<T, bool>) {
		return Variant::Type::BOOL;
	} else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
		return Variant::Type::INT;
	} else if constexpr (std::is_floating_point_v<T>) {
		return Variant::Type::FLOAT;
	} else if constexpr (is_ref_v<T> || is_object_pointer_v<T>) {
		return Variant::Type::OBJECT;
	} else {
		// The alternative's index in the storage.
		return []<size_t... I>(std::index_sequence<I...>) {
			size_t index = 0;
			((std::is_same_v<std::variant_alternative_t<I, Variant::Storage>, T> ? (index = I) : 0), ...);
			return Variant::Type(index);
		}
		(std::make_index_sequence<size_t(Variant::Type::COUNT)>());
	}
}

// Empty: the Variant is of another kind or the number does not fit in T.
template <typename T>
std::optional<T> variant_cast(const Variant &p_variant) {
	if constexpr (std::is_same_v<T, Variant>) {
		return p_variant;
	} else if constexpr (std::is_same_v<T, bool>) {
		const std::optional<double> number = variant_to_float(p_variant);
		return number ? std::optional<T>(*number != 0.0) : std::nullopt;
	} else if constexpr (std::is_enum_v<T>) {
		const auto number = variant_cast<std::underlying_type_t<T>>(p_variant);
		return number ? std::optional<T>(T(*number)) : std::nullopt;
	} else if constexpr (std::is_integral_v<T>) {
		const std::optional<int64_t> number = variant_to_int(p_variant);
		return number && std::in_range<T>(*number) ? std::optional<T>(T(*number)) : std::nullopt;
	} else if constexpr (std::is_floating_point_v<T>) {
		const std::optional<double> number = variant_to_float(p_variant);
		return number && std::abs(*number) <= double(std::numeric_limits<T>::max()) ? std::optional<T>(T(*number)) : std::nullopt;
	} else if constexpr (std::is_same_v<T, std::string>) {
		return variant_to_string(p_variant);
	} else if constexpr (std::is_same_v<T, NodePath>) {
		const std::optional<std::string> text = variant_to_string(p_variant);
		return text ? std::optional<T>(NodePath(*text)) : std::nullopt;
	} else if constexpr (is_ref_v<T>) {
		if (p_variant.is_null()) {
			return T();
		}
		const ObjectHandle *handle = p_variant.get_if<ObjectHandle>();
		T typed = handle ? std::dynamic_pointer_cast<typename RefTarget<T>::Type>(handle->resource) : T();
		return typed ? std::optional<T>(typed) : std::nullopt;
	} else if constexpr (is_object_pointer_v<T>) {
		if (p_variant.is_null()) {
			return T(nullptr);
		}
		T typed = dynamic_cast<T>(p_variant.get_object());
		return typed ? std::optional<T>(typed) : std::nullopt;
	} else {
		return variant_to_exact<T>(p_variant);
	}
}

// variant_cast with a fallback.
template <typename T>
T variant_or(const Variant &p_variant, T p_default) {
	std::optional<T> value = variant_cast<T>(p_variant);
	return value ? std::move(*value) : p_default;
}

} // namespace lucent
