// SPDX-License-Identifier: MIT
#pragma once
// From files to Resources, by extension. Modules register what they can read; nobody who loads needs to know them.

#include "servers/core/object.h"

#include <functional>
#include <string>
#include <vector>

namespace lucent::scene {

class ResourceLoader : public Object {
	LUCENT_CLASS(ResourceLoader, Object)
public:
	// A scene becomes a PackedScene, a picture a Texture2D.
	using Loader = std::function<Result<Ref<Resource>>(const std::string &p_path)>;

	// p_extension: lower case, without the dot. A later registration replaces an earlier one.
	static void register_loader(const std::string &p_extension, Loader p_loader);
	static std::vector<std::string> get_extensions(); // sorted

	// While someone holds a file's resource, loading the file again answers the same one. Errors begin with the path.
	static Result<Ref<Resource>> load(const std::string &p_path);
};

} // namespace lucent::scene
