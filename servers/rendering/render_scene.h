// SPDX-License-Identifier: MIT
#pragma once
// The scene as plain data. RenderingServer edits it, frame_renderer draws it, RenderingServer::scenario_snapshot() shows it to
// path tracers and scripts. Right-handed, y up, cameras look along -z, metres. Colours here are linear, radiometry is Godot's:
// a light of energy 1 and colour 1 reflects albedo * cos (Godot's pi convention) from a Lambertian surface.

#include "servers/core/image.h"
#include "servers/core/math_types.h"
#include "servers/core/rid.h"
#include "servers/rendering/gi/sdfgi/sdfgi_settings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lucent {

using TextureRid = Rid<struct SceneTextureTag>;
using MaterialRid = Rid<struct MaterialTag>;
using MeshRid = Rid<struct MeshTag>;
using LightRid = Rid<struct LightTag>;
using InstanceRid = Rid<struct InstanceTag>;
using SkyRid = Rid<struct SkyTag>;
using EnvironmentRid = Rid<struct EnvironmentTag>;
using CameraRid = Rid<struct CameraTag>;
using ScenarioRid = Rid<struct ScenarioTag>;
using ViewportRid = Rid<struct ViewportTag>;

struct SceneTexture {
	std::shared_ptr<const Image> image; // level 0
	bool srgb = false; // texels of RGBA8 are sRGB-encoded colour
	uint64_t version = 0;
};

enum class TextureSlot : uint8_t {
	ALBEDO,
	NORMAL,
	METALLIC,
	ROUGHNESS,
	OCCLUSION,
	EMISSION,
	COUNT
};
enum class TextureChannel : uint8_t {
	RED,
	GREEN,
	BLUE,
	ALPHA,
	GRAYSCALE
};
enum class TextureWrap : uint8_t {
	REPEAT,
	MIRRORED_REPEAT,
	CLAMP
};
enum class TextureFilter : uint8_t {
	NEAREST,
	LINEAR,
	NEAREST_MIPMAPS,
	LINEAR_MIPMAPS,
	NEAREST_MIPMAPS_ANISOTROPIC,
	LINEAR_MIPMAPS_ANISOTROPIC
};

struct TextureRef {
	TextureRid texture; // invalid: none
	uint8_t uv_set = 0; // 0 or 1
	TextureWrap wrap_u = TextureWrap::REPEAT;
	TextureWrap wrap_v = TextureWrap::REPEAT;
	TextureFilter filter = TextureFilter::LINEAR_MIPMAPS;
	// KHR_texture_transform / uv1_offset, uv1_scale: uv' = rotate(uv * scale) + offset
	Vector2 uv_offset{ 0.0f };
	Vector2 uv_scale{ 1.0f };
	float uv_rotation = 0.0f; // radians, counter-clockwise in glTF's sense
	TextureChannel channel = TextureChannel::RED; // single-channel slots
};

enum class TransparencyMode : uint8_t {
	OPAQUE,
	ALPHA_BLEND,
	ALPHA_SCISSOR
};
enum class MaterialBlend : uint8_t {
	MIX,
	ADD,
	SUB,
	MUL,
	PREMULTIPLIED
};
enum class MaterialCull : uint8_t {
	BACK,
	FRONT,
	DISABLED
};

// StandardMaterial3D, resolved. The BRDF is glTF's: Lambert (1 - metallic) + GGX/Smith with Schlick's Fresnel.
struct Material {
	Vector4 albedo{ 1.0f, 1.0f, 1.0f, 1.0f }; // linear, alpha
	float metallic = 0.0f;
	float roughness = 1.0f;
	float specular = 0.5f; // Godot's: f0 = 0.16 * specular^2 for dielectrics; 0 is Lambertian
	Vector3 specular_tint{ 1.0f };
	Vector3 emission{ 0.0f }; // linear radiance, energy multiplied in
	bool emission_on_texture_multiplies = true; // true: emission * texture (glTF); false: emission + texture * energy (Godot's ADD)
	float emission_energy = 1.0f; // for the ADD operator's texture
	float normal_scale = 1.0f;
	float occlusion_strength = 1.0f; // ao_light_affect does not exist here: occlusion dims indirect light only
	TransparencyMode transparency = TransparencyMode::OPAQUE;
	float alpha_scissor_threshold = 0.5f;
	MaterialBlend blend = MaterialBlend::MIX;
	MaterialCull cull = MaterialCull::BACK;
	bool unshaded = false;
	bool vertex_color_use_as_albedo = false;
	TextureRef textures[size_t(TextureSlot::COUNT)];
	int32_t render_priority = 0;
	uint64_t version = 0;
};

// Triangles. All arrays but positions may be empty; those that are not have positions' size.
struct MeshSurface {
	std::vector<Vector3> positions;
	std::vector<Vector3> normals;
	std::vector<Vector4> tangents; // w: handedness of the bitangent, +1 or -1
	std::vector<Vector2> uvs;
	std::vector<Vector2> uv2s;
	std::vector<Vector4> colors; // linear
	std::vector<uint32_t> indices; // 3 a triangle, counter-clockwise is the front; never empty
	MaterialRid material;
};

