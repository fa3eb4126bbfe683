// SPDX-License-Identifier: MIT
// Materials, textures and skies as the path tracer reads them.
#include "tests/unit/trace_test_scene.h"

#include "modules/reference/brdf_sampling.h"
#include "modules/reference/texture_sampling.h"

#include <cstring>

using namespace lucent;
using namespace lucent::test;

namespace {

constexpr double PI = 3.14159265358979;

PathTracerSettings settings(uint32_t p_spp) {
	PathTracerSettings result;
	result.width = result.height = 8;
	result.spp = p_spp;
	result.threads = 2;
	return result;
}

void check_mean(const TraceTestScene &p_test, double p_truth, uint32_t p_spp = 256) {
	const Estimate found = estimate(p_test.render(settings(p_spp)));
	CHECK(std::abs(found.mean - p_truth) <= found.margin + 1e-4 * p_truth + 1e-7);
	CHECK(found.margin <= 0.05 * p_truth);
}

std::shared_ptr<const Image> make_image(uint32_t p_width, uint32_t p_height, const std::vector<uint8_t> &p_rgba) {
	auto image = std::make_shared<Image>();
	image->width = p_width;
	image->height = p_height;
	image->texels.resize(p_rgba.size());
	std::memcpy(image->texels.data(), p_rgba.data(), p_rgba.size());
	return image;
}

Transform3D at_height(float p_height) {
	return { Basis(1.0f), Vector3(0, p_height, 0) };
}

Light sun() {
	Light light;
	light.type = LightType::DIRECTIONAL;
	light.shadow_enabled = true;
	return light;
}

const Transform3D DOWNWARDS = { Basis(Vector3(1, 0, 0), Vector3(0, 0, -1), Vector3(0, 1, 0)), Vector3(0.0f) };

} // namespace

TEST_CASE("path tracer surfaces: blended, added, multiplied, scissored and faded panes") {
	TraceTestScene test;
	test.set_sky_color(Vector3(0.25f));
	Material pane;
	pane.albedo = Vector4(1.0f, 1.0f, 1.0f, 0.4f);
	pane.unshaded = true;
	pane.transparency = TransparencyMode::ALPHA_BLEND;
	double expected = 0.4 + 0.6 * 0.25;
	float transparency = 0.0f;
	SUBCASE("mix") {}
	SUBCASE("add") {
		pane.blend = MaterialBlend::ADD;
		expected = 0.4 + 0.25;
	}
	SUBCASE("subtract") {
		pane.blend = MaterialBlend::SUB;
		pane.albedo.w = 0.1f;
		expected = 0.25 - 0.1;
	}
	SUBCASE("premultiplied") {
		pane.blend = MaterialBlend::PREMULTIPLIED;
		expected = 1.0 + 0.6 * 0.25;
	}
	SUBCASE("multiply") {
		pane.blend = MaterialBlend::MUL;
		pane.albedo = Vector4(0.5f, 0.5f, 0.5f, 1.0f);
		expected = 0.5 * 0.25;
	}
	SUBCASE("scissor lets through what is below the threshold") {
		pane.transparency = TransparencyMode::ALPHA_SCISSOR;
		expected = 0.25;
	}
	SUBCASE("scissor keeps what is above") {
		pane.transparency = TransparencyMode::ALPHA_SCISSOR;
		pane.alpha_scissor_threshold = 0.3f;
		expected = 1.0;
	}
	SUBCASE("opaque ignores alpha") {
		pane.transparency = TransparencyMode::OPAQUE;
		expected = 1.0;
	}
	SUBCASE("an instance fades") {
		pane.transparency = TransparencyMode::OPAQUE;
		transparency = 0.75f;
		expected = 0.25 + 0.75 * 0.25;
	}
	const InstanceRid instance = test.add_mesh(TraceTestScene::square(1.0f), pane);
	test.scene.instances.get(instance)->transparency = transparency;
	check_mean(test, expected, 1024);
}

