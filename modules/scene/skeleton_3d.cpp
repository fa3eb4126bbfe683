// SPDX-License-Identifier: MIT
#include "modules/scene/skeleton_3d.h"

#include "servers/core/class_builder.h"

#include <charconv>

namespace lucent::scene {

constexpr int MAX_BONES = 65536; // indices of joints in files have 16 bits

int Skeleton3D::add_bone(const std::string &p_name, int p_parent, const Transform3D &p_rest) {
	if (p_name.empty() || find_bone(p_name) >= 0 || p_parent >= get_bone_count() || get_bone_count() >= MAX_BONES) {
		return -1;
	}
	const RotationScale parts = decompose_basis(p_rest.basis);
	bones.push_back({ p_name, p_parent, p_rest, p_rest.origin, glm::quat_cast(parts.rotation), parts.scale });
	names.emplace(p_name, get_bone_count() - 1);
	return get_bone_count() - 1;
}

int Skeleton3D::find_bone(const std::string &p_name) const {
	const auto found = names.find(p_name);
	return found == names.end() ? -1 : found->second;
}

bool Skeleton3D::rename_bone(int p_bone, const std::string &p_name) {
	const int taken = find_bone(p_name);
	if (p_name.empty() || (taken >= 0 && taken != p_bone)) {
		return false;
	}
	names.erase(bones[size_t(p_bone)].name);
	names.emplace(p_name, p_bone);
	bones[size_t(p_bone)].name = p_name;
	return true;
}

const Skeleton3D::Bone *Skeleton3D::bone(int p_bone) const {
	return p_bone >= 0 && p_bone < get_bone_count() ? &bones[size_t(p_bone)] : nullptr;
}

std::string Skeleton3D::get_bone_name(int p_bone) const {
	return bone(p_bone) ? bone(p_bone)->name : "";
}

int Skeleton3D::get_bone_parent(int p_bone) const {
	return bone(p_bone) ? bone(p_bone)->parent : -1;
}

Transform3D Skeleton3D::get_bone_rest(int p_bone) const {
	return bone(p_bone) ? bone(p_bone)->rest : Transform3D();
}

Transform3D Skeleton3D::get_bone_global_pose(int p_bone) const {
	Transform3D pose;
	for (const Bone *b = bone(p_bone); b; b = bone(b->parent)) {
		pose = Transform3D{ compose_basis(glm::mat3_cast(b->rotation), b->scale), b->position } * pose;
	}
	return pose;
}

void Skeleton3D::pose_changed() {
	for (const std::unique_ptr<Node> &child : get_children()) {
		if (BoneAttachment3D *attachment = dynamic_cast<BoneAttachment3D *>(child.get())) {
			attachment->update_place();
		}
	}
}

// "bones/12/rest": 12 and "rest". False: another name.
static bool split_bone_property(const std::string &p_name, int &r_bone, std::string &r_field) {
	if (!p_name.starts_with("bones/")) {
		return false;
	}
	const char *end = p_name.data() + p_name.size();
	const auto [rest, status] = std::from_chars(p_name.data() + 6, end, r_bone);
	if (status != std::errc() || rest == end || *rest != '/' || r_bone < 0 || r_bone >= MAX_BONES) {
		return false;
	}
	r_field.assign(rest + 1, end);
	return true;
}

template <typename T>
static bool assign(T &r_field, const Variant &p_value) {
	const std::optional<T> value = variant_cast<T>(p_value);
	if (value) {
		r_field = *value;
	}
	return value.has_value();
}

bool Skeleton3D::_set(const std::string &p_name, const Variant &p_value) {
	int index = 0;
	std::string field;
	if (!split_bone_property(p_name, index, field) || index > get_bone_count() || (index == get_bone_count() && field != "name")) {
		return false;
	}
	if (field == "enabled" || field == "bone_meta") {
		return true;
	}
	if (index == get_bone_count()) {
		return add_bone(variant_or<std::string>(p_value, ""), -1, Transform3D()) >= 0;
	}
	Bone &target = bones[size_t(index)];
	bool done = false;
	if (field == "name") {
		done = rename_bone(index, variant_or<std::string>(p_value, ""));
	} else if (field == "parent") {
		const int parent = variant_or<int>(p_value, index);
		done = parent >= -1 && parent < index; // so that no bone is its own ancestor
		target.parent = done ? parent : target.parent;
	} else if (field == "rest") {
		done = assign(target.rest, p_value);
	} else if (field == "position") {
		done = assign(target.position, p_value);
	} else if (field == "rotation") {
		done = assign(target.rotation, p_value);
	} else if (field == "scale") {
		done = assign(target.scale, p_value);
	}
	if (done) {
		pose_changed();
	}
	return done;
}

bool Skeleton3D::_get(const std::string &p_name, Variant &r_value) const {
	int index = 0;
	std::string field;
	if (!split_bone_property(p_name, index, field)) {
		return false;
	}
	if (index == get_bone_count() && field == "name") { // one that may be set
		r_value = std::string();
		return true;
	}
	if (!bone(index)) {
		return false;
	}
	const Bone &source = *bone(index);
	if (field == "name") {
		r_value = source.name;
	} else if (field == "parent") {
		r_value = int64_t(source.parent);
	} else if (field == "rest") {
		r_value = source.rest;
	} else if (field == "position") {
		r_value = source.position;
	} else if (field == "rotation") {
		r_value = source.rotation;
	} else if (field == "scale") {
		r_value = source.scale;
	} else if (field == "enabled") {
		r_value = true;
	} else {
		return false;
	}
	return true;
}

void Skeleton3D::_get_property_list(std::vector<PropertyInfo> &r_list) const {
	static constexpr std::pair<const char *, Variant::Type> FIELDS[] = { { "name", Variant::Type::STRING }, { "parent", Variant::Type::INT }, { "rest", Variant::Type::TRANSFORM3D },
		{ "position", Variant::Type::VECTOR3 }, { "rotation", Variant::Type::QUATERNION }, { "scale", Variant::Type::VECTOR3 } };
	for (int i = 0; i < get_bone_count(); i++) {
		for (const auto &[name, type] : FIELDS) {
			PropertyInfo property;
			property.name = fmt::format("bones/{}/{}", i, name);
			property.type = type;
			r_list.push_back(std::move(property));
		}
	}
}

Skeleton3D *BoneAttachment3D::find_skeleton() {
	return dynamic_cast<Skeleton3D *>(use_external_skeleton ? get_node_or_null(external_skeleton) : get_parent());
}

void BoneAttachment3D::update_place() {
	const Skeleton3D *skeleton = find_skeleton();
	if (!skeleton || override_pose) {
		return;
	}
	const int named = bone_name.empty() ? -1 : skeleton->find_bone(bone_name);
	const int index = named >= 0 ? named : bone;
	if (index < 0 || index >= skeleton->get_bone_count()) {
		return;
	}
	const Transform3D pose = skeleton->get_bone_global_pose(index);
	if (use_external_skeleton) {
		set_global_transform(skeleton->get_global_transform() * pose);
	} else {
		set_transform(pose);
	}
}

void BoneAttachment3D::set_bone_name(const std::string &p_name) {
	bone_name = p_name;
	if (const Skeleton3D *skeleton = find_skeleton(); skeleton && skeleton->find_bone(bone_name) >= 0) {
		bone = skeleton->find_bone(bone_name);
	}
	update_place();
}

void BoneAttachment3D::set_bone_idx(int p_bone) {
	bone = p_bone;
	if (const Skeleton3D *skeleton = find_skeleton(); skeleton && bone >= 0 && bone < skeleton->get_bone_count()) {
		bone_name = skeleton->get_bone_name(bone);
	}
	update_place();
}

void BoneAttachment3D::set_use_external_skeleton(bool p_use) {
	use_external_skeleton = p_use;
	update_place();
}

void BoneAttachment3D::set_external_skeleton(const NodePath &p_path) {
	external_skeleton = p_path;
	update_place();
}

void BoneAttachment3D::_notification(int p_what) {
	Node3D::_notification(p_what);
	if (p_what == NOTIFICATION_PARENTED || p_what == NOTIFICATION_ENTER_TREE || p_what == NOTIFICATION_READY) {
		update_place();
	}
}

void Skeleton3D::bind(ClassBuilder<Skeleton3D> &r_class) {
	r_class.doc("Bones in a pose. Meshes show the pose that their file stands in.");
	r_class.method("get_bone_count", &Skeleton3D::get_bone_count).doc("How many bones there are.");
	r_class.method("find_bone", &Skeleton3D::find_bone, { "name" }).doc("The bone of that name, or -1.");
	r_class.method("get_bone_name", &Skeleton3D::get_bone_name, { "bone_idx" }).doc("A bone's name.");
	r_class.method("get_bone_parent", &Skeleton3D::get_bone_parent, { "bone_idx" }).doc("The bone that a bone hangs on, or -1.");
	r_class.method("get_bone_rest", &Skeleton3D::get_bone_rest, { "bone_idx" }).doc("A bone at rest, relative to its parent.");
	r_class.method("get_bone_global_pose", &Skeleton3D::get_bone_global_pose, { "bone_idx" }).doc("A bone's place relative to the skeleton.");
}

void BoneAttachment3D::bind(ClassBuilder<BoneAttachment3D> &r_class) {
	r_class.doc("Goes where a bone is.");
	r_class.property("bone_name", &BoneAttachment3D::set_bone_name, &BoneAttachment3D::get_bone_name).doc("The bone's name.");
	r_class.property("bone_idx", &BoneAttachment3D::set_bone_idx, &BoneAttachment3D::get_bone_idx).doc("The bone's index; the name counts where both are set.");
	r_class.property("override_pose", &BoneAttachment3D::set_override_pose, &BoneAttachment3D::get_override_pose).doc("Whether the bone follows the node in place of the node the bone; the node then stays where it is put.");
	r_class.property("use_external_skeleton", &BoneAttachment3D::set_use_external_skeleton, &BoneAttachment3D::get_use_external_skeleton).doc("Whether the bone is one of external_skeleton, not of the parent.");
	r_class.property("external_skeleton", &BoneAttachment3D::set_external_skeleton, &BoneAttachment3D::get_external_skeleton).doc("The skeleton's path.");
}

} // namespace lucent::scene
