// SPDX-License-Identifier: MIT
#include "modules/tscn/variant_parser.h"

#include "modules/scene/load_report.h"
#include "modules/tscn/base64.h"
#include "modules/tscn/variant_constructors.h"

#include <cmath>

namespace lucent {

namespace {

bool number_word(const std::string &p_word, double &r_number) {
	if (p_word == "inf" || p_word == "INF") {
		r_number = HUGE_VAL;
	} else if (p_word == "-inf" || p_word == "inf_neg") {
		r_number = -HUGE_VAL;
	} else if (p_word == "nan" || p_word == "NAN") {
		r_number = std::nan("");
	} else {
		return false;
	}
	return true;
}

// Nesting of arrays, dictionaries and calls; beyond it a text is refused, since parsing recurses.
constexpr int MAX_DEPTH = 64;

class ValueParser {
public:
	ValueParser(TscnTokenizer &r_tokenizer, const TscnResolver &p_resolver) :
			tokens(r_tokenizer), resolver(p_resolver) {}

	bool parse(Variant &r_value, int p_depth) {
		TscnToken token;
		if (!tokens.next(token)) {
			return false;
		}
		if (p_depth > MAX_DEPTH) {
			return tokens.fail(fmt::format("values are nested more than {} deep", MAX_DEPTH));
		}
		switch (token.kind) {
			case TscnTokenKind::STRING:
			case TscnTokenKind::STRING_NAME:
				r_value = std::move(token.text);
				return true;
			case TscnTokenKind::NODE_PATH:
				r_value = NodePath(std::move(token.text));
				return true;
			case TscnTokenKind::NUMBER:
				r_value = token.is_integer ? Variant(token.integer) : Variant(token.number);
				return true;
			case TscnTokenKind::COLOR:
				r_value = hex_color(token.text);
				return true;
			case TscnTokenKind::IDENTIFIER:
				return parse_word(token.text, r_value, p_depth);
			case TscnTokenKind::SYMBOL:
				if (token.is_symbol('[')) {
					return parse_array(r_value, p_depth);
				}
				if (token.is_symbol('{')) {
					return parse_dictionary(r_value, p_depth);
				}
				break;
			case TscnTokenKind::END:
				break;
		}
		return tokens.fail(fmt::format("expected a value, found {}", token.describe()));
	}

private:
	static Color hex_color(const std::string &p_digits) {
		const auto channel = [&](size_t p_at) { return float(std::stoi(p_digits.substr(p_at, 2), nullptr, 16)) / 255.0f; };
		return { channel(0), channel(2), channel(4), p_digits.size() == 8 ? channel(6) : 1.0f };
	}

	bool parse_word(const std::string &p_word, Variant &r_value, int p_depth) {
		double number = 0.0;
		if (p_word == "true" || p_word == "false") {
			r_value = p_word == "true";
			return true;
		}
		if (p_word == "null" || p_word == "nil") {
			r_value = Variant();
			return true;
		}
		if (number_word(p_word, number)) {
			r_value = number;
			return true;
		}
		TscnToken following;
		if (!tokens.peek(following)) {
			return false;
		}
		if ((p_word == "Array" || p_word == "Dictionary") && following.is_symbol('[')) {
			return parse_typed(p_word, r_value, p_depth);
		}
		if (!following.is_symbol('(')) {
			return tokens.fail(fmt::format("'{}' is no value", p_word.substr(0, 40)));
		}
		return tokens.expect('(', "after a type") && parse_call(p_word, r_value, p_depth);
	}

