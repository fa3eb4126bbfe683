// SPDX-License-Identifier: MIT
#include "modules/tscn/text_file.h"

#include "servers/core/variant_cast.h"

#include <algorithm>

namespace lucent {

const Variant *TscnHeader::find(const char *p_name) const {
	const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const TscnProperty &p_attribute) { return p_attribute.name == p_name; });
	return found == attributes.end() ? nullptr : &found->value;
}

std::string TscnHeader::text(const char *p_name) const {
	const Variant *value = find(p_name);
	if (value == nullptr) {
		return "";
	}
	const std::optional<std::string> text = variant_cast<std::string>(*value);
	return text ? *text : value->to_string();
}

bool TextFileReader::next_header(TscnHeader &r_header) {
	r_header = TscnHeader();
	TscnToken token;
	if (!tokens.next(token)) {
		return false;
	}
	r_header.line = tokens.line();
	if (token.kind == TscnTokenKind::END) {
		return true;
	}
	if (!token.is_symbol('[')) {
		return tokens.fail(fmt::format("expected a [section], found {}", token.describe()));
	}
	if (!tokens.next(token)) {
		return false;
	}
	if (token.kind != TscnTokenKind::IDENTIFIER) {
		return tokens.fail(fmt::format("expected a section's name after '[', found {}", token.describe()));
	}
	r_header.tag = token.text;
	while (!tokens.accept(']')) {
		if (tokens.failed() || !tokens.next(token)) {
			return false;
		}
		if (token.kind != TscnTokenKind::IDENTIFIER) {
			return tokens.fail(fmt::format("expected 'key = value' or ']' in [{}], found {}", r_header.tag, token.describe()));
		}
		TscnProperty &attribute = r_header.attributes.emplace_back();
		attribute.name = token.text;
		attribute.line = tokens.line();
		if (!tokens.expect('=', "after an attribute's name") || !parse_variant(tokens, resolver, attribute.value)) {
			return false;
		}
	}
	return true;
}

bool TextFileReader::read_properties(std::vector<TscnProperty> &r_properties) {
	r_properties.clear();
	while (tokens.at_property()) {
		TscnProperty &property = r_properties.emplace_back();
		if (!tokens.property_name(property.name)) {
			return false;
		}
		property.line = tokens.line();
		if (!parse_variant(tokens, resolver, property.value)) {
			return false;
		}
	}
	return !tokens.failed();
}

} // namespace lucent
