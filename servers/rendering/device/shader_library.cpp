// SPDX-License-Identifier: MIT
#include "servers/rendering/device/shader_library.h"

#include "servers/rendering/device/shader_data.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>

namespace lucent {

namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path &p_path) {
	std::ifstream file(p_path, std::ios::binary);
	return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

// The latest change of a file and of all that it includes.
fs::file_time_type newest_change(const fs::path &p_root, const std::string &p_name, std::vector<std::string> &r_seen) {
	if (std::find(r_seen.begin(), r_seen.end(), p_name) != r_seen.end()) {
		return fs::file_time_type::min();
	}
	r_seen.push_back(p_name);
	std::error_code error;
	fs::file_time_type newest = fs::last_write_time(p_root / p_name, error);
	if (error) {
		return fs::file_time_type::min();
	}
	const std::string text = read_text(p_root / p_name);
	for (size_t at = text.find("#include \""); at != std::string::npos; at = text.find("#include \"", at + 1)) {
		const size_t start = at + 10;
		const size_t end = text.find('"', start);
		if (end != std::string::npos) {
			newest = std::max(newest, newest_change(p_root, text.substr(start, end - start), r_seen));
		}
	}
	return newest;
}

std::string quoted(const std::string &p_text) {
	std::string result = "'";
	for (char c : p_text) {
		result += c == '\'' ? std::string("'\\''") : std::string(1, c);
	}
	return result + "'";
}

// Empty: it does not compile; the log says why.
std::vector<uint32_t> compile(const std::string &p_root, const std::string &p_source) {
	std::error_code error;
	const fs::path output = fs::temp_directory_path(error) / fmt::format("lucent-{}.spv", getpid());
	const std::string command = fmt::format("cd {} && glslangValidator -V --target-env vulkan1.3 -I. --quiet -o {} {} 2>&1", quoted(p_root), quoted(output.string()), quoted(p_source));
	FILE *pipe = popen(command.c_str(), "r");
	if (pipe == nullptr) {
		log_error("{}: glslangValidator can't be started", p_source);
		return {};
	}
	std::string messages;
	char chunk[512];
	while (const size_t count = std::fread(chunk, 1, sizeof(chunk), pipe)) {
		messages.append(chunk, count);
	}
	const bool compiled = pclose(pipe) == 0;
	const std::string bytes = read_text(output);
	fs::remove(output, error);
	if (!compiled || bytes.empty() || bytes.size() % 4 != 0) {
		log_error("{} keeps its old code:\n{}", p_source, messages);
		return {};
	}
	std::vector<uint32_t> words(bytes.size() / 4);
	std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char *>(words.data()));
	return words;
}

bool same_interface(const ShaderReflection &p_a, const ShaderReflection &p_b) {
	const auto same = [](const ReflectedBinding &a, const ReflectedBinding &b) {
		return a.set == b.set && a.binding == b.binding && a.kind == b.kind && a.writable == b.writable && a.shape == b.shape && a.storage_format == b.storage_format;
	};
	return p_a.stage == p_b.stage && p_a.push_constants_size_bytes == p_b.push_constants_size_bytes &&
			std::equal(p_a.bindings.begin(), p_a.bindings.end(), p_b.bindings.begin(), p_b.bindings.end(), same);
}

} // namespace

ShaderLibrary::ShaderLibrary(RenderingDeviceDriver &p_driver) :
		driver(p_driver), shaders(size_t(Shader::COUNT)) {
	// A second of slack: files' clocks tick coarsely, and reloading the same code does no harm.
	const fs::file_time_type start = fs::file_time_type::clock::now() - std::chrono::seconds(1);
	for (LoadedShader &shader : shaders) {
		shader.source_time = start;
	}
}

ShaderLibrary::~ShaderLibrary() {
	for (const LoadedShader &shader : shaders) {
		driver.destroy(shader.module);
	}
}

const LoadedShader &ShaderLibrary::get(Shader p_shader) {
	INVARIANT(p_shader < Shader::COUNT, "shader {} does not exist", int(p_shader));
	LoadedShader &shader = shaders[size_t(p_shader)];
	if (!shader.module.is_valid()) {
		const ShaderData &data = SHADER_DATA[size_t(p_shader)];
		const std::span<const uint32_t> spirv(data.spirv, data.word_count);
		Result<ShaderReflection> reflection = reflect_shader(spirv);
		INVARIANT(reflection.ok(), "{}: {}", data.source_path, reflection.error().message);
		shader.name = data.name;
		shader.reflection = reflection.take();
		shader.module = driver.create_shader(spirv, data.name);
		INVARIANT(shader.module.is_valid(), "{}: the driver refuses it", data.source_path);
	}
	return shader;
}

bool ShaderLibrary::replace(LoadedShader &r_shader, std::span<const uint32_t> p_spirv, std::vector<DriverShader> &r_replaced) {
	Result<ShaderReflection> reflection = reflect_shader(p_spirv);
	if (!reflection) {
		log_error("{} keeps its old code: {}", r_shader.name, reflection.error().message);
		return false;
	}
	if (!same_interface(reflection.value(), r_shader.reflection)) {
		log_error("{} keeps its old code: its bindings or push constants changed, which needs a build", r_shader.name);
		return false;
	}
	const DriverShader module = driver.create_shader(p_spirv, r_shader.name);
	if (!module.is_valid()) {
		return false;
	}
	r_replaced.push_back(r_shader.module);
	r_shader.module = module;
	r_shader.reflection = reflection.take();
	return true;
}

std::vector<Shader> ShaderLibrary::reload(const std::string &p_source_root, std::vector<DriverShader> &r_replaced) {
	std::vector<Shader> changed;
	for (size_t i = 0; i < shaders.size(); i++) {
		std::vector<std::string> seen;
		const fs::file_time_type time = newest_change(p_source_root, SHADER_DATA[i].source_path, seen);
		if (time <= shaders[i].source_time) {
			continue;
		}
		shaders[i].source_time = time;
		get(Shader(i));
		const std::vector<uint32_t> spirv = compile(p_source_root, SHADER_DATA[i].source_path);
		if (!spirv.empty() && replace(shaders[i], spirv, r_replaced)) {
			changed.push_back(Shader(i));
		}
	}
	return changed;
}

} // namespace lucent
