// SPDX-License-Identifier: MIT
#pragma once
// What tests of text scenes share.
#include "modules/scene/image_loader.h"
#include "modules/scene/packed_scene.h"
#include "modules/scene/register_scene_types.h"
#include "modules/tscn/text_loader.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

namespace lucent::test {

namespace fs = std::filesystem;

// A folder of files; goes away with the test.
struct Project {
	fs::path path;
	Project() {
		std::string name = (fs::temp_directory_path() / "lucent-tscn-XXXXXX").string();
		path = mkdtemp(name.data());
	}
	~Project() {
		std::error_code ignored;
		fs::remove_all(path, ignored);
	}
	std::string file(const std::string &p_name, const std::string &p_text) const {
		fs::create_directories((path / p_name).parent_path());
		std::ofstream(path / p_name, std::ios::binary) << p_text;
		return (path / p_name).string();
	}
};

// Collects warnings while it lives.
struct LogCapture {
	std::vector<std::string> messages;
	int errors = 0;
	int infos = 0;
	LogHandler before;
	LogCapture() {
		before = set_log_handler([this](LogLevel p_level, std::string_view p_message) {
			messages.emplace_back(p_message);
			errors += p_level == LogLevel::ERROR;
			infos += p_level == LogLevel::INFO;
		});
	}
	~LogCapture() { set_log_handler(before); }
	int count(const std::string &p_text) const {
		int found = 0;
		for (const std::string &message : messages) {
			found += message.find(p_text) != std::string::npos;
		}
		return found;
	}
};

// Classes and loaders, as the program has them.
inline Result<Ref<Resource>> load(const std::string &p_path) {
	scene::register_scene_classes();
	scene::register_image_loaders();
	register_tscn_loaders();
	return scene::ResourceLoader::load(p_path);
}

inline std::unique_ptr<scene::Node> build(const std::string &p_path) {
	Result<Ref<Resource>> resource = load(p_path);
	INFO(resource.error().message);
	REQUIRE(resource.ok());
	const Ref<scene::PackedScene> packed = std::dynamic_pointer_cast<scene::PackedScene>(resource.value());
	REQUIRE(packed);
	Result<std::unique_ptr<scene::Node>> root = packed->instantiate();
	INFO(root.error().message);
	REQUIRE(root.ok());
	return root.take();
}

inline std::string failure(const std::string &p_path) {
	Result<Ref<Resource>> resource = load(p_path);
	if (!resource) {
		return resource.error().message;
	}
	const Ref<scene::PackedScene> packed = std::dynamic_pointer_cast<scene::PackedScene>(resource.value());
	REQUIRE(packed);
	const Result<std::unique_ptr<scene::Node>> root = packed->instantiate();
	CHECK_FALSE(root.ok());
	return root.error().message;
}

inline Variant property(scene::Node &p_root, const char *p_node, const char *p_property) {
	scene::Node *node = p_root.get_node_or_null(NodePath(p_node));
	REQUIRE_MESSAGE(node != nullptr, p_node);
	return node->get(p_property);
}

} // namespace lucent::test