struct Mesh {
	std::vector<std::shared_ptr<const MeshSurface>> surfaces;
	AABB aabb; // local
	uint64_t version = 0;
};

enum class LightType : uint8_t {
	DIRECTIONAL,
	OMNI,
	SPOT
};
enum class LightBakeMode : uint8_t {
	DISABLED,
	STATIC,
	DYNAMIC
};
enum class SkyMode : uint8_t {
	LIGHT_AND_SKY,
	LIGHT_ONLY,
	SKY_ONLY
}; // directional lights

// Shines along the instance's -z. How it fades: shaders/light_falloff_inc.glsl. What shadow_enabled and negative mean to direct and
// indirect light: doc/conventions.md.
struct Light {
	LightType type = LightType::OMNI;
	Vector3 color{ 1.0f }; // linear
	float energy = 1.0f;
	float indirect_energy = 1.0f;
	float specular = 1.0f; // see specular_scale()
	float range_m = 5.0f;
	float attenuation = 1.0f; // decay exponent
	float spot_angle_degrees = 45.0f;
	float spot_attenuation = 1.0f; // Godot's spot_angle_attenuation: the larger, the sharper the cone's middle; see spot_exponent()
	float angular_size_degrees = 0.0f; // directional
	float size_m = 0.0f; // positional
	bool shadow_enabled = false;
	float shadow_bias = 0.1f;
	float shadow_normal_bias = 2.0f;
	float shadow_opacity = 1.0f;
	float shadow_max_distance_m = 100.0f; // directional
	bool negative = false;
	LightBakeMode bake_mode = LightBakeMode::DYNAMIC; // DISABLED: not in GI
	SkyMode sky_mode = SkyMode::LIGHT_AND_SKY;
	uint64_t version = 0;

	// What multiplies the specular lobe. Godot doubles it for omni and spot lights, whose default is 0.5.
	float specular_scale() const { return type == LightType::DIRECTIONAL ? specular : 2.0f * specular; }
	// The rim's exponent is Godot's 1 / spot_angle_attenuation; finite for 0.
	float spot_exponent() const { return 1.0f / std::max(spot_attenuation, 1e-3f); }
};

enum class GiMode : uint8_t {
	DISABLED,
	STATIC,
	DYNAMIC
};
enum class ShadowCasting : uint8_t {
	OFF,
	ON,
	DOUBLE_SIDED,
	SHADOWS_ONLY
};

struct Instance {
	MeshRid mesh; // at most one of mesh and light is valid
	LightRid light;
	ScenarioRid scenario;
	Transform3D transform;
	Transform3D previous_transform; // of the last drawn frame
	bool drawn = false; // in any frame; until then previous_transform follows transform
	bool visible = true;
	GiMode gi_mode = GiMode::STATIC;
	ShadowCasting shadow_casting = ShadowCasting::ON;
	float transparency = 0.0f;
	uint32_t layers = 1;
	MaterialRid material_override; // replaces every surface's
	std::vector<MaterialRid> surface_override_materials; // by surface; invalid: the mesh's own
	uint64_t version = 0;
};

enum class SkyKind : uint8_t {
	PROCEDURAL,
	PANORAMA
};

struct Sky {
	SkyKind kind = SkyKind::PROCEDURAL;
	// ProceduralSkyMaterial, Godot's defaults; colours linear.
	Vector3 sky_top_color{ 0.1247f, 0.1690f, 0.2561f }; // 0.385, 0.454, 0.55 in sRGB
	Vector3 sky_horizon_color{ 0.3803f, 0.3933f, 0.4134f }; // 0.6463, 0.6558, 0.6708
	float sky_curve = 0.15f;
	float sky_energy = 1.0f;
	Vector3 ground_bottom_color{ 0.0331f, 0.0271f, 0.0185f }; // 0.2, 0.169, 0.133
	Vector3 ground_horizon_color{ 0.3803f, 0.3933f, 0.4134f };
	float ground_curve = 0.02f;
	float ground_energy = 1.0f;
	float sun_angle_max_degrees = 30.0f;
	float sun_curve = 0.15f;
	float energy_multiplier = 1.0f;
	// PanoramaSkyMaterial
	TextureRid panorama; // equirectangular
	uint64_t version = 0;
};

enum class BackgroundMode : uint8_t {
	CLEAR_COLOR,
	COLOR,
	SKY,
	CANVAS,
	KEEP,
	CAMERA_FEED
};
enum class AmbientSource : uint8_t {
	BACKGROUND,
	DISABLED,
	COLOR,
	SKY
};
enum class ToneMapper : uint8_t {
	LINEAR,
	REINHARD,
	FILMIC,
	ACES,
	AGX
};

struct Environment {
	BackgroundMode background = BackgroundMode::CLEAR_COLOR;
	Vector3 background_color{ 0.0f }; // linear
	float background_energy = 1.0f;
	SkyRid sky;
	float sky_custom_fov_degrees = 0.0f;
	Basis sky_rotation = Basis(1.0f);
	AmbientSource ambient_source = AmbientSource::BACKGROUND;
	Vector3 ambient_color{ 0.0f }; // linear
	float ambient_energy = 1.0f;
	float ambient_sky_contribution = 1.0f;
	ToneMapper tone_mapper = ToneMapper::LINEAR;
	float tonemap_exposure = 1.0f;
	float tonemap_white = 1.0f;
	SdfgiSettings sdfgi;
	uint64_t version = 0;
};

