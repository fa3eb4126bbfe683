// SPDX-License-Identifier: MIT
// Nodes that show many meshes.
#include "modules/scene/grid_map.h"
#include "modules/scene/multi_mesh.h"
#include "modules/scene/primitive_meshes.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/scene_tree.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace lucent;

namespace {

std::vector<Vector3> shown_places(const RenderScene &p_scene) {
	std::vector<Vector3> places;
	p_scene.instances.for_each([&](InstanceRid, const Instance &p_instance) {
		if (p_scene.meshes.get(p_instance.mesh) && p_instance.visible) {
			places.push_back(p_instance.transform.origin);
		}
	});
	std::sort(places.begin(), places.end(), [](const Vector3 &p_a, const Vector3 &p_b) { return p_a.x < p_b.x; });
	return places;
}

} // namespace

TEST_CASE("MultiMeshInstance3D: every instance reaches the server, moves, hides and leaves") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	const RenderScene &snapshot = server.scenario_snapshot();
	scene::SceneTree tree(&server);
	const auto many = std::make_shared<scene::MultiMesh>();
	CHECK(many->set("transform_format", 1));
	CHECK(many->set("use_colors", true));
	CHECK(many->set("instance_count", 2));
	CHECK(many->set("mesh", std::make_shared<scene::BoxMesh>()));
	CHECK(many->set("buffer", std::vector<float>{ 1, 0, 0, -3, 0, 1, 0, 2, 0, 0, 1, 4, 1, 1, 1, 1, 0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 1, 1, 1, 1 }));
	scene::MultiMeshInstance3D *node = tree.get_root()->create_child<scene::MultiMeshInstance3D>("Many");
	node->set("multimesh", many);
	CHECK(shown_places(snapshot) == std::vector<Vector3>{ Vector3(-3, 2, 4), Vector3(5, 6, 7) });
	const std::vector<scene::PlacedMesh> placed = many->get_placed();
	CHECK(placed[1].transform.basis * Vector3(1, 0, 0) == Vector3(0, 1, 0)); // rows of the buffer are rows of the matrix
	node->set_position(Vector3(10, 0, 0));
	tree.flush();
	CHECK(shown_places(snapshot) == std::vector<Vector3>{ Vector3(7, 2, 4), Vector3(15, 6, 7) });
	many->set("visible_instance_count", 1);
	CHECK(shown_places(snapshot).size() == 1);
	node->set_visible(false);
	CHECK(shown_places(snapshot).empty());
	node->set_visible(true);
	CHECK_FALSE(many->set("instance_count", -1));
	tree.get_root()->remove_child(node);
	CHECK(shown_places(snapshot).empty());
}

TEST_CASE("GridMap: cells of a MeshLibrary, turned") {
	scene::register_scene_classes();
	RenderingServer server(nullptr);
	const RenderScene &snapshot = server.scenario_snapshot();
	scene::SceneTree tree(&server);
	const auto library = std::make_shared<scene::MeshLibrary>();
	CHECK(library->set("item/3/name", "wall"));
	CHECK(library->set("item/3/mesh", std::make_shared<scene::BoxMesh>()));
	CHECK(library->set("item/3/mesh_transform", Transform3D{ Basis(1.0f), Vector3(0.25f, 0, 0) }));
	CHECK(library->set("item/3/shapes", Array()));
	scene::GridMap *grid = tree.get_root()->create_child<scene::GridMap>("Grid");
	grid->set("mesh_library", library);
	grid->set("cell_center_y", false);
	Dictionary data;
	// (1, -1, 2) not turned; (-1, 0, 0) by turn 1, a quarter round z; (5, 0, 0) of an item that is not there.
	data.entries.emplace_back(Variant("cells"), Variant(std::vector<int32_t>{ int32_t(0xFFFF0001), 2, 3, 0x0000FFFF, 0, 3 | 1 << 16, 5, 0, 9 }));
	CHECK(grid->set("data", data));
	CHECK(shown_places(snapshot) == std::vector<Vector3>{ Vector3(-1, 0.25f, 1), Vector3(3.25f, -2, 5) });
	grid->set("cell_size", Vector3(4.0f));
	CHECK(shown_places(snapshot).back() == Vector3(6.25f, -4, 10));
	CHECK_FALSE(grid->set("data", 5));
	CHECK(library->set("item/9/mesh", std::make_shared<scene::BoxMesh>()));
	CHECK(shown_places(snapshot).size() == 3);
	const std::unique_ptr<scene::Node> copy = grid->duplicate();
	CHECK(dynamic_cast<scene::GridMap &>(*copy).get_placed().size() == 3);
}
