// SPDX-License-Identifier: MIT
#include "modules/gltf/gltf_specular_glossiness.h"

#include <algorithm>
#include <cstring>

namespace lucent {

namespace {

constexpr float DIELECTRIC = 0.04f; // reflectance of what is no metal
constexpr float EPSILON = 1e-6f;

float brightness(const Vector3 &p_color) {
	return std::sqrt(glm::dot(Vector3(0.299f, 0.587f, 0.114f), p_color * p_color));
}

// The metallic value that gives this diffuse and specular brightness.
float solve_metallic(float p_diffuse, float p_specular, float p_left) {
	if (p_specular < DIELECTRIC) {
		return 0.0f;
	}
	const float b = p_diffuse * p_left / (1.0f - DIELECTRIC) + p_specular - 2.0f * DIELECTRIC;
	const float c = DIELECTRIC - p_specular;
	const float root = std::sqrt(std::max(b * b - 4.0f * DIELECTRIC * c, 0.0f));
	return glm::clamp((root - b) / (2.0f * DIELECTRIC), 0.0f, 1.0f);
}

// The texel of an image at the same place in [0, 1) as (x, y) of an image of that size; values 0 to 1 as stored.
Vector4 texel_at(const Image &p_image, uint32_t p_x, uint32_t p_y, uint32_t p_width, uint32_t p_height) {
	const uint64_t x = uint64_t(p_x) * p_image.width / p_width, y = uint64_t(p_y) * p_image.height / p_height;
	const size_t at = (size_t(y) * p_image.width + size_t(x)) * p_image.texel_size_bytes();
	if (p_image.format == ImageFormat::RGBA32F) {
		Vector4 value;
		std::memcpy(&value, p_image.texels.data() + at, 16);
		return glm::clamp(value, Vector4(0.0f), Vector4(1.0f));
	}
	uint8_t bytes[4];
	std::memcpy(bytes, p_image.texels.data() + at, 4);
	return Vector4(bytes[0], bytes[1], bytes[2], bytes[3]) / 255.0f;
}

Vector4 decode(const Vector4 &p_srgb) {
	return Vector4(srgb_to_linear(p_srgb.x), srgb_to_linear(p_srgb.y), srgb_to_linear(p_srgb.z), p_srgb.w);
}

void store(Image &r_image, size_t p_texel, const Vector4 &p_value) {
	for (size_t c = 0; c < 4; c++) {
		r_image.texels[p_texel * 4 + c] = std::byte(uint8_t(glm::clamp(p_value[glm::length_t(c)], 0.0f, 1.0f) * 255.0f + 0.5f));
	}
}

} // namespace

MetallicRoughness to_metallic_roughness(const Vector4 &p_diffuse, const Vector3 &p_specular, float p_glossiness) {
	const Vector3 diffuse(p_diffuse);
	const float left = 1.0f - std::max({ p_specular.x, p_specular.y, p_specular.z });
	MetallicRoughness made;
	made.metallic = solve_metallic(brightness(diffuse), brightness(p_specular), left);
	const Vector3 from_diffuse = diffuse * (left / (1.0f - DIELECTRIC) / std::max(1.0f - made.metallic, EPSILON));
	const Vector3 from_specular = (p_specular - DIELECTRIC * (1.0f - made.metallic)) / std::max(made.metallic, EPSILON);
	made.base_color = glm::clamp(glm::mix(from_diffuse, from_specular, made.metallic * made.metallic), Vector3(0.0f), Vector3(1.0f));
	made.roughness = 1.0f - p_glossiness;
	return made;
}

MetallicRoughnessImages to_metallic_roughness_images(const SpecularGlossiness &p_factors, const std::shared_ptr<const Image> &p_diffuse, const Image &p_specular_glossiness) {
	const uint32_t width = std::max(p_specular_glossiness.width, p_diffuse ? p_diffuse->width : 0);
	const uint32_t height = std::max(p_specular_glossiness.height, p_diffuse ? p_diffuse->height : 0);
	MetallicRoughnessImages made;
	for (Image *image : { &made.base_color, &made.metallic_roughness }) {
		*image = { ImageFormat::RGBA8, width, height, std::vector<std::byte>(size_t(width) * height * 4) };
	}
	for (uint32_t y = 0; y < height; y++) {
		for (uint32_t x = 0; x < width; x++) {
			const Vector4 diffuse = p_factors.diffuse * (p_diffuse ? decode(texel_at(*p_diffuse, x, y, width, height)) : Vector4(1.0f));
			const Vector4 specular = decode(texel_at(p_specular_glossiness, x, y, width, height));
			const MetallicRoughness point = to_metallic_roughness(diffuse, Vector3(specular) * p_factors.specular, specular.w * p_factors.glossiness);
			const size_t texel = size_t(y) * width + x;
			store(made.base_color, texel, Vector4(linear_to_srgb(point.base_color.x), linear_to_srgb(point.base_color.y), linear_to_srgb(point.base_color.z), diffuse.w));
			store(made.metallic_roughness, texel, Vector4(0.0f, point.roughness, point.metallic, 1.0f));
		}
	}
	return made;
}

} // namespace lucent
