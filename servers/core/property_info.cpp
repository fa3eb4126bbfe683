// SPDX-License-Identifier: MIT
// What a property accepts.
#include "servers/core/class_db.h"

#include <algorithm>

namespace lucent {

std::string PropertyInfo::get_hint_string() const {
	std::string text;
	switch (hint) {
		case PropertyHint::RANGE:
			text = fmt::format("{},{},{}", range.min, range.max, range.step);
			text += range.or_less ? ",or_less" : "";
			text += range.or_greater ? ",or_greater" : "";
			break;
		case PropertyHint::ENUM:
		case PropertyHint::FLAGS:
			for (const ConstantInfo &constant : ClassDB::get_enum_constants(class_name)) {
				text += fmt::format("{}{}:{}", text.empty() ? "" : ",", constant.name, constant.value);
			}
			break;
		case PropertyHint::RESOURCE_TYPE:
			text = class_name;
			break;
		case PropertyHint::NONE:
			break;
	}
	return text;
}

static std::string describe(const Variant &p_value) {
	const Object *object = p_value.get_object();
	return object ? std::string(object->get_class()) : p_value.to_string();
}

static bool is_finite(const Variant &p_value) {
	const auto finite = [](auto p_vector) { return !glm::any(glm::isnan(p_vector)) && !glm::any(glm::isinf(p_vector)); };
	switch (p_value.get_type()) {
		case Variant::Type::FLOAT:
			return std::isfinite(*p_value.get_if<double>());
		case Variant::Type::VECTOR2:
			return finite(*p_value.get_if<Vector2>());
		case Variant::Type::VECTOR3:
			return finite(*p_value.get_if<Vector3>());
		case Variant::Type::VECTOR4:
			return finite(*p_value.get_if<Vector4>());
		case Variant::Type::QUATERNION: {
			const Quaternion &q = *p_value.get_if<Quaternion>();
			return finite(Vector4(q.x, q.y, q.z, q.w));
		}
		case Variant::Type::BASIS: {
			const Basis &basis = *p_value.get_if<Basis>();
			return finite(basis[0]) && finite(basis[1]) && finite(basis[2]);
		}
		case Variant::Type::TRANSFORM3D: {
			const Transform3D &transform = *p_value.get_if<Transform3D>();
			return is_finite(transform.basis) && finite(transform.origin);
		}
		case Variant::Type::COLOR: {
			const Color &color = *p_value.get_if<Color>();
			return finite(Vector4(color.r, color.g, color.b, color.a));
		}
		default:
			return true;
	}
}

// Bounds and values pass through float: 0.01f must not fall below 0.01.
static bool is_below(const PropertyRange &p_range, double p_number) {
	return !p_range.or_less && p_number < p_range.min - 1e-6 * std::abs(p_range.min);
}

static bool is_above(const PropertyRange &p_range, double p_number) {
	return !p_range.or_greater && p_number > p_range.max + 1e-6 * std::abs(p_range.max);
}

Status PropertyInfo::checked_set(Object &r_object, const Variant &p_value) const {
	const std::optional<double> number = variant_to_float(p_value);
	if (set && is_finite(p_value) && hint == PropertyHint::RANGE && number && (is_below(range, *number) || is_above(range, *number))) {
		return make_error("{}.{} must be between {} and {}, got {}", r_object.get_class(), name, range.or_less ? "-inf" : fmt::format("{}", range.min),
				range.or_greater ? "inf" : fmt::format("{}", range.max), p_value.to_string());
	}
	return set_in_range(r_object, p_value);
}

Status PropertyInfo::stored_set(Object &r_object, const Variant &p_value, bool &r_clamped) const {
	const std::optional<double> number = variant_to_float(p_value);
	r_clamped = set && is_finite(p_value) && hint == PropertyHint::RANGE && range.is_enforced && number && (is_below(range, *number) || is_above(range, *number));
	if (!r_clamped) {
		return set_in_range(r_object, p_value);
	}
	const double nearest = is_below(range, *number) ? range.min : range.max;
	return set_in_range(r_object, type == Variant::Type::INT ? Variant(int64_t(nearest)) : Variant(nearest));
}

Status PropertyInfo::set_in_range(Object &r_object, const Variant &p_value) const {
	const auto full_name = [&] { return std::string(r_object.get_class()) + "." + name; }; // for errors alone: setting is frequent
	if (!set) {
		return make_error("{} is read-only", full_name());
	}
	if (!is_finite(p_value)) {
		return make_error("{} must be finite, got {}", full_name(), p_value.to_string());
	}
	const std::optional<double> number = variant_to_float(p_value);
	if (hint == PropertyHint::ENUM && number) {
		const std::vector<ConstantInfo> constants = ClassDB::get_enum_constants(class_name);
		if (std::none_of(constants.begin(), constants.end(), [&](const ConstantInfo &p_constant) { return double(p_constant.value) == *number; })) {
			return make_error("{} must be one of {}, got {}", full_name(), get_hint_string(), p_value.to_string());
		}
	}
	if (!set(r_object, p_value)) {
		const std::string expected = hint == PropertyHint::RESOURCE_TYPE ? class_name : Variant::get_type_name(type);
		return make_error("{} expects {}, got {}", full_name(), expected, describe(p_value));
	}
	return Ok();
}

} // namespace lucent
