// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/node_3d.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace lucent::scene {

// Bones in a pose, and nodes that hang on them. Meshes are deformed by loaders, in the pose that the file stands in.
class Skeleton3D : public Node3D {
	LUCENT_CLASS(Skeleton3D, Node3D)
public:
	int get_bone_count() const { return int(bones.size()); }
	// -1: the name is taken or empty. Parents come before children: p_parent is a bone that is there, or -1.
	int add_bone(const std::string &p_name, int p_parent, const Transform3D &p_rest);
	int find_bone(const std::string &p_name) const; // -1: none
	std::string get_bone_name(int p_bone) const;
	int get_bone_parent(int p_bone) const;
	Transform3D get_bone_rest(int p_bone) const;
	Transform3D get_bone_global_pose(int p_bone) const; // to the skeleton

	// bones/N/name, parent, rest, enabled, position, rotation, scale
	bool _set(const std::string &p_name, const Variant &p_value) override;
	bool _get(const std::string &p_name, Variant &r_value) const override;
	void _get_property_list(std::vector<PropertyInfo> &r_list) const override;

private:
	struct Bone {
		std::string name;
		int parent = -1;
		Transform3D rest;
		Vector3 position{ 0.0f };
		Quaternion rotation{ 1.0f, 0.0f, 0.0f, 0.0f };
		Vector3 scale{ 1.0f };
	};
	const Bone *bone(int p_bone) const;
	bool rename_bone(int p_bone, const std::string &p_name); // false: the name is taken or empty
	void pose_changed();

	std::vector<Bone> bones;
	std::unordered_map<std::string, int> names; // to bones
};

// Goes where a bone of the Skeleton3D above (or of another one) is.
class BoneAttachment3D : public Node3D {
	LUCENT_CLASS(BoneAttachment3D, Node3D)
public:
	void set_bone_name(const std::string &p_name);
	std::string get_bone_name() const { return bone_name; }
	void set_bone_idx(int p_bone);
	int get_bone_idx() const { return bone; }
	void set_override_pose(bool p_override) { override_pose = p_override; }
	bool get_override_pose() const { return override_pose; }
	void set_use_external_skeleton(bool p_use);
	bool get_use_external_skeleton() const { return use_external_skeleton; }
	void set_external_skeleton(const NodePath &p_path);
	NodePath get_external_skeleton() const { return external_skeleton; }
	void update_place();

protected:
	void _notification(int p_what) override;

private:
	Skeleton3D *find_skeleton();

	std::string bone_name;
	int bone = -1;
	bool override_pose = false;
	bool use_external_skeleton = false;
	NodePath external_skeleton;
};

} // namespace lucent::scene
