// SPDX-License-Identifier: MIT
#include "modules/tscn/uid_index.h"

#include "servers/core/file_io.h"
#include "servers/core/log.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <unordered_map>

namespace lucent {

namespace fs = std::filesystem;

namespace {

constexpr size_t MAX_FILES = 200'000;
constexpr size_t HEADER_BYTES = 4096; // a header is the first line, a .import file's uid is in its first section

std::string read_start(const fs::path &p_path) {
	std::ifstream file(p_path, std::ios::binary);
	std::string text(HEADER_BYTES, '\0');
	file.read(text.data(), std::streamsize(text.size()));
	text.resize(size_t(std::max<std::streamsize>(file.gcount(), 0)));
	return text;
}

// "uid://abc" that starts at p_from; letters and digits.
std::string uid_at(const std::string &p_text, size_t p_from) {
	size_t end = p_from + 6;
	while (end < p_text.size() && std::isalnum(static_cast<unsigned char>(p_text[end]))) {
		end++;
	}
	return end > p_from + 6 ? p_text.substr(p_from, end - p_from) : "";
}

std::string uid_of_start(const std::string &p_text, bool p_first_line_only) {
	const std::string text = p_first_line_only ? p_text.substr(0, p_text.find('\n')) : p_text;
	const size_t found = text.find("uid=\"uid://");
	return found == std::string::npos ? "" : uid_at(text, found + 5);
}

// Sets r_path to the file that p_file speaks of: itself, or the one that it stands beside.
std::string uid_of_entry(const fs::path &p_file, std::string &r_path) {
	const std::string extension = p_file.extension().string();
	r_path = p_file.string();
	if (extension == ".tscn" || extension == ".tres") {
		return uid_of_start(read_start(p_file), true);
	}
	if (extension == ".import" || extension == ".uid") {
		r_path = r_path.substr(0, r_path.size() - extension.size());
		const std::string text = read_start(p_file);
		return extension == ".import" ? uid_of_start(text, false) : (text.starts_with("uid://") ? uid_at(text, 0) : "");
	}
	return "";
}

using Index = std::unordered_map<std::string, std::string>;

Index read_folder(const std::string &p_root) {
	Index index;
	std::error_code error;
	size_t count = 0;
	for (fs::recursive_directory_iterator i(p_root, fs::directory_options::skip_permission_denied, error), end; !error && i != end; i.increment(error)) {
		if (i->path().filename().string().starts_with(".")) {
			i.disable_recursion_pending();
			continue;
		}
		if (++count > MAX_FILES) {
			log_warning("{}: has more than {} files; UIDs of the others are not known", p_root, MAX_FILES);
			break;
		}
		std::error_code ignored;
		std::string path;
		const std::string uid = i->is_regular_file(ignored) ? uid_of_entry(i->path(), path) : "";
		if (!uid.empty() && fs::exists(path, ignored)) {
			index.emplace(uid, path);
		}
	}
	return index;
}

} // namespace

std::string file_uid(const std::string &p_path) {
	std::string ignored;
	for (const char *ending : { "", ".import", ".uid" }) {
		if (const std::string uid = uid_of_entry(p_path + ending, ignored); !uid.empty()) {
			return uid;
		}
	}
	return "";
}

std::string find_by_uid(const std::string &p_root, const std::string &p_uid) {
	static std::map<std::string, Index> indices;
	auto found = indices.find(p_root);
	if (found == indices.end()) {
		found = indices.emplace(p_root, read_folder(p_root)).first;
	}
	const auto entry = found->second.find(p_uid);
	return entry == found->second.end() ? "" : entry->second;
}

} // namespace lucent