struct Camera {
	enum class Kind : uint8_t {
		PERSPECTIVE,
		ORTHOGONAL,
		FRUSTUM
	};
	Kind kind = Kind::PERSPECTIVE;
	Transform3D transform;
	float fov_degrees = 75.0f; // vertical when keep_height, else horizontal
	float size_m = 1.0f; // orthogonal: height (keep_height) or width
	bool keep_height = true;
	Vector2 frustum_offset{ 0.0f };
	float near_m = 0.05f;
	float far_m = 4000.0f;
	EnvironmentRid environment; // overrides the scenario's
	float exposure_multiplier = 1.0f;
	uint32_t cull_mask = 0xFFFFF;
};

// A world-space box in which something changed.
struct DirtyBox {
	AABB box;
	uint64_t version = 0;
	bool geometry = true; // false: only light
};

struct Scenario {
	EnvironmentRid environment;
	EnvironmentRid fallback_environment;
	std::vector<DirtyBox> dirty; // cleared by the frame that consumed them
	uint64_t geometry_version = 0; // grows with every change of transform, mesh, material or visibility
	uint64_t light_version = 0;
};

// Linear images of one view, on the CPU. What --aov writes. rgb, width * height, rows from the top.
struct ViewportImage {
	uint32_t width = 0;
	uint32_t height = 0;
	uint32_t channels = 3; // 1 or 3
	std::vector<float> values;
};

enum class ViewportBuffer : uint8_t {
	COLOR_LINEAR,
	COLOR_DISPLAY,
	DIRECT,
	INDIRECT_DIFFUSE,
	INDIRECT_SPECULAR,
	EMISSION,
	ALBEDO,
	NORMAL,
	DEPTH,
	MOTION
};

struct Viewport {
	ScenarioRid scenario;
	CameraRid camera;
	uint32_t width = 0;
	uint32_t height = 0;
	std::string debug_view; // empty: the picture. "sdf", "albedo", …: see Sdfgi::debug_views()
	bool picture_enabled = true; // false: frames advance the light only
	bool aov = false; // keep the buffers that viewport_get_image needs besides colour
};

// Loads that a pass of GI made from buffers and textures, as its shader has them: a structure or a bilinear lookup is one.
struct GiFetches {
	std::string pass; // "sdfgi.gather_gi"
	uint64_t fetches = 0;
	uint64_t bytes = 0; // of what was named, whatever the caches answered
};

// What GI did, for --stats and for deciding when a picture is done.
struct GiStats {
	uint64_t frames = 0; // since the last reset
	bool converged = false; // nothing will change until the scene does
	uint64_t rays = 0; // most in a frame since the last reset, or with SdfgiSettings::count_every_frame in the last frame; 0 at rest
	uint64_t surface_cells = 0; // alive, all cascades
	uint64_t surface_records = 0;
	uint64_t listed_triangles = 0; // in the cells' lists, one that several cells hold counts several times
	// The rays of one frame that records gathered light with: met the sky, a record, a record beside the one that was to answer, nothing that
	// answers, the back of a one-sided surface, a cell without memory. The last three are black.
	std::array<uint64_t, 6> gather_rays{};
	// Pixels of a picture without a free point before them, and those that no record lights.
	uint64_t startless_pixels = 0;
	uint64_t recordless_pixels = 0;
	uint64_t probes = 0;
	uint64_t bytes = 0; // GPU memory of GI
	std::vector<GiFetches> fetches; // of the last frame, with SdfgiSettings::count_fetches; passes that build the world are not among them
};

struct RenderScene {
	RidOwner<SceneTexture, SceneTextureTag> textures;
	RidOwner<Material, MaterialTag> materials;
	RidOwner<Mesh, MeshTag> meshes;
	RidOwner<Light, LightTag> lights;
	RidOwner<Instance, InstanceTag> instances;
	RidOwner<Sky, SkyTag> skies;
	RidOwner<Environment, EnvironmentTag> environments;
	RidOwner<Camera, CameraTag> cameras;
	RidOwner<Scenario, ScenarioTag> scenarios;
	RidOwner<Viewport, ViewportTag> viewports;
	uint64_t version = 0; // grows with every edit; the source of all other versions

	// The material that draws surface p_surface of p_instance: override, surface override, the mesh's own, or null (default material).
	const Material *surface_material(const Instance &p_instance, const Mesh &p_mesh, uint32_t p_surface) const;
	// The camera's environment, the scenario's, its fallback, or null.
	const Environment *find_environment(const Scenario &p_scenario, const Camera &p_camera) const;
};

// The matrices of a camera for an aspect ratio (width / height). Reversed z: near is 1, far is 0; y up in clip space is handled here
// (Vulkan's y points down: the projection flips it).
Projection camera_projection(const Camera &p_camera, float p_aspect);

} // namespace lucent
