// SPDX-License-Identifier: MIT
#include "modules/scene/resource_loader.h"

#include "servers/core/file_io.h"

#include <filesystem>
#include <map>

namespace lucent::scene {

namespace {

// Written at the start of the program, as ClassDB.
std::map<std::string, ResourceLoader::Loader> &loaders() {
	static std::map<std::string, ResourceLoader::Loader> table;
	return table;
}

std::map<std::string, std::weak_ptr<Resource>> &cache() {
	static std::map<std::string, std::weak_ptr<Resource>> table;
	return table;
}

} // namespace

void ResourceLoader::register_loader(const std::string &p_extension, Loader p_loader) {
	loaders()[p_extension] = std::move(p_loader);
}

std::vector<std::string> ResourceLoader::get_extensions() {
	std::vector<std::string> extensions;
	for (const auto &[extension, loader] : loaders()) {
		extensions.push_back(extension);
	}
	return extensions;
}

Result<Ref<Resource>> ResourceLoader::load(const std::string &p_path) {
	std::error_code error;
	const std::filesystem::path path = std::filesystem::absolute(p_path, error).lexically_normal();
	const std::string key = path.string();
	if (Ref<Resource> present = cache()[key].lock()) {
		return present;
	}
	if (!std::filesystem::exists(path, error)) {
		return make_error("{}: there is no such file", p_path.empty() ? "''" : p_path);
	}
	if (std::filesystem::is_directory(path, error)) {
		return make_error("{}: is a folder, expected a file", p_path);
	}
	const auto found = loaders().find(path_extension(key));
	if (found == loaders().end()) {
		std::string known;
		for (const std::string &extension : get_extensions()) {
			known += (known.empty() ? "." : ", .") + extension;
		}
		return make_error("{}: files of this kind can't be read (but {} can)", p_path, known);
	}
	Result<Ref<Resource>> resource = found->second(p_path);
	if (resource) {
		resource.value()->set_path(key);
		cache()[key] = resource.value();
	}
	return resource;
}

} // namespace lucent::scene
