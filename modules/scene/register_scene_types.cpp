// SPDX-License-Identifier: MIT
#include "modules/scene/register_scene_types.h"

#include "modules/scene/camera_3d.h"
#include "modules/scene/grid_map.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/multi_mesh.h"
#include "modules/scene/packed_scene.h"
#include "modules/scene/primitive_meshes.h"
#include "modules/scene/resource_loader.h"
#include "modules/scene/scene_tree.h"
#include "modules/scene/skeleton_3d.h"
#include "modules/scene/viewport.h"
#include "modules/scene/world_environment.h"
#include "servers/core/class_builder.h"

namespace lucent::scene {

static void register_resources() {
	ClassDB::register_abstract_class<Texture2D>();
	ClassDB::register_class<ImageTexture>();
	ClassDB::register_abstract_class<Material>();
	ClassDB::register_abstract_class<BaseMaterial3D>();
	ClassDB::register_class<StandardMaterial3D>();
	ClassDB::register_class<ORMMaterial3D>();
	ClassDB::register_abstract_class<Mesh>();
	ClassDB::register_class<ArrayMesh>();
	ClassDB::register_abstract_class<PrimitiveMesh>();
	ClassDB::register_class<BoxMesh>();
	ClassDB::register_class<SphereMesh>();
	ClassDB::register_class<PlaneMesh>();
	ClassDB::register_class<QuadMesh>();
	ClassDB::register_class<CylinderMesh>();
	ClassDB::register_class<CapsuleMesh>();
	ClassDB::register_class<PrismMesh>();
	ClassDB::register_class<TorusMesh>();
	ClassDB::register_class<ProceduralSkyMaterial>();
	ClassDB::register_class<PanoramaSkyMaterial>();
	ClassDB::register_class<PhysicalSkyMaterial>();
	ClassDB::register_class<Sky>();
	ClassDB::register_class<Environment>();
	ClassDB::register_class<MultiMesh>();
	ClassDB::register_class<MeshLibrary>();
	ClassDB::register_class<PackedScene>();
	ClassDB::register_class<World3D>();
}

static void register_nodes() {
	ClassDB::register_class<Node>();
	ClassDB::register_class<Node3D>();
	ClassDB::register_abstract_class<Viewport>();
	ClassDB::register_class<SubViewport>();
	ClassDB::register_class<Window>();
	ClassDB::register_class<Skeleton3D>();
	ClassDB::register_class<BoneAttachment3D>();
	ClassDB::register_abstract_class<VisualInstance3D>();
	ClassDB::register_abstract_class<GeometryInstance3D>();
	ClassDB::register_class<MeshInstance3D>();
	ClassDB::register_class<MultiMeshInstance3D>();
	ClassDB::register_class<GridMap>();
	ClassDB::register_class<Camera3D>();
	ClassDB::register_abstract_class<Light3D>();
	ClassDB::register_class<DirectionalLight3D>();
	ClassDB::register_class<OmniLight3D>();
	ClassDB::register_class<SpotLight3D>();
	ClassDB::register_class<WorldEnvironment>();
	ClassDB::register_class<SceneTree>();
	ClassDB::register_abstract_class<ResourceLoader>();
}

void register_scene_classes() {
	register_core_classes();
	register_resources();
	register_nodes();
}

} // namespace lucent::scene
