// SPDX-License-Identifier: MIT
#pragma once
// The embedded shaders: module and reflection made at first use; recompiled from source on demand.

#include "servers/rendering/device/shader_ids.gen.h"
#include "servers/rendering/device/shader_reflection.h"

#include <filesystem>

namespace lucent {

struct LoadedShader {
	std::string name;
	DriverShader module; // none: not used yet
	std::filesystem::file_time_type source_time; // of its code, includes among it
	ShaderReflection reflection;
};

class ShaderLibrary {
public:
	explicit ShaderLibrary(RenderingDeviceDriver &p_driver);
	~ShaderLibrary();
	ShaderLibrary(const ShaderLibrary &) = delete;
	ShaderLibrary &operator=(const ShaderLibrary &) = delete;

	const LoadedShader &get(Shader p_shader);
	// Recompiles what changed below p_source_root since the library was made or this last asked. A shader that does not compile, or
	// whose bindings changed, is logged and keeps its old code. r_replaced: modules for the caller to destroy.
	std::vector<Shader> reload(const std::string &p_source_root, std::vector<DriverShader> &r_replaced);

private:
	bool replace(LoadedShader &r_shader, std::span<const uint32_t> p_spirv, std::vector<DriverShader> &r_replaced);
	RenderingDeviceDriver &driver;
	std::vector<LoadedShader> shaders;
};

} // namespace lucent
