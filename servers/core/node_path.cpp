// SPDX-License-Identifier: MIT
#include "servers/core/node_path.h"

namespace lucent {

static std::vector<std::string> split(const std::string &p_text, char p_separator) {
	std::vector<std::string> parts;
	for (size_t begin = 0; begin <= p_text.size();) {
		size_t end = p_text.find(p_separator, begin);
		end = end == std::string::npos ? p_text.size() : end;
		std::string part = p_text.substr(begin, end - begin);
		if (!part.empty() && part != ".") {
			parts.push_back(std::move(part));
		}
		begin = end + 1;
	}
	return parts;
}

std::vector<std::string> NodePath::get_names() const {
	return split(text.substr(0, text.find(':')), '/');
}

std::vector<std::string> NodePath::get_subnames() const {
	const size_t colon = text.find(':');
	return colon == std::string::npos ? std::vector<std::string>() : split(text.substr(colon + 1), ':');
}

} // namespace lucent
