// SPDX-License-Identifier: MIT
#include "modules/tscn/text_loader.h"

#include "modules/scene/load_report.h"
#include "modules/tscn/gd_script.h"
#include "modules/tscn/text_scene.h"
#include "modules/tscn/uid_index.h"
#include "servers/core/class_db.h"
#include "servers/core/file_io.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>

namespace lucent {

namespace {

// The files being read, outermost first: to find cycles, and res:// where there is no project.godot.
std::vector<std::string> &loading_stack() {
	thread_local std::vector<std::string> stack;
	return stack;
}

// A cycle, or more nodes or files than fit: such a scene can't be shown in part.
bool &loading_is_endless() {
	thread_local bool endless = false;
	return endless;
}

constexpr size_t MAX_FILE_DEPTH = 64; // scenes in scenes
constexpr size_t MAX_NODE_DEPTH = 256; // names in a parent path
// Scenes in scenes can multiply: 30 files that each hold two of the next are a billion nodes.
constexpr size_t MAX_NODES = 1'000'000;
constexpr uint64_t MAX_TEXT_BYTES = uint64_t(1) << 30;

struct ExternalResource {
	std::string type;
	std::string path;
	std::string uid; // "uid://…"; empty: the path alone counts
	int line = 0;
	bool loaded = false;
	Ref<Resource> resource; // null: not there, a warning was given
};

class TextLoader {
public:
	TextLoader(std::string_view p_text, const std::string &p_path) :
			source(p_path), reader(p_text, p_path, [this](TscnReference p_kind, const std::string &p_id) { return resolve(p_kind, p_id); }) {}

	Result<Ref<Resource>> load() {
		TscnHeader header;
		if (!reader.next_header(header)) {
			return reader.error();
		}
		is_scene = header.tag == "gd_scene";
		if (!is_scene && header.tag != "gd_resource") {
			reader.fail(fmt::format("expected [gd_scene …] or [gd_resource …] first, found {}", header.tag.empty() ? "an empty file" : "[" + header.tag + "]"));
			return reader.error();
		}
		main_type = header.text("type");
		const std::string format = header.text("format");
		if (!format.empty() && format != "3" && format != "4") { // 4: base64 packed arrays, read all the same
			reader.fail(fmt::format("format {} is not Godot 4's (3)", format));
			return reader.error();
		}
		data->source = source;
		while (reader.next_header(header) && !header.tag.empty()) {
			if (!read_section(header)) {
				return reader.error();
			}
		}
		if (reader.failed() || !check_complete()) {
			return reader.error();
		}
		return is_scene ? Ref<Resource>(std::make_shared<TextScene>(data)) : main_resource;
	}

private:
	bool check_complete() {
		if (is_scene && data->nodes.empty()) {
			return reader.fail("the scene has no [node]");
		}
		return is_scene || main_resource || reader.fail("there is no [resource] section");
	}

	bool read_section(const TscnHeader &p_header) {
		if (p_header.tag == "ext_resource") {
			return read_ext_resource(p_header);
		}
		if (p_header.tag == "sub_resource") {
			Ref<Resource> resource;
			const std::string id = p_header.text("id");
			if (!read_resource(p_header, p_header.text("type"), resource)) {
				return false;
			}
			sub_resources[id] = resource;
			return true;
		}
		if (p_header.tag == "resource") {
			return !is_scene ? read_resource(p_header, main_type, main_resource) : reader.fail("[resource] belongs in a .tres");
		}
		if (p_header.tag == "node" && is_scene) {
			return read_node(p_header);
		}
		if (p_header.tag == "connection") {
			data->connections.push_back({ p_header.text("signal"), p_header.text("from"), p_header.text("to"), p_header.text("method") });
		} else if (p_header.tag != "editable") {
			log_warning("{}:{}: section [{}] is unknown and skipped", source, p_header.line, p_header.tag);
		}
		return reader.read_properties(properties);
	}

	bool read_ext_resource(const TscnHeader &p_header) {
		const std::string id = p_header.text("id");
		if (id.empty() || p_header.text("path").empty()) {
			return reader.fail("[ext_resource] needs an id and a path");
		}
		ext_resources[id] = { p_header.text("type"), p_header.text("path"), p_header.text("uid"), p_header.line, false, nullptr };
		return reader.read_properties(properties);
	}