TEST_CASE("path tracer surfaces: what shadows lamps") {
	TraceTestScene test;
	test.add_mesh(TraceTestScene::square(1.0f), TraceTestScene::lambertian(Vector3(0.5f)));
	Light light = sun();
	Material pane;
	pane.albedo = Vector4(0.0f, 0.0f, 0.0f, 1.0f);
	pane.specular = 0.0f;
	double expected = 0;
	ShadowCasting casting = ShadowCasting::ON;
	SUBCASE("opaque") {
		expected = 0;
	}
	SUBCASE("a blended pane passes 1 - alpha") {
		pane.transparency = TransparencyMode::ALPHA_BLEND;
		pane.albedo.w = 0.3f;
		expected = 0.5 * 0.7;
	}
	SUBCASE("off") {
		casting = ShadowCasting::OFF;
		expected = 0.5;
	}
	SUBCASE("shadows only") {
		casting = ShadowCasting::SHADOWS_ONLY;
		expected = 0;
	}
	SUBCASE("a lamp without shadows") {
		light.shadow_enabled = false;
		expected = 0.5;
	}
	SUBCASE("half opaque shadows") {
		light.shadow_opacity = 0.5f;
		expected = 0.25;
	}
	// Above the camera.
	const InstanceRid instance = test.add_mesh(TraceTestScene::square(1.0f), pane, at_height(1.0f));
	test.scene.instances.get(instance)->shadow_casting = casting;
	test.add_light(light, DOWNWARDS);
	CHECK(estimate(test.render(settings(16))).mean == doctest::Approx(expected).epsilon(0.001));
}

TEST_CASE("path tracer surfaces: the camera looks through culled sides, other rays don't") {
	TraceTestScene test;
	test.set_sky_color(Vector3(1.0f));
	test.add_mesh(TraceTestScene::square(100.0f), TraceTestScene::lambertian(Vector3(0.5f)), at_height(-1.0f));
	Material ceiling = TraceTestScene::lambertian(Vector3(0.0f));
	SUBCASE("seen from its culled side") {
		// A lid whose front points down: the camera sees the floor, which is dark under it.
		test.add_mesh(TraceTestScene::square(100.0f), ceiling, TraceTestScene::upside_down(Vector3(0, -0.99f, 0)));
		const PathTracerSettings run = [] {
			PathTracerSettings result = settings(16);
			result.aov = true;
			return result;
		}();
		const PathTracerResult result = test.render(run);
		CHECK(result.depth[0] == doctest::Approx(1.5));
		CHECK(estimate(result).mean < 0.01);
	}
	SUBCASE("seen from its front") {
		test.add_mesh(TraceTestScene::square(100.0f), ceiling, at_height(-0.9f));
		CHECK(estimate(test.render(settings(4))).mean == 0.0);
	}
}

TEST_CASE("path tracer surfaces: textures, channels and vertex colours") {
	TraceTestScene test;
	test.set_sky_color(Vector3(1.0f));
	SceneTexture texture;
	texture.srgb = true;
	// Left half dark, right half bright; the camera sees the middle of the square, u just around 0.5.
	texture.image = make_image(2, 1, { 0, 0, 0, 255, 188, 188, 188, 255 });
	Material material = TraceTestScene::lambertian(Vector3(0.5f));
	TextureRef &ref = material.textures[size_t(TextureSlot::ALBEDO)];
	ref.texture = test.scene.textures.make(texture);
	ref.wrap_u = TextureWrap::CLAMP;
	MeshSurface square = TraceTestScene::square(1.0f);
	const double bright = srgb_to_linear(188.0f / 255.0f);
	double expected = 0.25 * bright; // bilinear: the mean of both texels
	SUBCASE("bilinear") {}
	SUBCASE("offset to the right") {
		ref.uv_offset.x = 0.3f;
		expected = 0.5 * bright;
	}
	SUBCASE("nearest, turned by half a turn around the left end") {
		ref.uv_rotation = float(PI);
		ref.filter = TextureFilter::NEAREST;
		expected = 0.0; // clamped to the left
	}
	SUBCASE("vertex colours multiply") {
		material.vertex_color_use_as_albedo = true;
		square.colors.assign(4, Vector4(0.5f, 1.0f, 1.0f, 1.0f));
		expected *= 0.5;
	}
	test.add_mesh(square, material);
	check_mean(test, expected, 64);
	CHECK(select_channel(Vector4(0.1f, 0.2f, 0.3f, 0.4f), TextureChannel::BLUE) == 0.3f);
	CHECK(select_channel(Vector4(0.1f, 0.2f, 0.3f, 0.4f), TextureChannel::GRAYSCALE) == doctest::Approx(0.2f));
}

