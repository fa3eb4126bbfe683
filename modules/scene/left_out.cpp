// SPDX-License-Identifier: MIT
#include "modules/scene/left_out.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace lucent::scene {

namespace {

using enum LeftOutEffect;

// clang-format off
constexpr LeftOutKind KINDS[] = {
	{ "CSG*3D", GEOMETRY, true, "constructive geometry (CSG)" },
	{ "Label3D TextMesh", GEOMETRY, true, "text" },
	{ "Sprite3D AnimatedSprite3D", GEOMETRY, true, "sprites" },
	{ "GPUParticles3D CPUParticles3D", GEOMETRY, true, "particles" },
	{ "SoftBody3D", GEOMETRY, true, "soft bodies" },
	{ "ImmediateMesh PointMesh RibbonTrailMesh TubeTrailMesh PlaceholderMesh", GEOMETRY, false, "meshes of points, lines and trails" },
	{ "ShaderMaterial Shader ShaderInclude VisualShader*", LOOK, false, "shaders of one's own" },
	{ "FogMaterial FogVolume", LOOK, true, "fog" },
	{ "Decal", LOOK, true, "decals" },
	{ "AreaLight3D", LOOK, true, "area lights" },
	{ "ReflectionProbe", LOOK, true, "reflection probes" },
	{ "AnimatedTexture Gradient GradientTexture1D GradientTexture2D Image PlaceholderTexture2D AtlasTexture CameraTexture CanvasTexture CurveTexture CurveXYZTexture DPITexture DrawableTexture2D ExternalTexture MeshTexture NoiseTexture2D NoiseTexture3D PortableCompressedTexture2D ViewportTexture Texture2DArray Texture3D CompressedTexture2D CompressedTexture3D ImageTexture3D Cubemap", LOOK, false, "textures other than images in files" },
	{ "CameraAttributes*", LOOK, false, "depth of field and exposure of cameras" },
	{ "VoxelGI LightmapGI LightmapProbe VoxelGIData LightmapGIData", NONE, true, "baked light (SDFGI takes its place)" },
	{ "AnimationPlayer AnimationTree AnimationMixer AnimationLibrary Animation AnimationNode* AnimationRootNode Tween RootMotionView SkeletonIK3D SkeletonModifier3D SkeletonModification* SkeletonModificationStack2D LookAtModifier3D SpringBone* PhysicalBone* PhysicalBoneSimulator3D RetargetModifier3D AimModifier3D ModifierBoneTarget3D ConvertTransformModifier3D CopyTransformModifier3D *IK3D SkeletonProfile* BoneMap Skin", NONE, true, "animation" },
	{ "StaticBody3D RigidBody3D CharacterBody3D AnimatableBody3D Area3D CollisionShape3D CollisionPolygon3D CollisionObject3D PhysicsBody3D VehicleBody3D VehicleWheel3D RayCast3D ShapeCast3D SpringArm3D *Joint3D *Shape3D PhysicsMaterial PhysicsMaterial3D GridMapEditorPlugin *Joint", NONE, true, "physics" },
	{ "NavigationRegion3D NavigationLink3D NavigationObstacle3D NavigationMesh NavigationMeshSourceGeometryData3D", NONE, true, "navigation" },
	{ "NavigationAgent3D NavigationAgent2D NavigationPolygon", NONE, false, "navigation" },
	{ "OccluderInstance3D VisibleOnScreenNotifier3D VisibleOnScreenEnabler3D *Occluder3D GPUParticlesCollision* GPUParticlesAttractor*", NONE, true, "occluders and screen notifiers" },
	{ "AudioStreamPlayer3D AudioListener3D", NONE, true, "sound" },
	{ "Audio*", NONE, false, "sound" },
	{ "Marker3D Path3D PathFollow3D RemoteTransform3D XROrigin3D XRNode3D XRController3D XRAnchor3D *XR*", NONE, true, "markers, paths and XR" },
	{ "*2D ParallaxLayer ParallaxBackground TileMap TileMapLayer TileSet* CanvasLayer CanvasGroup CanvasModulate BackBufferCopy Bone2D CanvasItemMaterial ParticleProcessMaterial SpriteFrames", NONE, false, "2D" },
	{ "Control Container *Container *Button BaseButton CheckBox Label RichTextLabel LinkButton Panel ColorRect TextureRect NinePatchRect ReferenceRect LineEdit TextEdit CodeEdit SpinBox Range *Slider Slider *ScrollBar ScrollBar ProgressBar TextureProgressBar ItemList Tree TabBar Tabs MenuBar GraphEdit GraphElement GraphNode GraphFrame VideoStreamPlayer VideoStream* *Separator Separator ColorPicker StyleBox* Theme *Font Font* LabelSettings ButtonGroup *Highlighter TextureButton Popup* *Dialog VirtualJoystick", NONE, false, "user interfaces" },
	{ "Timer HTTPRequest Multiplayer* ResourcePreloader ShaderGlobalsOverride CanvasItem InstancePlaceholder MissingNode StatusIndicator InputEvent* Shortcut Curve Curve3D Compositor CompositorEffect SceneReplicationConfig PackedDataContainer Script GDScript CSharpScript JSON Translation RDShaderFile EditorSettings FastNoiseLite Noise ColorPalette", NONE, false, "timers, networks" },
};
// clang-format on

bool matches(std::string_view p_pattern, std::string_view p_name) {
	const size_t star = p_pattern.find('*');
	if (star == std::string_view::npos) {
		return p_pattern == p_name;
	}
	const size_t last = p_pattern.rfind('*');
	if (last != star) { // *middle*
		return p_name.find(p_pattern.substr(star + 1, last - star - 1)) != std::string_view::npos;
	}
	const std::string_view head = p_pattern.substr(0, star), tail = p_pattern.substr(star + 1);
	return p_name.size() >= head.size() + tail.size() && p_name.starts_with(head) && p_name.ends_with(tail);
}

bool any_matches(std::string_view p_patterns, std::string_view p_name) {
	while (!p_patterns.empty()) {
		const std::string_view pattern = p_patterns.substr(0, p_patterns.find(' '));
		if (matches(pattern, p_name)) {
			return true;
		}
		p_patterns.remove_prefix(std::min(pattern.size() + 1, p_patterns.size()));
	}
	return false;
}

} // namespace

