// SPDX-License-Identifier: MIT
#pragma once
// Words of Godot's text format (format 3), shared by the file parser and by single values on the command line.

#include "servers/core/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lucent {

enum class TscnTokenKind : uint8_t {
	SYMBOL, // one of [ ] { } ( ) , : =
	IDENTIFIER,
	STRING,
	STRING_NAME, // &"…" or @"…"
	NODE_PATH, // ^"…"
	NUMBER,
	COLOR, // #rrggbb or #rrggbbaa; text holds the digits
	END,
};

struct TscnToken {
	TscnTokenKind kind = TscnTokenKind::END;
	std::string text; // strings are unescaped
	double number = 0.0;
	int64_t integer = 0;
	bool is_integer = false;

	bool is_symbol(char p_symbol) const { return kind == TscnTokenKind::SYMBOL && text[0] == p_symbol; }
	std::string describe() const; // for messages: "'='", "a number", "the end of the file"
};

class TscnTokenizer {
public:
	// p_text must outlive the tokenizer. p_source names it in messages.
	TscnTokenizer(std::string_view p_text, std::string p_source);

	// False: malformed text, see error(). After the end every token is END.
	bool next(TscnToken &r_token);
	// The next token stays.
	bool peek(TscnToken &r_token);
	// Takes the next token, which must be p_symbol; p_context finishes "expected ')' …" ("after the arguments of Color").
	bool expect(char p_symbol, const char *p_context);
	// Takes the next token if it is p_symbol.
	bool accept(char p_symbol);
	// Whether a property follows: neither '[' nor the end.
	bool at_property();
	// Text up to '=' as a property's name ("tracks/0/type", or quoted); takes the '='.
	bool property_name(std::string &r_name);

	int line() const { return current_line; }
	const std::string &source() const { return source_name; }
	// "file:line: message"; the first one stays. Always false.
	bool fail(const std::string &p_message);
	bool failed() const { return !stored_error.message.empty(); }
	const Error &error() const { return stored_error; }

private:
	bool scan(TscnToken &r_token);
	void skip_space();
	bool scan_string(TscnToken &r_token, TscnTokenKind p_kind);
	bool scan_escape(std::string &r_text);
	bool scan_hex(int p_digits, uint32_t &r_value);
	bool scan_number(TscnToken &r_token);

	std::string_view text;
	std::string source_name;
	size_t position = 0;
	int current_line = 1;
	bool has_peeked = false;
	TscnToken peeked;
	Error stored_error;
};

} // namespace lucent
