// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/node.h"

namespace lucent::scene {

// A world that several viewports can share.
class World3D : public Resource {
	LUCENT_CLASS(World3D, Resource)
};

// Base of what draws nodes below it into a picture of its own. That picture isn't drawn here, but the world and the cameras below
// a viewport aren't those of the viewport above.
class Viewport : public Node {
	LUCENT_CLASS(Viewport, Node)
public:
	Viewport() = default;
	// True: what is below appears in no other viewport, so in none that is drawn here.
	void set_use_own_world_3d(bool p_own);
	bool is_using_own_world_3d() const { return own_world; }
	// Set: a world beside that of the viewport above.
	void set_world_3d(const Ref<World3D> &p_world);
	Ref<World3D> get_world_3d() const { return world; }
	bool has_separate_world() const { return own_world || world; }

private:
	template <typename F>
	void change_world(F &&p_change);

	Ref<World3D> world;
	bool own_world = false;
};

class SubViewport : public Viewport {
	LUCENT_CLASS(SubViewport, Viewport)
};

class Window : public Viewport {
	LUCENT_CLASS(Window, Viewport)
};

// The nearest Viewport above p_node, which is not p_node itself; null: the tree's own, which shows the scene.
const Viewport *find_viewport(const Node &p_node);
// Whether p_node is in the world that the tree's own viewport shows.
bool is_in_tree_world(const Node &p_node);

} // namespace lucent::scene
