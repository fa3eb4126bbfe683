// SPDX-License-Identifier: MIT
// tests/golden/*.json: a scene, how it is drawn, how far it may be from path-traced truth, and why that far.
// Runs the program as a user does, so that what is judged is what `lucent bench quality` prints.
#include "tests/test_support.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

using namespace lucent;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

Json read_json(const fs::path &p_path) {
	std::ifstream file(p_path);
	return Json::parse(file, nullptr, false);
}

// The scene's row of what the bench found; null where it failed.
Json measure(const Json &p_golden) {
	std::string folder = (fs::temp_directory_path() / "lucent-golden-XXXXXX").string();
	REQUIRE(mkdtemp(folder.data()) != nullptr);
	const Json &settings = p_golden["settings"];
	std::string command = "timeout 300 '" + test::program() + "' bench quality --quiet " + p_golden["scene"].get<std::string>() + " --json '" + folder + "/out.json' --size " + settings["size"].get<std::string>() + " --grid " + std::to_string(settings["grid"].get<int>()) + " --frames " + std::to_string(settings["frames"].get<int>());
	for (const Json &setting : settings["set"]) {
		command += " --set '" + setting.get<std::string>() + "'";
	}
	if (!test::options().device.empty()) {
		command += " --device '" + test::options().device + "'";
	}
	const int status = std::system((command + " >/dev/null").c_str());
	const Json result = status == 0 ? read_json(folder + "/out.json") : Json();
	fs::remove_all(folder);
	return result.is_object() ? result["scenes"][0] : Json();
}

void check_golden(const fs::path &p_path) {
	const Json golden = read_json(p_path);
	INFO(p_path.string());
	REQUIRE(golden.is_object());
	CHECK(golden["reason"].get<std::string>().size() > 20);
	const Json found = measure(golden);
	REQUIRE(found.is_object());
	INFO(found.dump());
	const Json &tolerance = golden["tolerance"];
	if (tolerance.contains("leak_max")) {
		REQUIRE(found["sealed"].get<bool>());
		CHECK(found["leak"]["max"].get<double>() <= tolerance["leak_max"].get<double>());
		return;
	}
	REQUIRE_FALSE(found["sealed"].get<bool>());
	CHECK(found["nrmse"].get<double>() <= tolerance["nrmse"].get<double>());
	CHECK(found["energy"].get<double>() >= tolerance["energy"][0].get<double>());
	CHECK(found["energy"].get<double>() <= tolerance["energy"][1].get<double>());
}

} // namespace

TEST_SUITE("gpu") {
	TEST_CASE("goldens: indirect light is as near to the truth as it was approved to be") {
		std::vector<fs::path> goldens;
		for (const fs::directory_entry &entry : fs::directory_iterator(test::options().root + "tests/golden")) {
			if (entry.path().extension() == ".json") {
				goldens.push_back(entry.path());
			}
		}
		std::sort(goldens.begin(), goldens.end());
		REQUIRE(goldens.size() >= 4);
		for (const fs::path &golden : goldens) {
			check_golden(golden);
		}
	}
}
