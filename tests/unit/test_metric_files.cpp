// SPDX-License-Identifier: MIT
#include "modules/image/image_io.h"
#include "modules/reference/metric_files.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

using namespace lucent;

namespace {

// A folder for one case's files.
struct Folder {
	std::string path;
	Folder() {
		std::string pattern = (std::filesystem::temp_directory_path() / "lucent-metrics-XXXXXX").string();
		REQUIRE(mkdtemp(pattern.data()) != nullptr);
		path = pattern + "/";
	}
	~Folder() { std::filesystem::remove_all(path); }
};

} // namespace

TEST_CASE("metric files: layers by name, sums, differences") {
	const Folder folder;
	const std::string path = folder.path + "a.exr";
	const std::vector<float> color = { 1, 2, 3, 4, 5, 6 }, direct = { 0.5f, 0.5f, 0.5f, 1, 1, 1 }, normal = { 0, 1, 0, 1, 0, 0 };
	const std::vector<ExrLayer> layers = { { "", { "R", "G", "B" }, color }, { "ViewLayer.direct", { "R", "G", "B" }, direct }, { "normal", { "X", "Y", "Z" }, normal } };
	REQUIRE(write_exr(path, 2, 1, layers).ok());
	REQUIRE(load_metric_image(path, "").ok());
	CHECK(load_metric_image(path, "").value().values == color);
	CHECK(load_metric_image(path, "direct").value().values == direct);
	CHECK(load_metric_image(path, "normal").value().values == normal);
	CHECK(load_metric_image(path, "color-direct").value().values == std::vector<float>{ 0.5f, 1.5f, 2.5f, 3, 4, 5 });
	CHECK(load_metric_image(path, "direct+normal").value().values == std::vector<float>{ 0.5f, 1.5f, 0.5f, 2, 1, 1 });
	const Result<MetricImage> missing = load_metric_image(path, "emission");
	REQUIRE_FALSE(missing.ok());
	CHECK(missing.error().message.find("'emission'") != std::string::npos);
	CHECK_FALSE(load_metric_image(path, "color+").ok());
	CHECK_FALSE(load_metric_image(folder.path + "none.exr", "").ok());
}

TEST_CASE("metric files: a picture of a layer named Combined, as other renderers write it") {
	const Folder folder;
	const std::string path = folder.path + "a.exr";
	const std::vector<float> color = { 1, 2, 3 };
	REQUIRE(write_exr(path, 1, 1, std::vector<ExrLayer>{ { "ViewLayer.Combined", { "R", "G", "B" }, color } }).ok());
	REQUIRE(load_metric_image(path, "").ok());
	CHECK(load_metric_image(path, "").value().values == color);
}

TEST_CASE("metric files: PNG is decoded from sRGB; masks choose by brightness and size") {
	const Folder folder;
	const std::string path = folder.path + "a.png";
	const std::vector<uint8_t> values = { 188, 0, 255, 100, 100, 100 };
	REQUIRE(write_png(path, 2, 1, 3, values).ok());
	const Result<MetricImage> image = load_metric_image(path, "");
	REQUIRE(image.ok());
	CHECK(image.value().values[0] == doctest::Approx(0.5029).epsilon(0.001));
	CHECK(image.value().values[2] == 1.0f);
	CHECK_FALSE(load_metric_image(path, "direct").ok());
	const Result<std::vector<uint8_t>> mask = load_metric_mask(path, 2, 1);
	REQUIRE(mask.ok());
	CHECK(mask.value() == std::vector<uint8_t>{ 1, 0 });
	CHECK_FALSE(load_metric_mask(path, 1, 2).ok());
}
