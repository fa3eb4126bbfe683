// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/instance_group.h"

#include <map>

namespace lucent::scene {

// Meshes by number, for GridMap.
class MeshLibrary : public Resource {
	LUCENT_CLASS(MeshLibrary, Resource)
public:
	struct Item {
		std::string name;
		Ref<Mesh> mesh;
		Transform3D mesh_transform;
		ShadowCasting cast_shadow = ShadowCasting::ON;
	};
	const Item *find_item(int p_item) const; // null: none

	// item/N/name, mesh, mesh_transform, mesh_cast_shadow; what is for physics and navigation is taken and not kept
	bool _set(const std::string &p_name, const Variant &p_value) override;
	bool _get(const std::string &p_name, Variant &r_value) const override;
	void _get_property_list(std::vector<PropertyInfo> &r_list) const override;

private:
	std::map<int, Item> items;
};

// Meshes of a MeshLibrary in the cells of a grid.
class GridMap : public Node3D {
	LUCENT_CLASS(GridMap, Node3D)
public:
	GridMap() { set_notify_transform(true); }
	~GridMap() override;
	struct State {
		Ref<MeshLibrary> mesh_library;
		Vector3 cell_size{ 2.0f };
		bool cell_center_x = true;
		bool cell_center_y = true;
		bool cell_center_z = true;
		float cell_scale = 1.0f;
	} state;
	void state_changed();
	std::vector<PlacedMesh> get_placed() const;

	// data: a dictionary with "cells", three integers each
	bool _set(const std::string &p_name, const Variant &p_value) override;
	bool _get(const std::string &p_name, Variant &r_value) const override;
	void _get_property_list(std::vector<PropertyInfo> &r_list) const override;

protected:
	void _notification(int p_what) override;

private:
	void rebuild();

	Ref<MeshLibrary> connected; // whose changes are listened to
	ConnectionID connection = 0;
	std::vector<int32_t> cells;
	InstanceGroup group;
};

} // namespace lucent::scene
