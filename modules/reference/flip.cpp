// SPDX-License-Identifier: MIT
// FLIP for low dynamic range, from the equations of the paper (Andersson et al., PACMCGIT 3(2) 2020); numbers in brackets are its sections.
#include "modules/reference/image_filter.h"
#include "modules/reference/image_metrics.h"
#include "servers/core/math_types.h"

#include <algorithm>
#include <array>

namespace lucent {

namespace {

constexpr double PI = 3.14159265358979;
constexpr float COLOR_EXPONENT = 0.7f; // q_c
constexpr float COLOR_KNEE = 0.4f; // p_c
constexpr float COLOR_KNEE_VALUE = 0.95f; // p_t
constexpr float FEATURE_WIDTH_DEGREES = 0.082f; // w
constexpr float FEATURE_EXPONENT = 0.5f; // q_f

// Linear sRGB to CIE XYZ, D65; rows. White is the image of (1, 1, 1).
const glm::dmat3 XYZ_FROM_RGB = glm::transpose(glm::dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,
		2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,
		1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
const Basis XYZ_FROM_RGB_FLOAT = Basis(XYZ_FROM_RGB);
const Basis RGB_FROM_XYZ_FLOAT = Basis(glm::inverse(XYZ_FROM_RGB));
const Vector3 WHITE = XYZ_FROM_RGB_FLOAT * Vector3(1.0f);

Vector3 ycxcz_from_linear(const Vector3 &p_rgb) {
	const Vector3 n = XYZ_FROM_RGB_FLOAT * p_rgb / WHITE;
	return Vector3(116.0f * n.y - 16.0f, 500.0f * (n.x - n.y), 200.0f * (n.y - n.z));
}

Vector3 linear_from_ycxcz(const Vector3 &p_value) {
	const float y = (p_value.x + 16.0f) / 116.0f;
	return RGB_FROM_XYZ_FLOAT * (Vector3(y + p_value.y / 500.0f, y, y - p_value.z / 200.0f) * WHITE);
}

// CIE L*a*b*, then the Hunt effect: chroma fades with lightness [4.1.2].
Vector3 hunt_lab_from_linear(const Vector3 &p_rgb) {
	const auto curve = [](float p_ratio) {
		constexpr float DELTA = 6.0f / 29.0f;
		return p_ratio > DELTA * DELTA * DELTA ? std::cbrt(p_ratio) : p_ratio / (3.0f * DELTA * DELTA) + 4.0f / 29.0f;
	};
	const Vector3 n = XYZ_FROM_RGB_FLOAT * p_rgb / WHITE;
	const float x = curve(n.x), y = curve(n.y), z = curve(n.z);
	const float lightness = 116.0f * y - 16.0f;
	return Vector3(lightness, 0.01f * lightness * 500.0f * (x - y), 0.01f * lightness * 200.0f * (y - z));
}

// Large colour differences are better told by a city-block sum of lightness and chroma [4.1.3].
float hyab(const Vector3 &p_a, const Vector3 &p_b) {
	const Vector3 d = p_a - p_b;
	return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

float largest_color_difference() {
	static const float LARGEST = std::pow(hyab(hunt_lab_from_linear(Vector3(0, 1, 0)), hunt_lab_from_linear(Vector3(0, 0, 1))), COLOR_EXPONENT);
	return LARGEST;
}

// Compresses, then gives differences below the knee most of the range.
float redistribute(float p_hyab) {
	const float largest = largest_color_difference();
	const float value = std::pow(p_hyab, COLOR_EXPONENT);
	const float knee = COLOR_KNEE * largest;
	return value < knee ? COLOR_KNEE_VALUE / knee * value : COLOR_KNEE_VALUE + (value - knee) / (largest - knee) * (1.0f - COLOR_KNEE_VALUE);
}

// One term a1 sqrt(pi / b1) exp(-pi^2 d^2 / b1) of a contrast sensitivity function in space; d in degrees. Separable, normalized
// apart from the weight that it has beside another term.
struct SensitivityTerm {
	double a;
	double b;
};

std::vector<float> gaussian(int p_radius, double p_exponent) {
	std::vector<float> kernel;
	double total = 0;
	for (int i = -p_radius; i <= p_radius; i++) {
		kernel.push_back(float(std::exp(-p_exponent * i * i)));
		total += kernel.back();
	}
	for (float &weight : kernel) {
		weight = float(weight / total);
	}
	return kernel;
}

// The terms' sum, normalized to 1 over the window [4.1.1]. Their shares follow from each term's sum over the window.
Plane filter_sensitivity(const Plane &p_plane, const std::vector<SensitivityTerm> &p_terms, float p_pixels_per_degree) {
	constexpr double WIDEST_B = 0.04;
	const int radius = int(std::ceil(3.0 * std::sqrt(WIDEST_B / (2.0 * PI * PI)) * p_pixels_per_degree));
	std::vector<double> shares;
	double total = 0;
	for (const SensitivityTerm &term : p_terms) {
		double sum = 0;
		for (int i = -radius; i <= radius; i++) {
			sum += std::exp(-PI * PI * i * i / (term.b * p_pixels_per_degree * p_pixels_per_degree));
		}
		shares.push_back(term.a * std::sqrt(PI / term.b) * sum * sum);
		total += shares.back();
	}
	Plane result(p_plane.width, p_plane.height);
	for (size_t t = 0; t < p_terms.size(); t++) {
		const std::vector<float> kernel = gaussian(radius, PI * PI / (p_terms[t].b * p_pixels_per_degree * p_pixels_per_degree));
		const Plane filtered = filter_separable(p_plane, kernel, kernel);
		for (size_t i = 0; i < result.values.size(); i++) {
			result.values[i] += float(shares[t] / total) * filtered.values[i];
		}
	}
	return result;
}

struct Prepared {
	std::vector<Vector3> color; // Hunt-adjusted Lab of the picture as the eye resolves it
	std::vector<float> edge;
	std::vector<float> point;
};

// Both halves of an odd or even derivative weigh 1 [4.2].
void normalize_derivative(std::vector<float> &r_kernel) {
	double positive = 0, negative = 0;
	for (float weight : r_kernel) {
		(weight > 0 ? positive : negative) += std::abs(weight);
	}
	for (float &weight : r_kernel) {
		weight = float(weight / (weight > 0 ? positive : negative));
	}
}

std::vector<float> feature_strength(const Plane &p_luminance, bool p_points, float p_pixels_per_degree) {
	const double sigma = 0.5 * FEATURE_WIDTH_DEGREES * p_pixels_per_degree;
	const int radius = int(std::ceil(3.0 * sigma));
	const std::vector<float> smooth = gaussian(radius, 1.0 / (2.0 * sigma * sigma));
	std::vector<float> derivative;
	for (int i = -radius; i <= radius; i++) {
		const double bell = std::exp(-i * i / (2.0 * sigma * sigma));
		derivative.push_back(float(p_points ? (i * i / (sigma * sigma) - 1.0) * bell : -i * bell));
	}
	// Zero stays zero, so dividing by the halves' sums is safe for a radius of at least 1.
	normalize_derivative(derivative);
	const Plane x = filter_separable(p_luminance, derivative, smooth);
	const Plane y = filter_separable(p_luminance, smooth, derivative);
	std::vector<float> strength(x.values.size());
	for (size_t i = 0; i < strength.size(); i++) {
		strength[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
	}
	return strength;
}

Prepared prepare(std::span<const float> p_srgb, uint32_t p_width, uint32_t p_height, float p_pixels_per_degree) {
	std::array<Plane, 3> planes = { Plane(p_width, p_height), Plane(p_width, p_height), Plane(p_width, p_height) };
	Plane luminance(p_width, p_height);
	const size_t count = luminance.values.size();
	for (size_t i = 0; i < count; i++) {
		const Vector3 value = ycxcz_from_linear(Vector3(srgb_to_linear(p_srgb[3 * i]), srgb_to_linear(p_srgb[3 * i + 1]), srgb_to_linear(p_srgb[3 * i + 2])));
		for (int c = 0; c < 3; c++) {
			planes[size_t(c)].values[i] = value[c];
		}
		luminance.values[i] = (value.x + 16.0f) / 116.0f;
	}
	planes[0] = filter_sensitivity(planes[0], { { 1.0, 0.0047 } }, p_pixels_per_degree);
	planes[1] = filter_sensitivity(planes[1], { { 1.0, 0.0053 } }, p_pixels_per_degree);
	planes[2] = filter_sensitivity(planes[2], { { 34.1, 0.04 }, { 13.5, 0.025 } }, p_pixels_per_degree);
	Prepared result;
	for (size_t i = 0; i < count; i++) {
		const Vector3 linear = linear_from_ycxcz(Vector3(planes[0].values[i], planes[1].values[i], planes[2].values[i]));
		result.color.push_back(hunt_lab_from_linear(glm::clamp(linear, 0.0f, 1.0f)));
	}
	result.edge = feature_strength(luminance, false, p_pixels_per_degree);
	result.point = feature_strength(luminance, true, p_pixels_per_degree);
	return result;
}

} // namespace

std::vector<float> flip_map(std::span<const float> p_a, std::span<const float> p_b, uint32_t p_width, uint32_t p_height, float p_pixels_per_degree) {
	const Prepared a = prepare(p_a, p_width, p_height, p_pixels_per_degree);
	const Prepared b = prepare(p_b, p_width, p_height, p_pixels_per_degree);
	std::vector<float> result(a.color.size());
	for (size_t i = 0; i < result.size(); i++) {
		const float color = redistribute(hyab(a.color[i], b.color[i]));
		const float difference = std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i]));
		const float feature = std::pow(difference / std::sqrt(2.0f), FEATURE_EXPONENT);
		result[i] = std::pow(color, 1.0f - std::min(feature, 1.0f));
	}
	return result;
}

} // namespace lucent
