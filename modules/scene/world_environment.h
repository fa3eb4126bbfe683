// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/environment.h"
#include "modules/scene/node.h"

namespace lucent::scene {

// Gives the scene its environment. Of several the first that entered acts.
class WorldEnvironment : public Node {
	LUCENT_CLASS(WorldEnvironment, Node)
public:
	void set_environment(const Ref<Environment> &p_environment);
	Ref<Environment> get_environment() const { return environment; }

protected:
	void _notification(int p_what) override;

private:
	Ref<Environment> environment;
};

} // namespace lucent::scene
