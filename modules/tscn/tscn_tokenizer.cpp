// SPDX-License-Identifier: MIT
#include "modules/tscn/tscn_tokenizer.h"

#include <charconv>
#include <cmath>

namespace lucent {

static bool is_digit(char p_char) {
	return p_char >= '0' && p_char <= '9';
}
static bool is_identifier_start(char p_char) {
	return (p_char >= 'a' && p_char <= 'z') || (p_char >= 'A' && p_char <= 'Z') || p_char == '_';
}

static void append_utf8(std::string &r_text, uint32_t p_code) {
	if (p_code < 0x80) {
		r_text += char(p_code);
	} else if (p_code < 0x800) {
		r_text += char(0xC0 | (p_code >> 6));
		r_text += char(0x80 | (p_code & 0x3F));
	} else if (p_code < 0x10000) {
		r_text += char(0xE0 | (p_code >> 12));
		r_text += char(0x80 | ((p_code >> 6) & 0x3F));
		r_text += char(0x80 | (p_code & 0x3F));
	} else {
		r_text += char(0xF0 | (p_code >> 18));
		r_text += char(0x80 | ((p_code >> 12) & 0x3F));
		r_text += char(0x80 | ((p_code >> 6) & 0x3F));
		r_text += char(0x80 | (p_code & 0x3F));
	}
}

std::string TscnToken::describe() const {
	switch (kind) {
		case TscnTokenKind::SYMBOL:
		case TscnTokenKind::IDENTIFIER:
			return "'" + text.substr(0, 40) + "'";
		case TscnTokenKind::STRING:
		case TscnTokenKind::STRING_NAME:
		case TscnTokenKind::NODE_PATH:
			return "\"" + text.substr(0, 40) + "\"";
		case TscnTokenKind::NUMBER:
			return "a number";
		case TscnTokenKind::COLOR:
			return "#" + text;
		case TscnTokenKind::END:
			break;
	}
	return "the end of the text";
}

TscnTokenizer::TscnTokenizer(std::string_view p_text, std::string p_source) :
		text(p_text), source_name(std::move(p_source)) {
	if (text.starts_with("\xEF\xBB\xBF")) {
		position = 3;
	}
}

bool TscnTokenizer::fail(const std::string &p_message) {
	if (!failed()) {
		stored_error = make_error("{}:{}: {}", source_name, current_line, p_message);
	}
	return false;
}

bool TscnTokenizer::next(TscnToken &r_token) {
	if (has_peeked) {
		has_peeked = false;
		r_token = std::move(peeked);
		return true;
	}
	return scan(r_token);
}

bool TscnTokenizer::peek(TscnToken &r_token) {
	if (!has_peeked) {
		if (!scan(peeked)) {
			return false;
		}
		has_peeked = true;
	}
	r_token = peeked;
	return true;
}

bool TscnTokenizer::expect(char p_symbol, const char *p_context) {
	TscnToken token;
	if (!next(token)) {
		return false;
	}
	return token.is_symbol(p_symbol) || fail(fmt::format("expected '{}' {}, found {}", p_symbol, p_context, token.describe()));
}

bool TscnTokenizer::accept(char p_symbol) {
	if (!has_peeked) {
		if (!scan(peeked)) {
			return false;
		}
		has_peeked = true;
	}
	if (!peeked.is_symbol(p_symbol)) {
		return false;
	}
	has_peeked = false;
	return true;
}

bool TscnTokenizer::at_property() {
	skip_space();
	return !has_peeked && position < text.size() && text[position] != '[';
}

bool TscnTokenizer::property_name(std::string &r_name) {
	TscnToken token;
	skip_space();
	if (position < text.size() && text[position] == '"') {
		return next(token) && (r_name = token.text, expect('=', "after a property's name"));
	}
	const size_t start = position;
	while (position < text.size() && text[position] != '=' && text[position] != '\n') {
		position++;
	}
	size_t end = position;
	while (end > start && (text[end - 1] == ' ' || text[end - 1] == '\t' || text[end - 1] == '\r')) {
		end--;
	}
	r_name = std::string(text.substr(start, end - start));
	if (position >= text.size() || text[position] != '=' || r_name.empty()) {
		return fail(fmt::format("expected 'property = value' or a [section], found '{}'", r_name.substr(0, 40)));
	}
	position++;
	return true;
}

void TscnTokenizer::skip_space() {
	for (; position < text.size(); position++) {
		const char c = text[position];
		if (c == '\n') {
			current_line++;
		} else if (c == ';') {
			while (position + 1 < text.size() && text[position + 1] != '\n') {
				position++;
			}
		} else if (c != ' ' && c != '\t' && c != '\r') {
			break;
		}
	}
}

bool TscnTokenizer::scan(TscnToken &r_token) {
	skip_space();
	r_token = TscnToken();
	if (position >= text.size()) {
		return true;
	}
	const char c = text[position];
	const char following = position + 1 < text.size() ? text[position + 1] : '\0';
	if (std::string_view("[]{}(),:=").find(c) != std::string_view::npos) {
		r_token.kind = TscnTokenKind::SYMBOL;
		r_token.text = c;
		position++;
		return true;
	}
	if (c == '"') {
		return scan_string(r_token, TscnTokenKind::STRING);
	}
	if ((c == '&' || c == '@' || c == '^') && following == '"') {
		position++;
		return scan_string(r_token, c == '^' ? TscnTokenKind::NODE_PATH : TscnTokenKind::STRING_NAME);
	}
	if (is_digit(c) || ((c == '-' || c == '+' || c == '.') && (is_digit(following) || following == '.'))) {
		return scan_number(r_token);
	}
	if (is_identifier_start(c) || (c == '-' && is_identifier_start(following))) { // -inf
		const size_t start = position++;
		while (position < text.size() && (is_identifier_start(text[position]) || is_digit(text[position]))) {
			position++;
		}
		r_token.kind = TscnTokenKind::IDENTIFIER;
		r_token.text = std::string(text.substr(start, position - start));
		return true;
	}
	if (c == '#') {
		const size_t start = ++position;
		while (position < text.size() && std::isxdigit(static_cast<unsigned char>(text[position]))) {
			position++;
		}
		r_token.kind = TscnTokenKind::COLOR;
		r_token.text = std::string(text.substr(start, position - start));
		const size_t digits = r_token.text.size();
		return digits == 6 || digits == 8 || fail("a colour is #rrggbb or #rrggbbaa");
	}
	if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) >= 127) {
		return fail(fmt::format("unexpected byte 0x{:02x}: not a text scene, or damaged", static_cast<unsigned char>(c)));
	}
	return fail(fmt::format("unexpected character '{}'", c));
}

