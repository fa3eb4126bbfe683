// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/instance_group.h"
#include "modules/scene/visual_instance_3d.h"

namespace lucent::scene {

// One mesh in many places. Colours and custom data of instances are not read.
class MultiMesh : public Resource {
	LUCENT_CLASS(MultiMesh, Resource)
public:
	enum class TransformFormat : uint8_t {
		TRANSFORM_2D,
		TRANSFORM_3D
	};
	static constexpr int MAX_INSTANCES = 1 << 20;

	struct State {
		TransformFormat transform_format = TransformFormat::TRANSFORM_2D;
		bool use_colors = false;
		bool use_custom_data = false;
		int instance_count = 0;
		int visible_instance_count = -1; // -1: all
		std::vector<float> buffer; // rows of a matrix (2D: 8 numbers, 3D: 12), then a colour and 4 more numbers where they are used
		Ref<Mesh> mesh;
	} state;
	void state_changed() { emit_changed(); }
	std::vector<PlacedMesh> get_placed() const; // what is shown
};

class MultiMeshInstance3D : public GeometryInstance3D {
	LUCENT_CLASS(MultiMeshInstance3D, GeometryInstance3D)
public:
	~MultiMeshInstance3D() override { set_multimesh(nullptr); }
	void set_multimesh(const Ref<MultiMesh> &p_multimesh);
	Ref<MultiMesh> get_multimesh() const { return multimesh; }
	AABB get_aabb() const override;

protected:
	void _notification(int p_what) override;
	void look_changed() override { rebuild(); }

private:
	void rebuild();

	Ref<MultiMesh> multimesh;
	ConnectionID connection = 0;
	InstanceGroup group;
};

} // namespace lucent::scene
