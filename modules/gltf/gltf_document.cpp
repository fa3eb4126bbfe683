// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_document.h"

#include "modules/gltf/gltf_loader.h"
#include "servers/core/file_io.h"

#include <nlohmann/json.hpp>

#include <cstring>

namespace lucent {

namespace {

constexpr uint32_t GLB_MAGIC = 0x46546C67; // "glTF"
constexpr uint32_t GLB_JSON = 0x4E4F534A;
constexpr uint32_t GLB_BIN = 0x004E4942;

constexpr const char *SUPPORTED_EXTENSIONS[] = { "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit", "KHR_materials_specular", "KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy", "KHR_materials_iridescence", "KHR_materials_dispersion", "KHR_materials_diffuse_transmission", "KHR_materials_pbrSpecularGlossiness", "EXT_texture_webp", "KHR_texture_basisu", "KHR_texture_transform", "KHR_mesh_quantization", "KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "GODOT_single_root" };

constexpr const char *SILENT_EXTENSIONS[] = { "KHR_xmp", "KHR_xmp_json_ld" }; // say nothing about the picture

uint32_t read_u32(std::span<const std::byte> p_bytes, size_t p_offset) {
	uint32_t value;
	std::memcpy(&value, p_bytes.data() + p_offset, 4);
	return value;
}

struct Container {
	std::span<const std::byte> json;
	std::span<const std::byte> binary;
	bool has_binary = false;
};

[[noreturn]] void fail_container(std::string p_message) {
	throw GltfFailure{ std::move(p_message) };
}

Container split_container(std::span<const std::byte> p_bytes) {
	if (p_bytes.empty()) {
		fail_container("the file is empty, expected glTF 2.0");
	}
	if (p_bytes.size() < 4 || read_u32(p_bytes, 0) != GLB_MAGIC) {
		return { p_bytes, {}, false };
	}
	if (p_bytes.size() < 20) {
		fail_container(fmt::format("expected a .glb header and a JSON chunk, found {} bytes", p_bytes.size()));
	}
	if (read_u32(p_bytes, 4) != 2) {
		fail_container(fmt::format("expected .glb version 2, found {}", read_u32(p_bytes, 4)));
	}
	if (read_u32(p_bytes, 8) > p_bytes.size()) {
		fail_container(fmt::format("the file is truncated: its header says {} bytes, found {}", read_u32(p_bytes, 8), p_bytes.size()));
	}
	const std::span<const std::byte> bytes = p_bytes.first(std::max<size_t>(read_u32(p_bytes, 8), 12));
	Container container;
	size_t offset = 12;
	for (size_t chunk = 0; offset + 8 <= bytes.size(); chunk++) {
		const uint32_t length = read_u32(bytes, offset);
		const uint32_t type = read_u32(bytes, offset + 4);
		offset += 8;
		if (length > bytes.size() - offset) {
			fail_container(fmt::format("chunk {} should have {} bytes, found {}", chunk, length, bytes.size() - offset));
		}
		if (chunk == 0) {
			if (type != GLB_JSON) {
				fail_container("expected a JSON chunk first");
			}
			container.json = bytes.subspan(offset, length);
		} else if (type == GLB_BIN && !container.has_binary) {
			container.binary = bytes.subspan(offset, length);
			container.has_binary = true;
		}
		offset += length;
	}
	if (container.json.empty()) {
		fail_container("the JSON chunk is missing or empty");
	}
	return container;
}

// Counts nesting before the parser builds anything: a parser's and a destructor's stack and memory grow with it.
void check_nesting(std::span<const std::byte> p_json) {
	constexpr int MAX_NESTING = 512;
	int depth = 0;
	bool in_string = false;
	for (size_t i = 0; i < p_json.size(); i++) {
		const char c = char(p_json[i]);
		if (in_string) {
			i += c == '\\';
			in_string = c != '"';
		} else if (c == '"') {
			in_string = true;
		} else if (c == '{' || c == '[') {
			depth++;
			if (depth > MAX_NESTING) {
				fail_container(fmt::format("byte {}: the JSON is nested deeper than {} levels", i, MAX_NESTING));
			}
		} else if (c == '}' || c == ']') {
			depth--;
		}
	}
}

void check_asset(GltfContext &r_context) {
	const JsonView asset = r_context.root.member("asset");
	const std::string version = asset.member("version").to_string();
	if (version.substr(0, version.find('.')) != "2") {
		asset.member("version").fail("expected glTF 2.x, found '{}'", version);
	}
	const std::string minimum = asset.string_or("minVersion", "2.0");
	if (minimum != "2.0") {
		asset.member("minVersion").fail("expected 2.0, found '{}'", minimum);
	}
}

void check_extensions(GltfContext &r_context) {
	const auto is_in = [](std::span<const char *const> p_list, const std::string &p_name) {
		return std::find(p_list.begin(), p_list.end(), p_name) != p_list.end();
	};
	const JsonView required = r_context.root.member("extensionsRequired");
	for (size_t i = 0; i < required.array_size(); i++) {
		const std::string extension = required.element(i).to_string();
		if (!is_in(SUPPORTED_EXTENSIONS, extension)) {
			required.element(i).fail("the file needs the extension '{}', which is not supported", extension);
		}
	}
	const JsonView used = r_context.root.member("extensionsUsed");
	for (size_t i = 0; i < used.array_size(); i++) {
		const std::string extension = used.element(i).to_string();
		r_context.document.has_single_root = r_context.document.has_single_root || extension == "GODOT_single_root";
		if (!is_in(SUPPORTED_EXTENSIONS, extension) && !is_in(SILENT_EXTENSIONS, extension)) {
			r_context.warn("the extension '{}' is not supported and left out", extension);
		}
	}
}

std::vector<std::byte> decode_base64(const JsonView &p_uri, std::string_view p_text) {
	std::vector<std::byte> bytes;
	bytes.reserve(p_text.size() / 4 * 3 + 3);
	while (!p_text.empty() && p_text.back() == '=') {
		p_text.remove_suffix(1);
	}
	uint32_t bits = 0;
	int count = 0;
	for (const char c : p_text) {
		const int value = c >= 'A' && c <= 'Z' ? c - 'A' : c >= 'a' && c <= 'z' ? c - 'a' + 26
				: c >= '0' && c <= '9'                                          ? c - '0' + 52
				: c == '+' || c == '-'                                          ? 62
				: c == '/' || c == '_'                                          ? 63
																				: -1;
		if (value < 0) {
			p_uri.fail("the data is not base64");
		}
		bits = bits << 6 | uint32_t(value);
		count += 6;
		if (count >= 8) {
			count -= 8;
			bytes.push_back(std::byte(bits >> count & 0xFF));
		}
	}
	return bytes;
}

std::string decode_percent(const std::string &p_text) {
	const auto digit = [](char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10
											: c >= 'A' && c <= 'F'                               ? c - 'A' + 10
																								 : -1; };
	std::string decoded;
	for (size_t i = 0; i < p_text.size(); i++) {
		if (p_text[i] == '%' && i + 2 < p_text.size() && digit(p_text[i + 1]) >= 0 && digit(p_text[i + 2]) >= 0) {
			decoded += char(digit(p_text[i + 1]) * 16 + digit(p_text[i + 2]));
			i += 2;
		} else {
			decoded += p_text[i];
		}
	}
	return decoded;
}

void parse_checked(GltfContext &r_context) {
	check_asset(r_context);
	check_extensions(r_context);
	const GltfBuffers buffers(r_context);
	load_materials(r_context, buffers);
	std::vector<GltfRawMesh> meshes = load_meshes(r_context, buffers);
	const GltfPoses poses = load_nodes(r_context, buffers, meshes);
	find_skeletons(r_context, poses);
	pose_meshes(r_context, std::move(meshes), poses);
	if (r_context.root.member("animations").array_size() > 0) {
		r_context.warn("animations are not played");
	}
}

} // namespace

std::vector<std::byte> GltfContext::read_uri(const JsonView &p_uri) {
	const std::string uri = p_uri.to_string();
	if (uri.starts_with("data:")) {
		const size_t comma = uri.find(',');
		if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) {
			p_uri.fail("expected data:…;base64,…");
		}
		charge(uri.size(), 1, p_uri);
		return decode_base64(p_uri, std::string_view(uri).substr(comma + 1));
	}
	std::string decoded = decode_percent(uri);
	if (decoded.find('\\') != std::string::npos) {
		// Windows paths, as some exporters write them; no file of this format's own has such a character in its name.
		warn("{}: '{}' has backslashes where a URI has slashes", p_uri.get_path(), decoded);
		std::replace(decoded.begin(), decoded.end(), '\\', '/');
	}
	if (decoded.empty() || decoded[0] == '/' || decoded.find(':') < decoded.find('/') || decoded.find('\0') != std::string::npos) {
		p_uri.fail("expected a relative path or data:, found '{}'", uri.substr(0, 200));
	}
	if (!reader) {
		p_uri.fail("external files cannot be read here: '{}'", decoded);
	}
	Result<std::vector<std::byte>> bytes = reader(decoded);
	if (!bytes) {
		p_uri.fail("{}", bytes.error().message);
	}
	charge(bytes.value().size(), 1, p_uri);
	return bytes.take();
}

Result<GltfDocument> parse_gltf(std::span<const std::byte> p_bytes, const std::string &p_name, const GltfFileReader &p_reader, const GltfLimits &p_limits) {
	try {
		const Container container = split_container(p_bytes);
		check_nesting(container.json);
		const char *text = reinterpret_cast<const char *>(container.json.data());
		const nlohmann::json json = nlohmann::json::parse(text, text + container.json.size());
		GltfContext context{ p_name, p_reader, p_limits, JsonView(&json, ""), container.binary, container.has_binary, {}, 0 };
		parse_checked(context);
		return std::move(context.document);
	} catch (const GltfFailure &failure) {
		return make_error("{}: {}", p_name, failure.message);
	} catch (const nlohmann::json::exception &exception) {
		// "[json.exception.parse_error.101] parse error at line 3, column 5: …"
		const std::string message = exception.what();
		return make_error("{}: expected JSON: {}", p_name, message.substr(message.find("] ") == std::string::npos ? 0 : message.find("] ") + 2, 300));
	} catch (const std::exception &exception) {
		return make_error("{}: cannot read: {}", p_name, exception.what());
	}
}

Result<GltfDocument> load_gltf(const std::string &p_path) {
	const Result<std::vector<std::byte>> bytes = read_file(p_path);
	if (!bytes) {
		return bytes.error();
	}
	const std::string folder = path_folder(p_path);
	return parse_gltf(bytes.value(), p_path, [&folder](const std::string &p_uri) { return read_file(folder + p_uri); });
}

} // namespace lucent
