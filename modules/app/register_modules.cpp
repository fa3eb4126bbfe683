// SPDX-License-Identifier: MIT
#include "modules/app/register_modules.h"

#include "modules/scene/image_loader.h"
#include "modules/scene/register_scene_types.h"
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
	register_gltf_loaders();
#endif
}

} // namespace lucent