	// r_resource stays null for a class that isn't here.
	bool read_resource(const TscnHeader &p_header, const std::string &p_type, Ref<Resource> &r_resource) {
		if (p_type.empty()) {
			return reader.fail(fmt::format("[{}] needs a type", p_header.tag));
		}
		const bool is_script = is_gd_script(p_type, "");
		r_resource = is_script ? make_gd_script("") : ClassDB::instantiate_resource(p_type);
		if (!r_resource) {
			scene::LoadReport::left_out_class(fmt::format("{}:{}", source, p_header.line), p_type);
		}
		if (!reader.read_properties(properties)) {
			return false;
		}
		for (const TscnProperty &property : properties) {
			if (r_resource && !is_script) {
				set_text_property(*r_resource, property, source);
			}
		}
		if (!r_resource && !is_scene && p_header.tag == "resource") {
			return reader.fail(fmt::format("class {} is not supported", p_type));
		}
		return true;
	}

	bool read_node(const TscnHeader &p_header) {
		TscnNode node;
		node.name = p_header.text("name");
		node.type = p_header.text("type");
		node.parent = p_header.text("parent");
		node.line = p_header.line;
		if (node.name.empty()) {
			return reader.fail("[node] needs a name");
		}
		const bool is_root = data->nodes.empty();
		if (is_root != (p_header.find("parent") == nullptr)) {
			return reader.fail(is_root ? "the first [node] is the root and has no parent" : fmt::format("node '{}' has no parent, but the root is '{}'", node.name, data->nodes[0].name));
		}
		if (size_t(std::count(node.parent.begin(), node.parent.end(), '/')) > MAX_NODE_DEPTH) {
			return reader.fail(fmt::format("node '{}' is more than {} levels deep", node.name, MAX_NODE_DEPTH));
		}
		if (const Variant *groups = p_header.find("groups")) {
			node.groups = variant_or<std::vector<std::string>>(*groups, {});
		}
		if (const Variant *instance = p_header.find("instance")) {
			node.instance = variant_or<Ref<scene::PackedScene>>(*instance, nullptr);
			if (!node.instance && is_root) {
				return reader.fail(last_failure.empty() ? fmt::format("node '{}': what it instances is no scene", node.name) : last_failure);
			}
			if (!node.instance && !instance->is_nil()) {
				scene::LoadReport::error(fmt::format("{}:{}: node '{}' stays empty: what it instances is no scene", source, node.line, node.name));
			}
			node.instance_failed = !node.instance;
		} else if (p_header.find("instance_placeholder")) {
			node.type = "Node3D";
			scene::LoadReport::warning("placeholder", fmt::format("{}:{}: node '{}' is a placeholder, which scripts would fill; left empty", source, node.line, node.name));
		}
		const TextScene *nested = dynamic_cast<const TextScene *>(node.instance.get());
		data->node_count += nested != nullptr ? nested->get_node_count() : 1;
		if (data->node_count > MAX_NODES) {
			loading_is_endless() = true;
			return reader.fail(fmt::format("the scene has more than {} nodes", MAX_NODES));
		}
		if (!reader.read_properties(node.properties)) {
			return false;
		}
		data->nodes.push_back(std::move(node));
		return true;
	}

	Result<Variant> resolve(TscnReference p_kind, const std::string &p_id) {
		if (p_kind == TscnReference::SUB_RESOURCE) {
			const auto found = sub_resources.find(p_id);
			if (found == sub_resources.end()) {
				return make_error("there is no [sub_resource] with id \"{}\" above", p_id);
			}
			return found->second ? Variant(found->second) : Variant();
		}
		if (p_kind == TscnReference::PATH) {
			ExternalResource resource = { "", p_id, "", reader.line(), false, nullptr };
			return load_external(resource);
		}
		const auto found = ext_resources.find(p_id);
		if (found == ext_resources.end()) {
			return make_error("there is no [ext_resource] with id \"{}\"", p_id);
		}
		return load_external(found->second);
	}

