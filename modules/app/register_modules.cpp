// SPDX-License-Identifier: MIT
#include "modules/app/register_modules.h"

#include "modules/scene/image_loader.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/resource_loader.h"
#ifdef MODULE_GLTF_ENABLED
#include "modules/gltf/gltf_scene.h"
#endif
#ifdef MODULE_TSCN_ENABLED
#include "modules/tscn/text_loader.h"
#endif

namespace lucent {

void register_modules() {
	scene::register_scene_classes();
	scene::register_image_loaders();
#ifdef MODULE_TSCN_ENABLED
	register_tscn_loaders();
#endif
#ifdef MODULE_GLTF_ENABLED
	for (const char *extension : { "glb", "gltf" }) {
		scene::ResourceLoader::register_loader(extension, [](const std::string &p_path) -> Result<Ref<Resource>> {
			Result<Ref<scene::PackedScene>> packed = load_gltf_scene(p_path);
			return packed ? Result<Ref<Resource>>(packed.take()) : Result<Ref<Resource>>(packed.error());
		});
	}
#endif
}

} // namespace lucent
