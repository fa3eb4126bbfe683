// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_scene.h"
#include "modules/scene/camera_3d.h"
#include "modules/scene/light_3d.h"
#include "modules/scene/register_scene_types.h"
#include "modules/scene/resource_loader.h"
#include "modules/scene/scene_context.h"
#include "tests/test_support.h"
#include "tests/unit/gltf_builder.h"

#include <doctest/doctest.h>

using namespace lucent;
using lucent::test::GltfBuilder;

namespace {

std::unique_ptr<scene::Node> make_scene(const std::string &p_json) {
	scene::register_scene_classes();
	GltfBuilder builder;
	builder.add(std::vector<float>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, "VEC3", 5126, 3);
	return gltf_to_scene(builder.parse(p_json).take(), "file").value()->instantiate().take();
}

} // namespace

TEST_CASE("glTF scene: nodes have the file's names, places and kinds") {
	const std::unique_ptr<scene::Node> root = make_scene(R"("scenes":[{"nodes":[0,4]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
		"cameras":[{"type":"perspective","perspective":{"yfov":1.0,"znear":0.1}}],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","color":[4,2,0],"intensity":3.14159265}]}},
		"nodes":[{"name":"Group","children":[1,2],"translation":[1,2,3]},{"name":"Box.001","mesh":0},{"name":"Eye","camera":0,"children":[3]},
		{"name":"Box.001","mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}}},{"mesh":0}],)");
	CHECK(root->get_name() == "file");
	const scene::Node3D *group = dynamic_cast<scene::Node3D *>(root->get_node_or_null(NodePath("Group")));
	REQUIRE(group);
	CHECK(group->get_position() == Vector3(1, 2, 3));
	scene::MeshInstance3D *box = dynamic_cast<scene::MeshInstance3D *>(root->get_node_or_null(NodePath("Group/Box_001")));
	REQUIRE(box);
	CHECK(box->get_owner() == root.get());
	const scene::Camera3D *eye = dynamic_cast<scene::Camera3D *>(root->get_node_or_null(NodePath("Group/Eye")));
	REQUIRE(eye);
	CHECK(eye->parameters.fov_degrees == doctest::Approx(57.29578f));
	const scene::MeshInstance3D *second = dynamic_cast<scene::MeshInstance3D *>(root->get_node_or_null(NodePath("Group/Eye/Box_0012")));
	REQUIRE(second);
	CHECK(second->get_mesh() == box->get_mesh());
	CHECK(box->get_surface_override_material_count() == 1);
	CHECK(box->get_mesh()->surface_get_material(0) == nullptr);
	const scene::OmniLight3D *light = dynamic_cast<scene::OmniLight3D *>(second->get_child(0));
	REQUIRE(light);
	CHECK(light->get_parameters().energy == doctest::Approx(4.0f));
	CHECK(light->get_color().r == doctest::Approx(1.0f));
	CHECK(srgb_to_linear(light->get_color().g) == doctest::Approx(0.5f));
	CHECK(root->get_node_or_null(NodePath("Mesh")));
}

TEST_CASE("glTF scene: materials reach the server with the file's linear values") {
	const std::unique_ptr<scene::Node> root = make_scene(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"nodes":[{"mesh":0}],
		"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mNoaPgPAAODAgA+WCglAAAAAElFTkSuQmCC"}],"textures":[{"source":0}],
		"materials":[{"doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[0.2,0.4,0.6,0.8],"metallicRoughnessTexture":{"index":0,"texCoord":1}},
		"emissiveFactor":[1,0.5,0.25],"emissiveTexture":{"index":0},"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":10},"KHR_materials_specular":{"specularFactor":0,"specularColorFactor":[1,0.5,0]}}}],)");
	const scene::MeshInstance3D *mesh = dynamic_cast<scene::MeshInstance3D *>(root->get_child(0));
	REQUIRE(mesh);
	const Ref<scene::BaseMaterial3D> material = std::dynamic_pointer_cast<scene::BaseMaterial3D>(mesh->get_mesh()->surface_get_material(0));
	REQUIRE(material);
	RenderingServer server(nullptr);
	scene::SceneContext context(server);
	const lucent::Material resolved = material->resolve(context);
	CHECK(resolved.albedo.x == doctest::Approx(0.2f));
	CHECK(resolved.albedo.z == doctest::Approx(0.6f));
	CHECK(resolved.albedo.w == 0.8f);
	CHECK(resolved.metallic == 1.0f);
	CHECK(resolved.specular == 0.0f);
	CHECK(resolved.specular_tint == Vector3(1.0f, 0.5f, 0.0f));
	CHECK(resolved.emission.x == doctest::Approx(10.0f));
	CHECK(resolved.emission.z == doctest::Approx(2.5f));
	CHECK(resolved.emission_on_texture_multiplies);
	CHECK(resolved.cull == MaterialCull::DISABLED);
	CHECK(resolved.transparency == TransparencyMode::OPAQUE);
	const TextureRef &roughness = resolved.textures[size_t(TextureSlot::ROUGHNESS)];
	const TextureRef &metallic = resolved.textures[size_t(TextureSlot::METALLIC)];
	CHECK(roughness.texture.is_valid());
	CHECK(roughness.texture == metallic.texture);
	CHECK(roughness.channel == TextureChannel::GREEN);
	CHECK(metallic.channel == TextureChannel::BLUE);
	CHECK(metallic.uv_set == 1);
	// One image as data and as colour: two server textures.
	CHECK(!(resolved.textures[size_t(TextureSlot::EMISSION)].texture == metallic.texture));
}

TEST_CASE("glTF scene: copies share resources; another scene can be chosen") {
	scene::register_scene_classes();
	const std::string json = R"({"asset":{"version":"2.0"},"scene":1,"scenes":[{"nodes":[0]},{"name":"second","nodes":[1]}],"nodes":[{"name":"a"},{"name":"b"}]})";
	const auto load = [&](int32_t p_scene) { return gltf_to_scene(lucent::test::parse_text(json).take(), "file", p_scene); };
	CHECK(load(-1).value()->instantiate().value()->get_child(0)->get_name() == "b");
	CHECK(load(-1).value()->instantiate().value()->get_name() == "second");
	CHECK(load(0).value()->instantiate().value()->get_child(0)->get_name() == "a");
	CHECK(!load(2).ok());
	CHECK(!load_gltf_scene("/nonexistent/a.gltf").ok());
}

TEST_CASE("glTF scene: ResourceLoader reads .gltf and .glb") {
	scene::register_scene_classes();
	register_gltf_loaders();
	const std::string path = lucent::test::options().root + "doc/samples/cornell/cornell.glb";
	const Result<Ref<Resource>> resource = scene::ResourceLoader::load(path);
	REQUIRE(resource.ok());
	const Ref<scene::PackedScene> packed = std::dynamic_pointer_cast<scene::PackedScene>(resource.value());
	REQUIRE(packed);
	CHECK(packed->instantiate().value()->get_child_count() > 0);
}