	// What can't be read is an error line and null; a cycle or too much of anything ends the whole.
	Result<Variant> load_external(ExternalResource &r_external) {
		if (!r_external.loaded) {
			r_external.loaded = true;
			if (!is_gd_script(r_external.type, r_external.path) && is_without_effect(r_external)) {
				return Variant();
			}
			const Result<std::string> located = locate(r_external);
			if (is_gd_script(r_external.type, r_external.path)) { // its owner's line says what is lost
				r_external.resource = make_gd_script(located ? located.value() : r_external.path);
				return Variant(r_external.resource);
			}
			if (!located) {
				last_failure = located.error().message;
				scene::LoadReport::error(fmt::format("{}:{}: {}", source, r_external.line, last_failure));
				return Variant();
			}
			const std::string &path = located.value();
			if (std::find(loading_stack().begin(), loading_stack().end(), path) != loading_stack().end()) {
				loading_is_endless() = true;
				return make_error("'{}' is part of a cycle: it is being loaded already", r_external.path);
			}
			Result<Ref<Resource>> resource = scene::ResourceLoader::load(path);
			if (resource) {
				r_external.resource = resource.take();
			} else if (loading_is_endless()) {
				return make_error("can't load '{}': {}", r_external.path, resource.error().message);
			} else {
				last_failure = fmt::format("can't load '{}': {}", r_external.path, resource.error().message);
				scene::LoadReport::error(fmt::format("{}:{}: '{}' is left out: {}", source, r_external.line, r_external.path, resource.error().message));
			}
		}
		return r_external.resource ? Variant(r_external.resource) : Variant();
	}

	// A UID counts before the path, as in Godot: files move, and others take their places.
	static Result<std::string> locate_by_uid(const std::string &p_uid, const std::string &p_named, const std::string &p_path, const std::string &p_root) {
		std::error_code error;
		const bool present = !p_path.empty() && std::filesystem::exists(p_path, error);
		const std::string present_uid = present ? file_uid(p_path) : "";
		if (present && (present_uid.empty() || present_uid == p_uid)) {
			return p_path;
		}
		const std::string moved = find_by_uid(p_root, p_uid);
		if (!moved.empty() || present) {
			return moved.empty() ? p_path : moved;
		}
		return make_error("'{}' is left out: there is no such file, and none in {} has {}", p_named, p_root, p_uid);
	}

	Result<std::string> locate(const ExternalResource &p_external) const {
		const std::string folder = path_folder(loading_stack().front());
		const bool by_uid_alone = p_external.path.starts_with("uid://");
		const std::string path = by_uid_alone ? "" : resolve_resource_path(p_external.path, source, folder);
		const std::string uid = by_uid_alone ? p_external.path : p_external.uid;
		return uid.starts_with("uid://") ? locate_by_uid(uid, p_external.path, path, project_folder(source, folder)) : Result<std::string>(path);
	}

	// Scripts, sounds and the like; they may be of kinds that nobody here reads.
	static bool is_without_effect(const ExternalResource &p_external) {
		static constexpr const char *EXTENSIONS[] = { "gdshaderinc", "wav", "ogg", "mp3", "ttf", "otf", "woff", "woff2", "fnt", "translation", "json", "csv" };
		const std::string extension = path_extension(p_external.path);
		const scene::LeftOutKind *kind = scene::find_left_out(p_external.type);
		return (kind != nullptr && kind->effect == scene::LeftOutEffect::NONE) ||
				std::any_of(std::begin(EXTENSIONS), std::end(EXTENSIONS), [&](const char *p_extension) { return extension == p_extension; });
	}

	std::string source;
	TextFileReader reader;
	bool is_scene = false;
	std::string last_failure; // of an external file
	std::string main_type; // of a .tres
	std::unordered_map<std::string, ExternalResource> ext_resources;
	std::unordered_map<std::string, Ref<Resource>> sub_resources;
	Ref<Resource> main_resource;
	std::shared_ptr<TscnSceneData> data = std::make_shared<TscnSceneData>();
	std::vector<TscnProperty> properties;
};

Result<Ref<Resource>> load_text_file(const std::string &p_path) {
	const Result<std::vector<std::byte>> bytes = read_file(p_path, MAX_TEXT_BYTES);
	if (!bytes) {
		return bytes.error();
	}
	return load_text_resource(std::string_view(reinterpret_cast<const char *>(bytes.value().data()), bytes.value().size()), p_path);
}

} // namespace

Result<Ref<Resource>> load_text_resource(std::string_view p_text, const std::string &p_path) {
	std::vector<std::string> &stack = loading_stack();
	const scene::LoadReport::Scope report;
	if (stack.empty()) {
		loading_is_endless() = false;
	}
	if (stack.size() >= MAX_FILE_DEPTH) {
		loading_is_endless() = true;
		return make_error("{}: more than {} scenes within each other", p_path, MAX_FILE_DEPTH);
	}
	stack.push_back(absolute_path(p_path));
	Result<Ref<Resource>> resource = TextLoader(p_text, p_path).load();
	stack.pop_back();
	return resource;
}

void register_tscn_loaders() {
	scene::ResourceLoader::register_loader("tscn", load_text_file);
	scene::ResourceLoader::register_loader("tres", load_text_file);
}

} // namespace lucent
