// SPDX-License-Identifier: MIT
#include "modules/scene/packed_scene.h"

#include "servers/core/class_builder.h"

namespace lucent::scene {

Result<std::unique_ptr<Node>> PackedScene::instantiate() const {
	if (!recipe) {
		return make_error("the scene '{}' is empty", get_path());
	}
	Result<std::unique_ptr<Node>> root = recipe();
	if (root && root.value()) {
		root.value()->set_scene_file_path(get_path());
		root.value()->notification(Node::NOTIFICATION_SCENE_INSTANTIATED);
	}
	return root;
}

void PackedScene::bind(ClassBuilder<PackedScene> &r_class) {
	r_class.doc("A scene from a file, which can be made any number of times.");
	r_class.method("can_instantiate", &PackedScene::can_instantiate).doc("Whether there is a scene.");
	r_class.method("instantiate", &PackedScene::instantiate).doc("The root of a new copy of the scene, outside of any tree.");
}

} // namespace lucent::scene
