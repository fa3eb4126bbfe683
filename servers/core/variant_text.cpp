// SPDX-License-Identifier: MIT
// Variant::to_string: Godot's text syntax (VariantWriter).
#include "servers/core/object.h"
#include "servers/core/variant.h"

#include <fmt/format.h>

namespace lucent {

static void write_number(std::string &r_text, double p_value) {
	if (std::isnan(p_value)) {
		r_text += "nan";
	} else if (std::isinf(p_value)) {
		r_text += p_value > 0 ? "inf" : "-inf";
	} else if (double(float(p_value)) == p_value) {
		// Properties are mostly floats: 0.2f reads 0.2, not 0.20000000298.
		r_text += fmt::format("{}", float(p_value));
	} else {
		r_text += fmt::format("{}", p_value);
	}
}

static void write_quoted(std::string &r_text, const std::string &p_value) {
	r_text += '"';
	for (const char c : p_value) {
		if (c == '"' || c == '\\') {
			r_text += '\\';
		}
		r_text += c;
	}
	r_text += '"';
}

// "Vector3(1, 2, 3)" of any range of numbers.
template <typename Range>
static void write_call(std::string &r_text, const char *p_name, const Range &p_numbers) {
	r_text += p_name;
	r_text += '(';
	bool first = true;
	for (const auto number : p_numbers) {
		r_text += first ? "" : ", ";
		write_number(r_text, double(number));
		first = false;
	}
	r_text += ')';
}

static std::vector<double> row_major(const Basis &p_basis) {
	std::vector<double> numbers;
	for (int row = 0; row < 3; row++) {
		for (int column = 0; column < 3; column++) {
			numbers.push_back(p_basis[column][row]);
		}
	}
	return numbers;
}

// Flattens a vector of vectors to their components.
template <typename T>
static std::vector<double> flatten(const std::vector<T> &p_values) {
	std::vector<double> numbers;
	for (const T &value : p_values) {
		if constexpr (std::is_same_v<T, Color>) {
			numbers.insert(numbers.end(), { value.r, value.g, value.b, value.a });
		} else {
			for (int i = 0; i < value.length(); i++) {
				numbers.push_back(double(value[i]));
			}
		}
	}
	return numbers;
}

struct TextWriter {
	std::string &text;
	const char *type_name;

	void operator()(std::monostate) { text += "null"; }
	void operator()(bool p_value) { text += p_value ? "true" : "false"; }
	void operator()(int64_t p_value) { text += std::to_string(p_value); }
	void operator()(double p_value) {
		const size_t begin = text.size();
		write_number(text, p_value);
		if (text.find_first_not_of("-0123456789", begin) == std::string::npos) {
			text += ".0";
		}
	}
	void operator()(const std::string &p_value) { write_quoted(text, p_value); }
	void operator()(const Quaternion &p_value) { write_call(text, type_name, std::vector<double>{ p_value.x, p_value.y, p_value.z, p_value.w }); }
	void operator()(const Basis &p_value) { write_call(text, type_name, row_major(p_value)); }
	void operator()(const Transform3D &p_value) {
		std::vector<double> numbers = row_major(p_value.basis);
		numbers.insert(numbers.end(), { p_value.origin.x, p_value.origin.y, p_value.origin.z });
		write_call(text, type_name, numbers);
	}
	void operator()(const lucent::AABB &p_value) {
		// Godot's box is position and size; our empty box is its zero box.
		const Vector3 position = p_value.is_empty() ? Vector3(0.0f) : p_value.min;
		const Vector3 size = p_value.is_empty() ? Vector3(0.0f) : p_value.size();
		write_call(text, type_name, std::vector<double>{ position.x, position.y, position.z, size.x, size.y, size.z });
	}
	void operator()(const Color &p_value) { write_call(text, type_name, flatten(std::vector<Color>{ p_value })); }
	void operator()(const NodePath &p_value) {
		text += "NodePath(";
		write_quoted(text, p_value.text);
		text += ')';
	}
	void operator()(const ObjectHandle &p_value) {
		const Object *object = ObjectDB::get(p_value.id);
		text += object ? fmt::format("<{}#{}>", object->get_class(), p_value.id.value) : "null";
	}
	void operator()(const Array &p_value) {
		text += '[';
		for (size_t i = 0; i < p_value.size(); i++) {
			text += (i ? ", " : "") + p_value[i].to_string();
		}
		text += ']';
	}
	void operator()(const Dictionary &p_value) {
		text += '{';
		for (size_t i = 0; i < p_value.entries.size(); i++) {
			text += (i ? ", " : "") + p_value.entries[i].first.to_string() + ": " + p_value.entries[i].second.to_string();
		}
		text += '}';
	}
	void operator()(const std::vector<uint8_t> &p_value) { write_call(text, type_name, p_value); }
	void operator()(const std::vector<int32_t> &p_value) { write_call(text, type_name, p_value); }
	void operator()(const std::vector<float> &p_value) { write_call(text, type_name, p_value); }
	void operator()(const std::vector<Vector2> &p_value) { write_call(text, type_name, flatten(p_value)); }
	void operator()(const std::vector<Vector3> &p_value) { write_call(text, type_name, flatten(p_value)); }
	void operator()(const std::vector<Color> &p_value) { write_call(text, type_name, flatten(p_value)); }
	void operator()(const std::vector<std::string> &p_value) {
		text += type_name;
		text += '(';
		for (size_t i = 0; i < p_value.size(); i++) {
			text += i ? ", " : "";
			write_quoted(text, p_value[i]);
		}
		text += ')';
	}
	void operator()(const Callable &p_value) { text += p_value.target ? "<Callable>" : "null"; }
	template <glm::length_t L, typename T, glm::qualifier Q>
	void operator()(const glm::vec<L, T, Q> &p_value) { write_call(text, type_name, flatten(std::vector<glm::vec<L, T, Q>>{ p_value })); }
};

std::string Variant::to_string() const {
	std::string text;
	std::visit(TextWriter{ text, get_type_name(get_type()) }, storage);
	return text;
}

} // namespace lucent