bool TscnTokenizer::scan_string(TscnToken &r_token, TscnTokenKind p_kind) {
	const int first_line = current_line;
	r_token.kind = p_kind;
	position++;
	while (position < text.size() && text[position] != '"') {
		const char c = text[position++];
		if (c == '\\') {
			if (!scan_escape(r_token.text)) {
				return false;
			}
			continue;
		}
		if (c == '\n') {
			current_line++;
		}
		r_token.text += c;
	}
	if (position >= text.size()) {
		current_line = first_line;
		return fail("this string has no closing quote");
	}
	position++;
	return true;
}

bool TscnTokenizer::scan_escape(std::string &r_text) {
	if (position >= text.size()) {
		return fail("the text ends in an escape");
	}
	const char c = text[position++];
	uint32_t code = 0;
	switch (c) {
		case 'b':
			r_text += '\b';
			return true;
		case 't':
			r_text += '\t';
			return true;
		case 'n':
			r_text += '\n';
			return true;
		case 'f':
			r_text += '\f';
			return true;
		case 'r':
			r_text += '\r';
			return true;
		case 'u':
		case 'U':
			if (!scan_hex(c == 'u' ? 4 : 6, code)) {
				return false;
			}
			break;
		default:
			if (c == '\n') {
				current_line++;
			}
			r_text += c;
			return true;
	}
	if (code >= 0xD800 && code < 0xDC00 && text.substr(position, 2) == "\\u") { // surrogate pair
		position += 2;
		uint32_t low = 0;
		if (!scan_hex(4, low)) {
			return false;
		}
		code = 0x10000 + ((code - 0xD800) << 10) + ((low - 0xDC00) & 0x3FF);
	}
	if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) {
		return fail("an escape names no Unicode character");
	}
	append_utf8(r_text, code);
	return true;
}

bool TscnTokenizer::scan_hex(int p_digits, uint32_t &r_value) {
	const std::string_view digits = text.substr(position, size_t(p_digits));
	const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), r_value, 16);
	if (status != std::errc() || end != digits.data() + p_digits) {
		return fail(fmt::format("expected {} hexadecimal digits in an escape", p_digits));
	}
	position += size_t(p_digits);
	return true;
}

bool TscnTokenizer::scan_number(TscnToken &r_token) {
	r_token.kind = TscnTokenKind::NUMBER;
	const size_t start = text[position] == '+' ? position + 1 : position;
	size_t end = start;
	bool integer = true;
	while (end < text.size()) {
		const char c = text[end];
		const bool exponent = c == 'e' || c == 'E';
		const bool sign = (c == '-' || c == '+') && (end == start || text[end - 1] == 'e' || text[end - 1] == 'E');
		if (!is_digit(c) && c != '.' && !exponent && !sign) {
			break;
		}
		integer = integer && c != '.' && !exponent;
		end++;
	}
	const char *first = text.data() + start;
	const char *last = text.data() + end;
	if (integer) {
		const auto [stop, status] = std::from_chars(first, last, r_token.integer);
		integer = status == std::errc() && stop == last; // beyond 64 bits: a float
	}
	r_token.is_integer = integer;
	const auto [stop, status] = std::from_chars(first, last, r_token.number);
	if (stop != last || status == std::errc::invalid_argument) {
		return fail(fmt::format("malformed number '{}'", text.substr(start, std::min<size_t>(end - start, 40))));
	}
	if (status == std::errc::result_out_of_range) {
		r_token.number = std::string_view(first, size_t(last - first)).find("e-") != std::string_view::npos ? 0.0 : HUGE_VAL;
		if (*first == '-') {
			r_token.number = -r_token.number;
		}
	}
	position = end;
	return true;
}

} // namespace lucent
