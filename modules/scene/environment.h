// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/sky.h"

namespace lucent::scene {

// Background, ambient light, tone mapping, SDFGI.
class Environment : public ServerResource {
	LUCENT_CLASS(Environment, Resource)
public:
	struct State {
		Color background_color{ 0, 0, 0, 1 }; // sRGB-encoded
		Color ambient_light_color{ 0, 0, 0, 1 }; // sRGB-encoded
		Ref<Sky> sky;
		Vector3 sky_rotation{ 0.0f }; // Euler angles, radians, YXZ
	};
	~Environment() override { leave_context(); }

	// After an edit of these: state_changed().
	State state;
	lucent::Environment parameters; // modes, energies, tone mapping; colours, sky, rotation and sdfgi here are not used
	SdfgiSettings sdfgi;

	// Three views of one number: cell, half width of cascade 0 (64 cells), half width of the last cascade. Setting one moves the
	// others; changing the count of cascades keeps the cell. The cell stays between 1e-6 and 1e6 m: the inspector
	// of Godot ends at 0.01 and 64.
	void set_sdfgi_cascades(int p_cascades);
	int get_sdfgi_cascades() const { return int(sdfgi.cascades); }
	void set_sdfgi_min_cell_size(float p_size_m);
	float get_sdfgi_min_cell_size() const { return sdfgi.min_cell_size_m; }
	void set_sdfgi_cascade0_distance(float p_distance_m);
	float get_sdfgi_cascade0_distance() const;
	void set_sdfgi_max_distance(float p_distance_m);
	float get_sdfgi_max_distance() const;

	EnvironmentRid get_rid(SceneContext &p_context);

protected:
	void send(SceneContext &p_context) override;
	void free_server_objects(RenderingServer &p_server) override;

private:
	lucent::Environment resolve(SceneContext &p_context) const;

	EnvironmentRid rid;
	lucent::Environment sent; // what the server has
};

} // namespace lucent::scene
