// SPDX-License-Identifier: MIT
#include "modules/scene/world_environment.h"

#include "modules/scene/scene_tree.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

void WorldEnvironment::set_environment(const Ref<Environment> &p_environment) {
	const Ref<Environment> old = std::exchange(environment, p_environment); // lives until the server has the new one
	if (is_inside_tree()) {
		get_tree()->update_environment();
	}
}

void WorldEnvironment::_notification(int p_what) {
	Node::_notification(p_what);
	if (p_what == NOTIFICATION_ENTER_TREE) {
		get_tree()->environment_entered(this);
	} else if (p_what == NOTIFICATION_EXIT_TREE) {
		get_tree()->environment_left(this);
	}
}

void WorldEnvironment::bind(ClassBuilder<WorldEnvironment> &r_class) {
	r_class.doc("Gives the scene its environment.");
	r_class.property("environment", &WorldEnvironment::set_environment, &WorldEnvironment::get_environment).doc("Background, ambient light, tone mapping, global illumination.");
}

} // namespace lucent::scene