std::span<const LeftOutKind> left_out_kinds() {
	return KINDS;
}

const LeftOutKind *find_left_out(std::string_view p_class) {
	if (p_class == "Texture2D") { // a type in files, not a class of nodes in the plane
		return nullptr;
	}
	const auto found = std::find_if(std::begin(KINDS), std::end(KINDS), [&](const LeftOutKind &p_kind) { return any_matches(p_kind.classes, p_class); });
	return found == std::end(KINDS) ? nullptr : found;
}

bool is_property_without_effect(std::string_view p_class, std::string_view p_property) {
	// What scripts, the editor, importers, physics and the drawing's own scheduling keep in files.
	static constexpr const char *ANYWHERE = "metadata/* editor_description resource_* process_* physics_* auto_translate* shadow_mesh blend_shape_mode lightmap_size_hint "
											"gi_lightmap* lod_bias extra_cull_margin custom_aabb ignore_occlusion_culling doppler_tracking add_uv2 uv2_padding rotation_edit_mode "
											"visibility_parent sorting_* _import_path _bundled editable_instance multiplayer_authority bone_map motion_scale animate_physical_bones "
											"modifier_callback_mode* show_rest_only directional_shadow_pancake_size directional_shadow_split_* directional_shadow_blend_splits directional_shadow_mode "
											"directional_shadow_fade_start omni_shadow_mode light_volumetric_fog_energy shadow_caster_mask shadow_blur shadow_transmittance_bias shadow_reverse_cull_face "
											"radiance_size process_mode use_debanding compositor background_canvas_max_layer background_camera_feed_id";
	if (any_matches(ANYWHERE, p_property)) {
		return true;
	}
	if (p_class == "GridMap" && any_matches("cell_octant_size bake_navigation collision_* baked_meshes", p_property)) {
		return true;
	}
	if (p_class == "MeshInstance3D" && p_property == "skeleton") { // without a skin, which is said, it moves nothing
		return true;
	}
	return p_class == "SubViewport" || p_class == "Window" || p_class == "World3D"; // their pictures aren't drawn
}

} // namespace lucent::scene
