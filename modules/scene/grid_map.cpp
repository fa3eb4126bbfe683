// SPDX-License-Identifier: MIT
#include "modules/scene/grid_map.h"

#include "servers/core/class_builder.h"

#include <charconv>

namespace lucent::scene {

namespace {

// The 24 ways to turn a cube, in the order that Godot numbers them: for each row of the matrix the column of its one entry (1 to 3)
// and its sign.
constexpr int8_t TURNS[24][3] = { { 1, 2, 3 }, { -2, 1, 3 }, { -1, -2, 3 }, { 2, -1, 3 }, { 1, -3, 2 }, { 3, 1, 2 }, { -1, 3, 2 }, { -3, -1, 2 },
	{ 1, -2, -3 }, { 2, 1, -3 }, { -1, 2, -3 }, { -2, -1, -3 }, { 1, 3, -2 }, { -3, 1, -2 }, { -1, -3, -2 }, { 3, -1, -2 },
	{ 3, 2, -1 }, { -2, 3, -1 }, { -3, -2, -1 }, { 2, -3, -1 }, { 3, -2, 1 }, { 2, 3, 1 }, { -3, 2, 1 }, { -2, -3, 1 } };

Basis turn(uint32_t p_index) {
	Basis basis(0.0f);
	for (int row = 0; row < 3; row++) {
		const int entry = TURNS[p_index < 24 ? p_index : 0][row];
		basis[std::abs(entry) - 1][row] = entry < 0 ? -1.0f : 1.0f;
	}
	return basis;
}

// "item/12/mesh": 12 and "mesh".
bool split_item_property(const std::string &p_name, int &r_item, std::string &r_field) {
	if (!p_name.starts_with("item/")) {
		return false;
	}
	const char *end = p_name.data() + p_name.size();
	const auto [rest, status] = std::from_chars(p_name.data() + 5, end, r_item);
	if (status != std::errc() || rest == end || *rest != '/' || r_item < 0) {
		return false;
	}
	r_field.assign(rest + 1, end);
	return true;
}

} // namespace

const MeshLibrary::Item *MeshLibrary::find_item(int p_item) const {
	const auto found = items.find(p_item);
	return found == items.end() ? nullptr : &found->second;
}

bool MeshLibrary::_set(const std::string &p_name, const Variant &p_value) {
	int index = 0;
	std::string field;
	if (!split_item_property(p_name, index, field)) {
		return false;
	}
	Item &item = items[index];
	if (field == "name") {
		item.name = variant_or<std::string>(p_value, "");
	} else if (field == "mesh") {
		item.mesh = variant_or<Ref<Mesh>>(p_value, nullptr);
	} else if (field == "mesh_transform") {
		item.mesh_transform = variant_or<Transform3D>(p_value, Transform3D());
	} else if (field == "mesh_cast_shadow") {
		item.cast_shadow = ShadowCasting(glm::clamp(variant_or<int>(p_value, 1), 0, 3));
	}
	emit_changed();
	return true;
}

bool MeshLibrary::_get(const std::string &p_name, Variant &r_value) const {
	int index = 0;
	std::string field;
	if (!split_item_property(p_name, index, field)) {
		return false;
	}
	static const Item EMPTY;
	const Item &item = find_item(index) ? *find_item(index) : EMPTY; // any may be set
	if (field == "name") {
		r_value = item.name;
	} else if (field == "mesh") {
		r_value = item.mesh;
	} else if (field == "mesh_transform") {
		r_value = item.mesh_transform;
	} else if (field == "mesh_cast_shadow") {
		r_value = int64_t(item.cast_shadow);
	} else {
		r_value = Variant();
	}
	return true;
}

void MeshLibrary::_get_property_list(std::vector<PropertyInfo> &r_list) const {
	static constexpr std::pair<const char *, Variant::Type> FIELDS[] = { { "name", Variant::Type::STRING }, { "mesh", Variant::Type::OBJECT },
		{ "mesh_transform", Variant::Type::TRANSFORM3D }, { "mesh_cast_shadow", Variant::Type::INT } };
	for (const auto &[index, item] : items) {
		for (const auto &[name, type] : FIELDS) {
			PropertyInfo property;
			property.name = fmt::format("item/{}/{}", index, name);
			property.type = type;
			property.class_name = type == Variant::Type::OBJECT ? "Mesh" : "";
			property.hint = type == Variant::Type::OBJECT ? PropertyHint::RESOURCE_TYPE : PropertyHint::NONE;
			r_list.push_back(std::move(property));
		}
	}
}

std::vector<PlacedMesh> GridMap::get_placed() const {
	const Vector3 half = 0.5f * state.cell_size * Vector3(state.cell_center_x, state.cell_center_y, state.cell_center_z);
	std::vector<PlacedMesh> placed;
	for (size_t i = 0; state.mesh_library && i + 2 < cells.size(); i += 3) {
		// x and y in the first, z in the second; item in 16 bits of the third, turn in 5.
		const uint32_t xy = uint32_t(cells[i]), cell = uint32_t(cells[i + 2]);
		const Vector3 index(int16_t(xy & 0xFFFF), int16_t(xy >> 16), int16_t(uint32_t(cells[i + 1]) & 0xFFFF));
		const MeshLibrary::Item *item = state.mesh_library->find_item(int(cell & 0xFFFF));
		if (item && item->mesh) {
			const Transform3D place = { turn(cell >> 16 & 31) * state.cell_scale, index * state.cell_size + half };
			placed.push_back({ place * item->mesh_transform, item->mesh, item->cast_shadow });
		}
	}
	return placed;
}

GridMap::~GridMap() {
	state.mesh_library = nullptr;
	state_changed();
}

void GridMap::state_changed() {
	if (connected != state.mesh_library) {
		if (connected) {
			connected->disconnect(connection);
		}
		connected = state.mesh_library;
		if (connected) {
			connection = connected->connect(
					"changed", [this](const Array &) { rebuild(); }, this);
		}
	}
	rebuild();
}

bool GridMap::_set(const std::string &p_name, const Variant &p_value) {
	const std::optional<Dictionary> data = p_name == "data" ? variant_cast<Dictionary>(p_value) : std::nullopt;
	if (!data) {
		return false;
	}
	const Variant *list = data->find("cells");
	cells = list ? variant_or<std::vector<int32_t>>(*list, {}) : std::vector<int32_t>();
	rebuild();
	return true;
}

bool GridMap::_get(const std::string &p_name, Variant &r_value) const {
	if (p_name != "data") {
		return false;
	}
	Dictionary data;
	data.entries.emplace_back(Variant("cells"), Variant(cells));
	r_value = data;
	return true;
}

void GridMap::_get_property_list(std::vector<PropertyInfo> &r_list) const {
	PropertyInfo property;
	property.name = "data";
	property.type = Variant::Type::DICTIONARY;
	r_list.push_back(std::move(property));
}

void GridMap::rebuild() {
	if (is_inside_tree()) {
		group.enter(*this, get_placed(), {});
	}
}

void GridMap::_notification(int p_what) {
	Node3D::_notification(p_what);
	switch (p_what) {
		case NOTIFICATION_ENTER_WORLD:
			rebuild();
			break;
		case NOTIFICATION_EXIT_WORLD:
			group.leave();
			break;
		case NOTIFICATION_TRANSFORM_CHANGED:
			group.set_transform(get_global_transform());
			break;
		case NOTIFICATION_VISIBILITY_CHANGED:
			group.set_visible(is_visible_in_tree());
			break;
	}
}

void MeshLibrary::bind(ClassBuilder<MeshLibrary> &r_class) {
	r_class.doc("Meshes by number, for the cells of a GridMap.");
}

void GridMap::bind(ClassBuilder<GridMap> &r_class) {
	constexpr auto S = &GridMap::state;
	r_class.doc("Shows meshes of a library in the cells of a grid.");
	r_class.field("mesh_library", S, &State::mesh_library).doc("The meshes.");
	r_class.field("cell_size", S, &State::cell_size).doc("The cells' edges, in metres.");
	r_class.field("cell_center_x", S, &State::cell_center_x).doc("Whether meshes stand in the middle of their cells along x.");
	r_class.field("cell_center_y", S, &State::cell_center_y).doc("Whether meshes stand in the middle of their cells along y.");
	r_class.field("cell_center_z", S, &State::cell_center_z).doc("Whether meshes stand in the middle of their cells along z.");
	r_class.field("cell_scale", S, &State::cell_scale).doc("Scale of every mesh.");
}

} // namespace lucent::scene
