// SPDX-License-Identifier: MIT
#include "modules/tscn/gd_script.h"

#include "modules/scene/node.h"
#include "servers/core/file_io.h"

#include <string_view>
#include <vector>

namespace lucent {

// What an engine would call by itself.
static const char *const CALLBACKS[] = { "_init", "_enter_tree", "_ready", "_process", "_physics_process", "_input",
	"_unhandled_input", "_notification", "_exit_tree" };

Ref<Resource> make_gd_script(const std::string &p_path) {
	const auto script = std::make_shared<Resource>();
	script->set_path(p_path);
	return script;
}

bool is_gd_script(const std::string &p_type, const std::string &p_path) {
	const std::string extension = path_extension(p_path);
	return p_type == "Script" || p_type == "GDScript" || p_type == "CSharpScript" || extension == "gd" || extension == "cs";
}

static std::vector<std::string> callbacks_of(const std::string &p_path) {
	std::vector<std::string> found;
	const Result<std::vector<std::byte>> bytes = read_file(p_path, uint64_t(1) << 20);
	if (!bytes) {
		return found;
	}
	const std::string text = "\n" +
			std::string(reinterpret_cast<const char *>(bytes.value().data()), bytes.value().size());
	for (const char *name : CALLBACKS) {
		if (text.find(std::string("\nfunc ") + name + "(") != std::string::npos) {
			found.push_back(name);
		}
	}
	return found;
}

std::string gd_script_notice(const Object &p_owner, const Resource &p_script) {
	const scene::Node *node = dynamic_cast<const scene::Node *>(&p_owner);
	const std::string name = node ? node->get_name() : p_owner.get_class();
	const std::string path = p_script.get_path();
	std::string lost;
	for (const std::string &callback : path.empty() ? std::vector<std::string>() : callbacks_of(path)) {
		lost += (lost.empty() ? "" : ", ") + callback;
	}
	const std::string file = path.empty() ? "a script" : path.substr(path.rfind('/') + 1);
	return fmt::format("scripts are not run: '{}' loses {}{}; lucent.attach() in Python can replace it", name,
			lost.empty() ? "" : lost + " of ", file);
}

} // namespace lucent
