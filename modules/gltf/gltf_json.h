// SPDX-License-Identifier: MIT
#pragma once
// Reading JSON that may hold anything: every access checks type and range and knows its JSON pointer.

#include "servers/core/error.h"
#include "servers/core/math_types.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <span>
#include <string>

namespace lucent {

// Thrown inside this module only; parse_gltf() turns it into an Error.
struct GltfFailure {
	std::string message;
};

class JsonView {
public:
	JsonView() = default;
	JsonView(const nlohmann::json *p_value, std::string p_path) :
			value(p_value), path(std::move(p_path)) {}

	bool present() const { return value != nullptr; }
	bool is_object() const;
	const std::string &get_path() const { return path; }

	template <typename... Args>
	[[noreturn]] void fail(fmt::format_string<Args...> p_format, Args &&...p_args) const {
		throw GltfFailure{ fmt::format("{}: {}", path.empty() ? "/" : path, fmt::format(p_format, std::forward<Args>(p_args)...)) };
	}

	// Absent when this is absent or has no such key. Fails when this is not an object.
	JsonView member(const char *p_key) const;
	JsonView extension(const char *p_name) const { return member("extensions").member(p_name); }
	// 0 when absent. Fails when this is not an array.
	size_t array_size() const;
	JsonView element(size_t p_index) const;

	// These fail when this is absent or of another type.
	uint64_t to_uint(uint64_t p_max) const;
	float to_float() const;
	std::string to_string() const;
	std::string to_text() const; // JSON

	uint64_t uint_or(const char *p_key, uint64_t p_default, uint64_t p_max) const;
	float float_or(const char *p_key, float p_default) const;
	float float_in(const char *p_key, float p_default, float p_min, float p_max) const; // clamped
	bool bool_or(const char *p_key, bool p_default) const;
	std::string string_or(const char *p_key, const std::string &p_default) const;
	// An index below p_count; -1 when absent.
	int32_t index_or_none(const char *p_key, size_t p_count) const;
	int32_t to_index(size_t p_count) const;
	// Fills r_values from an array of exactly that many numbers. False when absent.
	bool floats(const char *p_key, std::span<float> r_values) const;
	Vector3 vector3_or(const char *p_key, const Vector3 &p_default) const;
	// Calls p_visit(key) for every key of an object; none when absent.
	void for_each_key(const std::function<void(const std::string &)> &p_visit) const;

private:
	const nlohmann::json *value = nullptr;
	std::string path;
};

} // namespace lucent