TEST_CASE("path tracer surfaces: emission textures multiply or add, and light their surroundings") {
	TraceTestScene test;
	test.add_mesh(TraceTestScene::square(5.0f), TraceTestScene::lambertian(Vector3(0.5f)));
	SceneTexture texture;
	texture.image = make_image(2, 1, { 255, 255, 255, 255, 255, 255, 255, 255 });
	Material light = TraceTestScene::lambertian(Vector3(0.0f));
	light.textures[size_t(TextureSlot::EMISSION)].texture = test.scene.textures.make(texture);
	light.emission = Vector3(2.0f);
	light.emission_energy = 1.5f;
	double radiance = 2.0;
	SUBCASE("multiply") {}
	SUBCASE("add") {
		light.emission_on_texture_multiplies = false;
		radiance = 2.0 + 1.5;
	}
	test.add_mesh(TraceTestScene::square(0.5f), light, TraceTestScene::upside_down(Vector3(0, 1.0f, 0)));
	const double factor = 4.0 / (2.0 * PI) * 2.0 * 0.5 / std::sqrt(1.25) * std::atan(0.5 / std::sqrt(1.25));
	check_mean(test, 0.5 * radiance * factor);
}

TEST_CASE("path tracer surfaces: a normal map tilts the light") {
	TraceTestScene test;
	test.add_light(sun(), DOWNWARDS);
	SceneTexture texture;
	// 60 degrees from the normal, towards the tangent: x = sin, stored as (x + 1) / 2.
	const uint8_t x = uint8_t(std::lround((std::sin(PI / 3) + 1.0) * 127.5));
	texture.image = make_image(1, 1, { x, 128, 192, 255 });
	Material material = TraceTestScene::lambertian(Vector3(0.5f));
	material.textures[size_t(TextureSlot::NORMAL)].texture = test.scene.textures.make(texture);
	PathTracerSettings run = settings(4);
	run.aov = true;
	MeshSurface square = TraceTestScene::square(1.0f);
	SUBCASE("tangents from the texture coordinates") {}
	SUBCASE("the mesh's own") {
		square.normals.assign(4, Vector3(0, 1, 0));
		square.tangents.assign(4, Vector4(1, 0, 0, 1));
	}
	test.add_mesh(square, material);
	const PathTracerResult result = test.render(run);
	CHECK(estimate(result).mean == doctest::Approx(0.25).epsilon(0.02));
	CHECK(result.normal[0] == doctest::Approx(std::sin(PI / 3)).epsilon(0.01));
}

// Single-scattering GGX under a white sky: the reflected share is the integral of BRDF times cosine, taken here on a grid.
TEST_CASE("path tracer surfaces: rough metal reflects the BRDF's integral") {
	for (float roughness : { 0.3f, 0.7f, 1.0f }) {
		TraceTestScene test;
		test.set_sky_color(Vector3(1.0f));
		Material material;
		material.albedo = Vector4(0.8f, 0.8f, 0.8f, 1.0f);
		material.metallic = 1.0f;
		material.roughness = roughness;
		test.add_mesh(TraceTestScene::square(1.0f), material);
		const brdf::BrdfLobes lobes = brdf::brdf_lobes(Vector3(0.8f), 1.0f, roughness, 0.5f, Vector3(1.0f));
		double share = 0;
		constexpr int STEPS = 4000;
		for (int i = 0; i < STEPS; i++) {
			// Seen along the normal, everything depends on the polar angle alone.
			const double theta = 0.5 * PI * (i + 0.5) / STEPS;
			const Vector3 light(float(std::sin(theta)), 0, float(std::cos(theta)));
			share += brdf::brdf_specular(lobes, Vector3(0, 0, 1), Vector3(0, 0, 1), light).x * std::cos(theta) * std::sin(theta) * 2 * PI * 0.5 * PI / STEPS;
		}
		check_mean(test, share);
	}
}

