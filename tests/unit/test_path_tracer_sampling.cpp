// SPDX-License-Identifier: MIT
// What the path tracer draws and looks up fast, against the plain way.

#include "modules/reference/brdf_sampling.h"
#include "modules/reference/pixel_filter.h"
#include "modules/reference/texel_group.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

using namespace lucent;

namespace {

SceneTexture random_texture(uint32_t p_width, uint32_t p_height, ImageFormat p_format, bool p_srgb, Random &r_random) {
	auto image = std::make_shared<Image>();
	image->format = p_format;
	image->width = p_width;
	image->height = p_height;
	for (uint32_t i = 0; i < p_width * p_height * image->texel_size_bytes() / 4; i++) {
		const float value = r_random.next();
		const uint32_t bits = r_random.next_uint();
		std::byte bytes[4];
		std::memcpy(bytes, p_format == ImageFormat::RGBA32F ? static_cast<const void *>(&value) : &bits, 4);
		image->texels.insert(image->texels.end(), bytes, bytes + 4);
	}
	return { image, p_srgb, 0 };
}

} // namespace

TEST_CASE("path tracer sampling: circle is the cosine and the sine") {
	for (int i = 0; i <= 10000; i++) {
		const float turns = float(i) / 10000.0f;
		const Vector2 point = brdf::circle(turns);
		CHECK(std::abs(point.x - std::cos(2.0 * 3.14159265358979 * turns)) < 1e-6);
		CHECK(std::abs(point.y - std::sin(2.0 * 3.14159265358979 * turns)) < 1e-6);
	}
}

TEST_CASE("path tracer sampling: pixel filters have their width and moments") {
	const PixelFilterSampler box(PixelFilter::BOX), window(PixelFilter::BLACKMAN_HARRIS);
	double mean = 0, square = 0;
	constexpr int COUNT = 100000;
	for (int i = 0; i < COUNT; i++) {
		const float random = (float(i) + 0.5f) / COUNT;
		CHECK(std::abs(box.sample(random) - (random - 0.5f)) < 1e-6f);
		const float x = window.sample(random);
		mean += x / COUNT;
		square += double(x) * x / COUNT;
		CHECK(std::abs(x) <= 0.75f);
	}
	// The window's second moment: width^2 (1/12 + (sum over n of a_n (-1)^n / n^2) / (2 pi^2 a_0)), a = 0.48829, 0.14128, 0.01168.
	const double terms = -0.48829 + 0.14128 / 4.0 - 0.01168 / 9.0;
	const double expected = 2.25 * (1.0 / 12.0 + terms / (2.0 * 3.14159265358979 * 3.14159265358979 * 0.35875));
	CHECK(std::abs(mean) < 1e-5);
	CHECK(std::abs(square - expected) < 1e-4);
}

TEST_CASE("path tracer sampling: grouped textures read as single ones") {
	Random random(1, 2, 3);
	for (const ImageFormat format : { ImageFormat::RGBA8, ImageFormat::RGBA32F }) {
		for (const TextureWrap wrap : { TextureWrap::REPEAT, TextureWrap::CLAMP, TextureWrap::MIRRORED_REPEAT }) {
			for (const TextureFilter filter : { TextureFilter::LINEAR, TextureFilter::NEAREST }) {
				HugeArena arena;
				TexelGroup group;
				TextureRef ref;
				ref.wrap_u = ref.wrap_v = wrap;
				ref.filter = filter;
				ref.uv_scale = Vector2(1.5f, 0.75f);
				const uint32_t count = format == ImageFormat::RGBA8 ? 3 : 1;
				std::vector<SceneTexture> textures;
				for (uint32_t i = 0; i < count; i++) {
					textures.push_back(random_texture(13, 6, format, i == 1, random));
					uint32_t member = UINT32_MAX;
					CHECK(group.add(textures[i], ref, member));
					CHECK(member == i);
				}
				uint32_t member = UINT32_MAX;
				CHECK(group.add(textures[0], ref, member));
				CHECK(member == 0u);
				CHECK(!group.add(random_texture(8, 6, format, false, random), ref, member));
				group.build(arena);
				for (int i = 0; i < 200; i++) {
					const Vector2 uv(6.0f * random.next() - 3.0f, 6.0f * random.next() - 3.0f);
					const TexelFootprint footprint = group.footprint(uv);
					for (uint32_t k = 0; k < count; k++) {
						CHECK(group.read(footprint, k) == sample_texture(textures[k], ref, uv));
					}
				}
			}
		}
	}
}
