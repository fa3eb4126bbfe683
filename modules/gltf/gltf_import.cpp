// SPDX-License-Identifier: MIT
// Hints in names, and .import files.
#include "modules/gltf/gltf_tree.h"

#include "servers/core/file_io.h"

#include <algorithm>
#include <cstdlib>

namespace lucent {

namespace {

std::string lower(std::string p_text) {
	std::transform(p_text.begin(), p_text.end(), p_text.begin(), [](unsigned char p_c) { return char(std::tolower(p_c)); });
	return p_text;
}

// Length without trailing digits, blanks and "_": what duplicates of a node get.
size_t stem_length(const std::string &p_name) {
	size_t length = p_name.size();
	while (length > 0 && ((p_name[length - 1] >= '0' && p_name[length - 1] <= '9') || (unsigned char)(p_name[length - 1]) <= 32 || p_name[length - 1] == '_')) {
		length--;
	}
	return length;
}

bool ends_in(const std::string &p_stem, const std::string &p_hint) {
	return lower(p_stem).ends_with("-" + p_hint) || lower(p_stem).ends_with("_" + p_hint);
}

} // namespace

bool has_name_hint(const std::string &p_name, const std::string &p_hint) {
	const std::string stem = p_name.substr(0, stem_length(p_name));
	return lower(stem).find("$" + p_hint) != std::string::npos || ends_in(stem, p_hint);
}

std::string without_name_hint(const std::string &p_name, const std::string &p_hint) {
	const size_t length = stem_length(p_name);
	std::string stem = p_name.substr(0, length);
	const size_t dollar = lower(stem).find("$" + p_hint);
	if (dollar != std::string::npos) {
		stem.erase(dollar, p_hint.size() + 1);
	} else if (ends_in(stem, p_hint)) {
		stem.resize(stem.size() - p_hint.size() - 1);
	} else {
		return stem;
	}
	return stem + p_name.substr(length);
}

GltfImportSettings load_gltf_import_settings(const std::string &p_path) {
	GltfImportSettings settings;
	const Result<std::vector<std::byte>> bytes = read_file(p_path + ".import", 1 << 24);
	if (!bytes) {
		return settings;
	}
	settings.naming_version = 0; // of files that don't say
	const std::string text(reinterpret_cast<const char *>(bytes.value().data()), bytes.value().size());
	for (size_t start = 0; start < text.size();) {
		const size_t end = std::min(text.find('\n', start), text.size());
		const std::string line = text.substr(start, end - start);
		start = end + 1;
		const size_t equals = line.find('=');
		if (equals == std::string::npos) {
			continue;
		}
		const std::string key = line.substr(0, equals);
		const std::string value = line.substr(equals + 1);
		if (key == "nodes/root_name" && value.size() >= 2 && value.front() == '"' && value != "\"Scene Root\"") {
			settings.root_name = value.substr(1, value.rfind('"') - 1);
		} else if (key == "nodes/root_scale") {
			const float scale = std::strtof(value.c_str(), nullptr);
			settings.root_scale = std::isfinite(scale) && scale > 0.0f ? scale : 1.0f;
		} else if (key == "nodes/use_name_suffixes") {
			settings.use_name_suffixes = !value.starts_with("false");
		} else if (key == "nodes/use_node_type_suffixes") {
			settings.use_node_type_suffixes = !value.starts_with("false");
		} else if (key == "gltf/naming_version") {
			settings.naming_version = std::atoi(value.c_str());
		}
	}
	return settings;
}

} // namespace lucent
