// SPDX-License-Identifier: MIT
#include "modules/scene/viewport.h"

#include "modules/scene/node_3d.h"
#include "modules/scene/scene_tree.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

const Viewport *find_viewport(const Node &p_node) {
	for (const Node *node = p_node.get_parent(); node; node = node->get_parent()) {
		if (const Viewport *viewport = dynamic_cast<const Viewport *>(node)) {
			return viewport;
		}
	}
	return nullptr;
}

bool is_in_tree_world(const Node &p_node) {
	for (const Viewport *viewport = find_viewport(p_node); viewport; viewport = find_viewport(*viewport)) {
		if (viewport->has_separate_world()) {
			return false;
		}
	}
	return true;
}

static void notify_worlds(Node &r_node, int p_what) {
	for (const std::unique_ptr<Node> &child : r_node.get_children()) {
		if (dynamic_cast<Node3D *>(child.get())) {
			child->notification(p_what);
		}
		notify_worlds(*child, p_what);
	}
}

template <typename F>
void Viewport::change_world(F &&p_change) {
	if (is_inside_tree()) {
		notify_worlds(*this, Node3D::NOTIFICATION_EXIT_WORLD);
	}
	p_change();
	if (is_inside_tree()) {
		notify_worlds(*this, Node3D::NOTIFICATION_ENTER_WORLD);
		get_tree()->world_changed();
	}
}

void Viewport::set_use_own_world_3d(bool p_own) {
	if (p_own != own_world) {
		change_world([&] { own_world = p_own; });
	}
}

void Viewport::set_world_3d(const Ref<World3D> &p_world) {
	if (p_world != world) {
		change_world([&] { world = p_world; });
	}
}

void World3D::bind(ClassBuilder<World3D> &r_class) {
	r_class.doc("A world that several viewports can share.");
}

void Viewport::bind(ClassBuilder<Viewport> &r_class) {
	r_class.doc("Draws what is below it into a picture of its own; that picture is not drawn here.");
	r_class.property("own_world_3d", &Viewport::set_use_own_world_3d, &Viewport::is_using_own_world_3d).doc("Whether what is below is in a world of its own, away from the scene around the viewport.");
	r_class.property("world_3d", &Viewport::set_world_3d, &Viewport::get_world_3d).doc("The world to show in place of the one around the viewport.");
}

void SubViewport::bind(ClassBuilder<SubViewport> &r_class) {
	r_class.doc("A viewport inside of another. Its cameras are never those of the scene around it.");
}

void Window::bind(ClassBuilder<Window> &r_class) {
	r_class.doc("A viewport in a window of its own, which is not opened here.");
}

} // namespace lucent::scene
