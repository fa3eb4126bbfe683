// SPDX-License-Identifier: MIT
#pragma once
// The structure of a .tscn or .tres: sections with attributes, then properties.

#include "modules/tscn/variant_parser.h"

#include <string>
#include <vector>

namespace lucent {

struct TscnProperty {
	std::string name;
	Variant value;
	int line = 0;
};

// [tag key=value …]
struct TscnHeader {
	std::string tag; // empty: the file ends
	std::vector<TscnProperty> attributes;
	int line = 0;

	const Variant *find(const char *p_name) const; // null: no such attribute
	// A text attribute, or "" where there is none; numbers are written out.
	std::string text(const char *p_name) const;
};

class TextFileReader {
public:
	TextFileReader(std::string_view p_text, std::string p_source, TscnResolver p_resolver) :
			tokens(p_text, std::move(p_source)), resolver(std::move(p_resolver)) {}

	// False: see error().
	bool next_header(TscnHeader &r_header);
	// The properties up to the next section.
	bool read_properties(std::vector<TscnProperty> &r_properties);

	bool fail(const std::string &p_message) { return tokens.fail(p_message); }
	bool failed() const { return tokens.failed(); }
	const Error &error() const { return tokens.error(); }
	int line() const { return tokens.line(); }

private:
	TscnTokenizer tokens;
	TscnResolver resolver;
};

} // namespace lucent
