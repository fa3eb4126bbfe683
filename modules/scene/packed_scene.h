// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/node.h"

#include <functional>

namespace lucent::scene {

// A scene that can be made any number of times. Loaders give it the recipe; what copies share is up to them.
class PackedScene : public Resource {
	LUCENT_CLASS(PackedScene, Resource)
public:
	using Recipe = std::function<Result<std::unique_ptr<Node>>()>;

	PackedScene() = default;
	explicit PackedScene(Recipe p_recipe) :
			recipe(std::move(p_recipe)) {}
	bool can_instantiate() const { return bool(recipe); }
	// The root of a new copy, outside of any tree.
	Result<std::unique_ptr<Node>> instantiate() const;

private:
	Recipe recipe;
};

} // namespace lucent::scene