	bool parse_call(const std::string &p_type, Variant &r_value, int p_depth) {
		if (const NumberConstructor *constructor = find_number_constructor(p_type)) {
			return parse_numbers(p_type, 0) && construct(*constructor, r_value);
		}
		if (const NumberConstructor *constructor = find_packed_constructor(p_type)) {
			return parse_packed(*constructor, r_value);
		}
		if (p_type == "Array" || p_type == "Dictionary") {
			return parse(r_value, p_depth + 1) && tokens.expect(')', "after a container's value");
		}
		std::vector<std::string> strings;
		if (p_type == "PackedStringArray") {
			r_value = std::vector<std::string>();
			return parse_strings(p_type, strings) && (r_value = std::move(strings), true);
		}
		if (p_type == "NodePath" || p_type == "StringName") {
			if (!parse_strings(p_type, strings) || !require_one(p_type, strings)) {
				return false;
			}
			r_value = p_type == "NodePath" ? Variant(NodePath(strings[0])) : Variant(strings[0]);
			return true;
		}
		if (p_type == "SubResource" || p_type == "ExtResource" || p_type == "Resource") {
			return parse_reference(p_type, r_value);
		}
		if (p_type == "RID" || p_type == "Callable" || p_type == "Signal") {
			r_value = Variant();
			return parse_strings(p_type, strings);
		}
		if (p_type == "Object") { // Object(Class,"property":value,…)
			scene::LoadReport::warning("Object", fmt::format("{}:{}: Object(…) is read as null", tokens.source(), tokens.line()));
			r_value = Variant();
			return skip_call();
		}
		return tokens.fail(fmt::format("there is no type '{}'", p_type.substr(0, 40)));
	}

	// Everything up to the ')' that belongs to a '(' just taken.
	bool skip_call() {
		int depth = 1;
		TscnToken token;
		while (depth > 0) {
			if (!tokens.next(token)) {
				return false;
			}
			if (token.kind == TscnTokenKind::END) {
				return tokens.fail("expected ')' after the values of Object, found the end of the file");
			}
			depth += token.is_symbol('(') ? 1 : (token.is_symbol(')') ? -1 : 0);
		}
		return true;
	}

	bool construct(const NumberConstructor &p_constructor, Variant &r_value) {
		const bool is_color = numbers.size() == 3 && p_constructor.name == std::string_view("Color");
		if (is_color) {
			numbers.push_back(1.0);
		}
		if (numbers.size() != p_constructor.count) {
			return tokens.fail(fmt::format("{} takes {} numbers, found {}", p_constructor.name, p_constructor.count, numbers.size()));
		}
		r_value = p_constructor.make(numbers);
		return true;
	}

	bool parse_packed(const NumberConstructor &p_constructor, Variant &r_value) {
		TscnToken first;
		if (!tokens.peek(first)) {
			return false;
		}
		if (p_constructor.name == std::string_view("PackedByteArray") && first.kind == TscnTokenKind::STRING) {
			std::vector<std::string> strings;
			if (!parse_strings("PackedByteArray", strings) || !require_one("PackedByteArray", strings)) {
				return false;
			}
			std::optional<std::vector<uint8_t>> bytes = decode_base64(strings[0]);
			if (!bytes) {
				return tokens.fail("PackedByteArray's text is not base64");
			}
			r_value = std::move(*bytes);
			return true;
		}
		if (!parse_numbers(p_constructor.name, p_constructor.count)) {
			return false;
		}
		r_value = p_constructor.make(numbers);
		return true;
	}

	// Numbers up to ')'. p_multiple 0: any count.
	bool parse_numbers(const std::string &p_type, size_t p_multiple) {
		numbers.clear();
		TscnToken token;
		while (!tokens.accept(')')) {
			if (tokens.failed() || (!numbers.empty() && !tokens.expect(',', "between numbers")) || !tokens.next(token)) {
				return false;
			}
			if (token.is_symbol(')') && !numbers.empty()) { // trailing comma
				break;
			}
			double number = token.number;
			if (token.kind != TscnTokenKind::NUMBER && !(token.kind == TscnTokenKind::IDENTIFIER && number_word(token.text, number))) {
				return tokens.fail(fmt::format("expected a number in {}, found {}", p_type, token.describe()));
			}
			numbers.push_back(number);
		}
		if (p_multiple > 1 && numbers.size() % p_multiple != 0) {
			return tokens.fail(fmt::format("{} takes a multiple of {} numbers, found {}", p_type, p_multiple, numbers.size()));
		}
		return true;
	}

	bool parse_strings(const std::string &p_type, std::vector<std::string> &r_strings) {
		TscnToken token;
		while (!tokens.accept(')')) {
			if (tokens.failed() || (!r_strings.empty() && !tokens.expect(',', "between texts")) || !tokens.next(token)) {
				return false;
			}
			if (token.kind != TscnTokenKind::STRING && token.kind != TscnTokenKind::STRING_NAME && token.kind != TscnTokenKind::NODE_PATH) {
				return tokens.fail(fmt::format("expected a text in {}, found {}", p_type, token.describe()));
			}
			r_strings.push_back(std::move(token.text));
		}
		return true;
	}

