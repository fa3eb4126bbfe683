// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace lucent {

bool JsonView::is_object() const {
	return value && value->is_object();
}

JsonView JsonView::member(const char *p_key) const {
	if (!value) {
		return { nullptr, path + "/" + p_key };
	}
	if (!value->is_object()) {
		fail("expected an object, found {}", value->type_name());
	}
	const auto found = value->find(p_key);
	return { found == value->end() ? nullptr : &*found, path + "/" + p_key };
}

size_t JsonView::array_size() const {
	if (!value) {
		return 0;
	}
	if (!value->is_array()) {
		fail("expected an array, found {}", value->type_name());
	}
	return value->size();
}

JsonView JsonView::element(size_t p_index) const {
	INVARIANT(p_index < array_size(), "element {} of {}", p_index, array_size());
	return { &(*value)[p_index], fmt::format("{}/{}", path, p_index) };
}

uint64_t JsonView::to_uint(uint64_t p_max) const {
	if (!value) {
		fail("expected an integer, found nothing");
	}
	uint64_t number = 0;
	if (value->is_number_unsigned()) {
		number = value->get<uint64_t>();
	} else if (value->is_number_float() && value->get<double>() >= 0.0 && value->get<double>() < 9007199254740992.0 && std::floor(value->get<double>()) == value->get<double>()) {
		number = uint64_t(value->get<double>());
	} else {
		fail("expected an integer from 0 to {}, found {}", p_max, value->is_number() ? value->dump() : value->type_name());
	}
	if (number > p_max) {
		fail("expected an integer from 0 to {}, found {}", p_max, number);
	}
	return number;
}

float JsonView::to_float() const {
	if (!value || !value->is_number()) {
		fail("expected a number, found {}", value ? value->type_name() : "nothing");
	}
	const double number = value->get<double>();
	if (!(std::abs(number) <= double(std::numeric_limits<float>::max()))) {
		fail("{} does not fit a 32-bit float", number);
	}
	return float(number);
}

std::string JsonView::to_string() const {
	if (!value || !value->is_string()) {
		fail("expected a string, found {}", value ? value->type_name() : "nothing");
	}
	return value->get<std::string>();
}

std::string JsonView::to_text() const {
	return value ? value->dump() : std::string();
}

uint64_t JsonView::uint_or(const char *p_key, uint64_t p_default, uint64_t p_max) const {
	const JsonView found = member(p_key);
	return found.present() ? found.to_uint(p_max) : p_default;
}

float JsonView::float_or(const char *p_key, float p_default) const {
	const JsonView found = member(p_key);
	return found.present() ? found.to_float() : p_default;
}

float JsonView::float_in(const char *p_key, float p_default, float p_min, float p_max) const {
	return std::clamp(float_or(p_key, p_default), p_min, p_max);
}

bool JsonView::bool_or(const char *p_key, bool p_default) const {
	const JsonView found = member(p_key);
	if (found.present() && !found.value->is_boolean()) {
		found.fail("expected true or false, found {}", found.value->type_name());
	}
	return found.present() ? found.value->get<bool>() : p_default;
}

std::string JsonView::string_or(const char *p_key, const std::string &p_default) const {
	const JsonView found = member(p_key);
	return found.present() ? found.to_string() : p_default;
}

int32_t JsonView::to_index(size_t p_count) const {
	if (p_count == 0) {
		fail("refers to an array that is missing or empty");
	}
	return int32_t(to_uint(p_count - 1));
}

int32_t JsonView::index_or_none(const char *p_key, size_t p_count) const {
	const JsonView found = member(p_key);
	return found.present() ? found.to_index(p_count) : -1;
}

bool JsonView::floats(const char *p_key, std::span<float> r_values) const {
	const JsonView found = member(p_key);
	if (!found.present()) {
		return false;
	}
	if (found.array_size() != r_values.size()) {
		found.fail("expected {} numbers, found {}", r_values.size(), found.array_size());
	}
	for (size_t i = 0; i < r_values.size(); i++) {
		r_values[i] = found.element(i).to_float();
	}
	return true;
}

Vector3 JsonView::vector3_or(const char *p_key, const Vector3 &p_default) const {
	float values[3];
	return floats(p_key, values) ? Vector3(values[0], values[1], values[2]) : p_default;
}

void JsonView::for_each_key(const std::function<void(const std::string &)> &p_visit) const {
	if (!value) {
		return;
	}
	if (!value->is_object()) {
		fail("expected an object, found {}", value->type_name());
	}
	for (const auto &item : value->items()) {
		p_visit(item.key());
	}
}

} // namespace lucent