TEST_CASE("path tracer surfaces: specular 0 is Lambertian") {
	const brdf::BrdfLobes lobes = brdf::brdf_lobes(Vector3(0.5f), 0.0f, 0.2f, 0.0f, Vector3(1.0f));
	CHECK(lobes.f90 == 0.0f);
	CHECK(brdf::brdf_specular(lobes, Vector3(0, 0, 1), glm::normalize(Vector3(1, 0, 0.1f)), glm::normalize(Vector3(-1, 0, 0.1f))) == Vector3(0.0f));
	CHECK(brdf::brdf_lobes(Vector3(0.5f), 0.0f, 0.2f, 0.5f, Vector3(1.0f)).f0.x == doctest::Approx(0.04f));
}

TEST_CASE("path tracer surfaces: a panorama lights what it shines on") {
	TraceTestScene test;
	test.add_mesh(TraceTestScene::square(1.0f), TraceTestScene::lambertian(Vector3(0.5f)));
	constexpr uint32_t WIDTH = 64, HEIGHT = 32;
	auto image = std::make_shared<Image>();
	image->format = ImageFormat::RGBA32F;
	image->width = WIDTH;
	image->height = HEIGHT;
	image->texels.resize(WIDTH * HEIGHT * 16);
	double irradiance = 0;
	for (uint32_t y = 0; y < HEIGHT; y++) {
		for (uint32_t x = 0; x < WIDTH; x++) {
			// A bright patch at 34 degrees from the zenith, towards +x: a quarter of the way around from -z.
			const bool patch = x >= 15 && x <= 16 && y >= 5 && y <= 6;
			const Vector4 value(Vector3(patch ? 100.0f : 0.1f), 1.0f);
			std::memcpy(image->texels.data() + (y * WIDTH + x) * 16, &value, 16);
			const double t0 = PI * y / HEIGHT, t1 = PI * (y + 1) / HEIGHT;
			if (y < HEIGHT / 2) {
				irradiance += value.x * 2 * PI / WIDTH * 0.5 * (std::sin(t1) * std::sin(t1) - std::sin(t0) * std::sin(t0));
			}
		}
	}
	SceneTexture texture;
	texture.image = image;
	Sky sky;
	sky.kind = SkyKind::PANORAMA;
	sky.panorama = test.scene.textures.make(texture);
	Environment &environment = *test.scene.environments.get(test.environment);
	environment.background = BackgroundMode::SKY;
	environment.sky = test.scene.skies.make(sky);
	SUBCASE("irradiance") {
		// Bilinear reading widens the patch but keeps nearly all of its light: within 1 %.
		const Estimate found = estimate(test.render(settings(1024)));
		CHECK(found.mean == doctest::Approx(0.5 / PI * irradiance).epsilon(0.01));
		CHECK(found.margin < 0.02 * found.mean);
	}
	SUBCASE("direction: a fence on the side of the patch keeps it out") {
		Material fence = TraceTestScene::lambertian(Vector3(0.0f));
		// A wall at x = +0.1, across; and the same at -0.1, which hides only the dim side.
		const Basis upright(Vector3(0, 1, 0), Vector3(-1, 0, 0), Vector3(0, 0, 1));
		const InstanceRid wall = test.add_mesh(TraceTestScene::square(3.0f), fence, { upright, Vector3(0.1f, 0, 0) });
		CHECK(estimate(test.render(settings(64))).mean < 0.06);
		test.scene.instances.get(wall)->transform.origin.x = -0.1f;
		CHECK(estimate(test.render(settings(64))).mean > 0.5 / PI * irradiance * 0.8);
	}
}

TEST_CASE("path tracer surfaces: procedural sky and bake modes") {
	TraceTestScene test;
	Sky sky;
	sky.sky_top_color = Vector3(0.1f);
	sky.sky_horizon_color = Vector3(0.9f);
	sky.ground_bottom_color = sky.ground_horizon_color = Vector3(0.3f);
	Environment &environment = *test.scene.environments.get(test.environment);
	environment.background = BackgroundMode::SKY;
	environment.sky = test.scene.skies.make(sky);
	// Straight down: the ground's colour.
	CHECK(estimate(test.render(settings(1))).mean == doctest::Approx(0.3));
	test.scene.cameras.get(test.camera)->transform.basis = Basis(Vector3(1, 0, 0), Vector3(0, 0, 1), Vector3(0, -1, 0));
	CHECK(estimate(test.render(settings(1))).mean == doctest::Approx(0.1));
}