	bool require_one(const std::string &p_type, const std::vector<std::string> &p_strings) {
		return p_strings.size() == 1 || tokens.fail(fmt::format("{} takes one text", p_type));
	}

	bool parse_reference(const std::string &p_type, Variant &r_value) {
		TscnToken token;
		if (!tokens.next(token)) {
			return false;
		}
		// Ids were numbers until Godot 4.0.
		const bool is_number = token.kind == TscnTokenKind::NUMBER && token.is_integer;
		if (token.kind != TscnTokenKind::STRING && !is_number) {
			return tokens.fail(fmt::format("{} takes a text, found {}", p_type, token.describe()));
		}
		const std::string id = is_number ? std::to_string(token.integer) : token.text;
		while (tokens.accept(',')) { // Resource("uid://…", "res://…")
			if (!tokens.next(token)) {
				return false;
			}
		}
		if (tokens.failed() || !tokens.expect(')', "after a resource's id")) {
			return false;
		}
		if (!resolver) {
			return tokens.fail(fmt::format("{} can't be used here", p_type));
		}
		const std::string path = token.kind == TscnTokenKind::STRING && token.text.starts_with("res://") ? token.text : id;
		Result<Variant> value = p_type == "SubResource" ? resolver(TscnReference::SUB_RESOURCE, id)
				: p_type == "ExtResource"               ? resolver(TscnReference::EXT_RESOURCE, id)
														: resolver(TscnReference::PATH, path);
		if (!value) {
			return tokens.fail(value.error().message);
		}
		r_value = value.take();
		return true;
	}

	// Array[Type]([…]) and Dictionary[Key, Value]({…}); the types are the receiving property's business.
	bool parse_typed(const std::string &p_word, Variant &r_value, int p_depth) {
		int depth = 0;
		TscnToken token;
		do {
			if (!tokens.next(token)) {
				return false;
			}
			depth += token.is_symbol('[') ? 1 : (token.is_symbol(']') ? -1 : 0);
		} while (depth > 0 && token.kind != TscnTokenKind::END);
		return tokens.expect('(', "after a typed container") && parse_call(p_word, r_value, p_depth);
	}

	bool parse_array(Variant &r_value, int p_depth) {
		Array values;
		while (!tokens.accept(']')) {
			if (tokens.failed() || (!values.empty() && !tokens.expect(',', "between the values of an array"))) {
				return false;
			}
			if (!values.empty() && tokens.accept(']')) { // trailing comma
				break;
			}
			if (!parse(values.emplace_back(), p_depth + 1)) {
				return false;
			}
		}
		r_value = std::move(values);
		return true;
	}

	bool parse_dictionary(Variant &r_value, int p_depth) {
		Dictionary dictionary;
		while (!tokens.accept('}')) {
			if (tokens.failed() || (!dictionary.entries.empty() && !tokens.expect(',', "between the entries of a dictionary"))) {
				return false;
			}
			if (!dictionary.entries.empty() && tokens.accept('}')) { // trailing comma
				break;
			}
			Variant key;
			Variant value;
			if (!parse(key, p_depth + 1) || !tokens.expect(':', "after a dictionary's key") || !parse(value, p_depth + 1)) {
				return false;
			}
			dictionary.entries.emplace_back(std::move(key), std::move(value));
		}
		r_value = std::move(dictionary);
		return true;
	}

	TscnTokenizer &tokens;
	const TscnResolver &resolver;
	std::vector<double> numbers;
};

} // namespace

bool parse_variant(TscnTokenizer &r_tokenizer, const TscnResolver &p_resolver, Variant &r_value) {
	return ValueParser(r_tokenizer, p_resolver).parse(r_value, 0);
}

Result<Variant> parse_variant_text(std::string_view p_text, const std::string &p_source) {
	TscnTokenizer tokenizer(p_text, p_source);
	Variant value;
	TscnToken rest;
	if (parse_variant(tokenizer, nullptr, value) && tokenizer.next(rest) && rest.kind != TscnTokenKind::END) {
		tokenizer.fail(fmt::format("expected one value, found {} after it", rest.describe()));
	}
	return tokenizer.failed() ? Result<Variant>(tokenizer.error()) : Result<Variant>(std::move(value));
}

} // namespace lucent
