// SPDX-License-Identifier: MIT
// Runs the program as a user does: exit codes, one clear line, no partial file.
#include "modules/app/exit_codes.h"
#include "modules/image/image_io.h"
#include "tests/test_support.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <sys/wait.h>
#include <vector>

using namespace lucent;
namespace fs = std::filesystem;

namespace {

struct CommandResult {
	int code = -1; // -1: killed by a signal
	std::string err; // stderr
	int count(const std::string &p_text) const {
		int found = 0;
		for (size_t at = err.find(p_text); at != std::string::npos; at = err.find(p_text, at + 1)) {
			found++;
		}
		return found;
	}
};

// A folder that goes away with the test.
struct Folder {
	fs::path path;
	Folder() {
		std::string name = (fs::temp_directory_path() / "lucent-cli-XXXXXX").string();
		path = mkdtemp(name.data());
	}
	~Folder() {
		std::error_code ignored;
		fs::remove_all(path, ignored);
	}
	std::string file(const std::string &p_name, const std::string &p_bytes) const {
		std::ofstream(path / p_name, std::ios::binary) << p_bytes;
		return (path / p_name).string();
	}
	std::string output() const { return (path / "out.png").string(); }
	size_t count() const { return size_t(std::distance(fs::directory_iterator(path), fs::directory_iterator())); }
};

CommandResult lucent_command(const std::string &p_args) {
	CommandResult result;
	const std::string command = "timeout 120 '" + test::program() + "' " + p_args + " 2>&1 >/dev/null";
	FILE *pipe = popen(command.c_str(), "r");
	REQUIRE(pipe != nullptr);
	char buffer[4096];
	for (size_t n = 0; (n = fread(buffer, 1, sizeof(buffer), pipe)) > 0;) {
		result.err.append(buffer, n);
	}
	const int status = pclose(pipe);
	result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
	return result;
}

std::string device_option() {
	return test::options().device.empty() ? "" : " --device '" + test::options().device + "'";
}

// Without GI: these tests are about files and arguments.
CommandResult render(const Folder &p_folder, const std::string &p_scene, const std::string &p_more = "") {
	return lucent_command("render '" + p_scene + "' -o '" + p_folder.output() + "' --size 32x18 --frames 1 --quiet --set 'WorldEnvironment:environment:sdfgi_enabled=false'" + device_option() + " " + p_more);
}

// Exactly that many error lines, the code, and nothing written.
void check_refused(const CommandResult &p_result, const Folder &p_folder, int p_code, const std::string &p_word, int p_lines = 1) {
	INFO(p_result.err);
	CHECK(p_result.code == p_code);
	CHECK(p_result.count("error: ") == p_lines);
	CHECK(p_result.count(p_word) >= 1);
	CHECK_FALSE(fs::exists(p_folder.output()));
}

void check_warned(const CommandResult &p_result, const Folder &p_folder, const std::string &p_word) {
	INFO(p_result.err);
	CHECK(p_result.code == EXIT_OK);
	CHECK(p_result.count("error: ") == 0);
	CHECK(p_result.count("warning: ") >= 1);
	CHECK(p_result.count(p_word) >= 1);
	CHECK(fs::exists(p_folder.output()));
}

template <typename T>
std::string bytes_of(const std::vector<T> &p_values) {
	return std::string(reinterpret_cast<const char *>(p_values.data()), p_values.size() * sizeof(T));
}

// One triangle. p_index replaces the last index, p_x the first coordinate, p_count the accessor's count of positions.
std::string triangle_gltf(const Folder &p_folder, uint16_t p_index, float p_x, const std::string &p_count, const std::string &p_more = "") {
	const std::string positions = bytes_of<float>({ p_x, 0, 0, 1, 0, 0, 0, 1, 0 });
	p_folder.file("triangle.bin", positions + bytes_of<uint16_t>({ 0, 1, p_index, 0 }));
	return p_folder.file("triangle.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
										  R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1)" +
					(p_more.empty() ? std::string() : std::string(R"(,"material":0)")) + R"(}]}],"buffers":[{"uri":"triangle.bin","byteLength":44}],)" + R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8}],)" + R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" + p_count + R"(,"min":[0,0,0],"max":[1,1,0]},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":3}])" + p_more + "}");
}

} // namespace

TEST_SUITE_BEGIN("gpu");

TEST_CASE("cli: help and version") {
	CHECK(lucent_command("--help").code == EXIT_OK);
	CHECK(lucent_command("--version").code == EXIT_OK);
	CHECK(lucent_command("render --help").code == EXIT_OK);
	CHECK(lucent_command("info --help").code == EXIT_OK);
	CHECK(lucent_command("doctool --help").code == EXIT_OK);
	CHECK(lucent_command("bench --help").code == EXIT_OK);
	CHECK(lucent_command("bench quality --help").code == EXIT_OK);
	CHECK(lucent_command("").code == EXIT_USAGE);
	CHECK(lucent_command("rendr").code == EXIT_USAGE);
}

TEST_CASE("cli: wrong arguments are refused before anything is drawn") {
	const Folder folder;
	const std::string scene = triangle_gltf(folder, 2, 0.0f, "3");
	check_refused(render(folder, scene, "--size 0x0"), folder, EXIT_USAGE, "--size");
	check_refused(render(folder, scene, "--size 100000x1"), folder, EXIT_USAGE, "--size");
	check_refused(render(folder, scene, "--size 12"), folder, EXIT_USAGE, "--size");
	check_refused(render(folder, scene, "--frames 0"), folder, EXIT_USAGE, "--frames");
	check_refused(render(folder, scene, "--aov albedoo"), folder, EXIT_USAGE, "did you mean 'albedo'");
	check_refused(render(folder, scene, "--debug-view nothing"), folder, EXIT_USAGE, "--debug-view");
	check_refused(render(folder, scene, "--nonsense"), folder, EXIT_USAGE, "no option '--nonsense'");
	check_refused(render(folder, scene, "--framse 3"), folder, EXIT_USAGE, "did you mean '--frames'");
	check_refused(lucent_command("render '" + scene + "'"), folder, EXIT_USAGE, "-o");
	check_refused(lucent_command("render '" + scene + "' -o x.bmp"), folder, EXIT_USAGE, ".png");
	check_refused(render(folder, scene, "--device 'no such device'"), folder, EXIT_DEVICE, "no such device");
}

// A picture of 8x8 equal values.
std::string grey_exr(const Folder &p_folder, const std::string &p_name, float p_value) {
	const std::string path = (p_folder.path / p_name).string();
	const std::vector<float> values(8 * 8 * 3, p_value); // outlives the layer, which only points to it
	const std::vector<ExrLayer> layers = { { "", { "R", "G", "B" }, values } };
	REQUIRE(write_exr(path, 8, 8, layers).ok());
	return path;
}

TEST_CASE("cli: what compare returns") {
	const Folder folder;
	const std::string half = grey_exr(folder, "half.exr", 0.5f), black = grey_exr(folder, "black.exr", 0.0f), png = (folder.path / "half.png").string();
	REQUIRE(write_png(png, 8, 8, 3, std::vector<uint8_t>(8 * 8 * 3, 188)).ok());
	const std::string same = "compare '" + half + "' '" + half + "' ", other = "compare '" + black + "' '" + half + "' ", dark = "compare '" + black + "' '" + black + "' ";
	CHECK(lucent_command(same + "--threshold rmse=0 --threshold ssim=1").code == EXIT_OK);
	CHECK(lucent_command(other).code == EXIT_OK);
	CHECK(lucent_command(dark + "--threshold energy=0.05").code == EXIT_OK);
	check_refused(lucent_command(other + "--threshold flip=0.01"), folder, EXIT_WORSE, "flip is");
	for (const std::string wrong : { "--exposure nan", "--exposure 0", "--exposure inf", "--threshold flip=nan", "--threshold flip=inf", "--threshold flip=-1", "--threshold flipp=1", "--threshold leak_max=1", "--diff x.jpg" }) {
		const CommandResult result = lucent_command(other + wrong);
		check_refused(result, folder, EXIT_USAGE, wrong.substr(0, wrong.find(' ')));
		CHECK(result.err.size() < 300);
	}
	check_refused(lucent_command(other + "--layer albedo"), folder, EXIT_BAD_INPUT, "albedo");
	check_refused(lucent_command("compare '" + half + "' '" + folder.output() + "'"), folder, EXIT_BAD_INPUT, folder.output());
	check_refused(lucent_command(same + "--diff '" + (folder.path / "none" / "d.png").string() + "'"), folder, EXIT_OUTPUT, "d.png");
	const CommandResult mixed = lucent_command("compare '" + png + "' '" + half + "' --threshold nrmse=0.01");
	CHECK(mixed.code == EXIT_OK);
	CHECK(mixed.count("warning: ") == 1);
	CHECK(lucent_command(same).err.empty());
}

TEST_CASE("cli: reference says what is wrong before it traces") {
	const Folder folder;
	const std::string exr = (folder.path / "out.exr").string();
	const std::string reference = "reference '" + triangle_gltf(folder, 2, 0.0f, "3") + "' -o '" + exr + "' --size 16x9 ";
	for (const std::string wrong : { "--time nan", "--time 0", "--time inf", "--seed -1", "--seed 4294967296", "--spp 0", "--threads 2000", "--filter gauss", "--aov albedoo", "--size 0x1" }) {
		const CommandResult result = lucent_command(reference + wrong);
		check_refused(result, folder, EXIT_USAGE, wrong.substr(0, wrong.find(' ')));
		CHECK(result.err.size() < 300);
	}
	check_refused(lucent_command("reference nothing.tscn -o '" + exr + "'"), folder, EXIT_BAD_INPUT, "nothing.tscn");
	CHECK_FALSE(fs::exists(exr));
	CHECK(lucent_command(reference + "--spp 1 --quiet").err.empty());
	CHECK(fs::exists(exr));
}

TEST_CASE("cli: bench says what is wrong before it measures") {
	const Folder folder;
	const std::string json = " --json '" + (folder.path / "out.json").string() + "'";
	const CommandResult none = lucent_command("bench");
	CHECK(none.code == EXIT_USAGE);
	CHECK(none.count("error: ") == 1);
	const CommandResult kind = lucent_command("bench qualty");
	CHECK(kind.code == EXIT_USAGE);
	CHECK(kind.count("did you mean 'quality'") == 1);
	CHECK(lucent_command("bench speed --preset fast").code == EXIT_USAGE);
	CHECK(lucent_command("bench quality --grid 65").code == EXIT_USAGE);
	const CommandResult scene = lucent_command("bench quality corn" + json);
	CHECK(scene.code == EXIT_BAD_INPUT);
	CHECK(scene.count("no scene 'corn'") == 1);
	CHECK(lucent_command("bench quality cornell --json /proc/never.json").code == EXIT_OUTPUT);
	const CommandResult size = lucent_command("bench quality cornell --size 100x100" + json + device_option());
	CHECK(size.code == EXIT_BAD_INPUT);
	CHECK(size.count("100x100") == 1);
	CHECK(folder.count() == 0);
}

TEST_CASE("cli: --set says what is wrong") {
	const Folder folder;
	const std::string scene = triangle_gltf(folder, 2, 0.0f, "3");
	check_refused(render(folder, scene, "--set 'WorldEnvironment:environment:sdfgi_enabledd=false'"), folder, EXIT_USAGE, "did you mean 'sdfgi_enabled'");
	check_refused(render(folder, scene, "--set 'WorldEnvironmnt:environment:sdfgi_enabled=false'"), folder, EXIT_USAGE, "did you mean 'WorldEnvironment'");
	check_refused(render(folder, scene, "--set 'WorldEnvironment:environment:sdfgi_enabled=Color('"), folder, EXIT_USAGE, "--set");
	check_refused(render(folder, scene, "--set 'WorldEnvironment:environment:sdfgi_enabled=\"text\"'"), folder, EXIT_USAGE, "bool");
	check_refused(render(folder, scene, "--set 'WorldEnvironment'"), folder, EXIT_USAGE, "--set");
	check_refused(render(folder, scene, "--set 'WorldEnvironment:environment:sdfgi_cascades=99'"), folder, EXIT_USAGE, "sdfgi_cascades");
	const CommandResult good = render(folder, scene, "--set 'DirectionalLight3D:light_color:g=0.5' --set 'WorldEnvironment:environment:tonemap_mode=2'");
	INFO(good.err);
	CHECK(good.code == EXIT_OK);
	CHECK(fs::exists(folder.output()));
}

TEST_CASE("cli: files that can't be read") {
	const Folder folder;
	check_refused(render(folder, (folder.path / "missing.tscn").string()), folder, EXIT_BAD_INPUT, "missing.tscn");
	check_refused(render(folder, (folder.path / "missing.glb").string()), folder, EXIT_BAD_INPUT, "missing.glb");
	check_refused(render(folder, folder.path.string()), folder, EXIT_BAD_INPUT, "is a folder");
	check_refused(render(folder, folder.file("scene.obj", "o cube\n")), folder, EXIT_BAD_INPUT, "scene.obj");
	check_refused(render(folder, folder.file("empty.tscn", "")), folder, EXIT_BAD_INPUT, "empty.tscn");
	check_refused(render(folder, folder.file("truncated.glb", std::string("glTF\x02\0\0\0\0\x10\0\0\x20\0\0\0JSON{\"as", 27))), folder, EXIT_BAD_INPUT, "truncated.glb");
	check_refused(render(folder, folder.file("cut.tscn", "[gd_scene format=3]\n\n[node name=\"A\" type=\"Node3D\"]\ntransform = Transform3D(1, 0,")), folder, EXIT_BAD_INPUT, "cut.tscn:4");
	check_refused(render(folder, folder.file("binary.tscn", std::string("RSRC\0\0\1\2", 8))), folder, EXIT_BAD_INPUT, "binary.tscn:1");
}

TEST_CASE("cli: broken meshes") {
	const Folder folder;
	const float nan = std::numeric_limits<float>::quiet_NaN();
	const CommandResult good = render(folder, triangle_gltf(folder, 2, 0.0f, "3"));
	INFO(good.err);
	CHECK(good.code == EXIT_OK);
	fs::remove(folder.output());
	check_refused(render(folder, triangle_gltf(folder, 2, 0.0f, "1073741825")), folder, EXIT_BAD_INPUT, "triangle.gltf");
	check_refused(render(folder, triangle_gltf(folder, 77, 0.0f, "3")), folder, EXIT_BAD_INPUT, "triangle.gltf");
	check_refused(render(folder, triangle_gltf(folder, 2, nan, "3")), folder, EXIT_BAD_INPUT, "triangle.gltf");
}

TEST_CASE("cli: cyclic hierarchies") {
	const Folder folder;
	check_refused(render(folder, folder.file("cycle.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}]})")), folder, EXIT_BAD_INPUT, "cycle.gltf");
	folder.file("a.tscn", "[gd_scene format=3]\n[ext_resource type=\"PackedScene\" path=\"res://b.tscn\" id=\"1\"]\n[node name=\"A\" type=\"Node3D\"]\n[node name=\"B\" parent=\".\" instance=ExtResource(\"1\")]\n");
	folder.file("b.tscn", "[gd_scene format=3]\n[ext_resource type=\"PackedScene\" path=\"res://a.tscn\" id=\"1\"]\n[node name=\"B\" type=\"Node3D\"]\n[node name=\"A\" parent=\".\" instance=ExtResource(\"1\")]\n");
	check_refused(render(folder, (folder.path / "a.tscn").string()), folder, EXIT_BAD_INPUT, "cycl");
}

TEST_CASE("cli: what can go on goes on, with a warning") {
	const Folder folder;
	check_warned(render(folder, folder.file("no_meshes.tscn", "[gd_scene format=3]\n\n[node name=\"Empty\" type=\"Node3D\"]\n")), folder, "no_meshes.tscn");
	folder.file("zero.png", "");
	const std::string textured = triangle_gltf(folder, 2, 0.0f, "3", R"(,"images":[{"uri":"zero.png"}],"textures":[{"source":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])");
	fs::remove(folder.output());
	check_refused(render(folder, textured, "--strict"), folder, EXIT_BAD_INPUT, "(--strict)", 2);
	const CommandResult rest = render(folder, textured); // an error line for the part, and the rest is drawn
	INFO(rest.err);
	CHECK(rest.code == EXIT_OK);
	CHECK(rest.count("error: ") == 1);
	CHECK(rest.count("zero.png") >= 1);
	CHECK(fs::exists(folder.output()));
	check_warned(render(folder, folder.file("unknown.tscn", "[gd_scene format=3]\n\n[node name=\"A\" type=\"Node3D\"]\nbogus = 3\n[node name=\"B\" type=\"Gizmo9\" parent=\".\"]\n")), folder, "unknown.tscn:4");
}

TEST_CASE("cli: a scene without lights is the same picture at a millimetre and at 100 km, GI and shadows included") {
	const Folder folder;
	std::string pictures[2];
	for (const int i : { 0, 1 }) {
		const double scale = i == 0 ? 1e-3 : 1e5;
		std::string text = "[gd_scene format=3]\n";
		for (const char *size : { "2, 0.1, 2", "0.5, 1, 0.5" }) {
			text += fmt::format("[sub_resource type=\"BoxMesh\" id=\"{}\"]\nsize = Vector3({})\n", size, size);
		}
		text += fmt::format("[node name=\"Root\" type=\"Node3D\"]\n[node name=\"All\" type=\"Node3D\" parent=\".\"]\ntransform = Transform3D({0}, 0, 0, 0, {0}, 0, 0, 0, {0}, 0, 0, 0)\n", scale);
		text += "[node name=\"Floor\" type=\"MeshInstance3D\" parent=\"All\"]\nmesh = SubResource(\"2, 0.1, 2\")\n"
				"[node name=\"Box\" type=\"MeshInstance3D\" parent=\"All\"]\nmesh = SubResource(\"0.5, 1, 0.5\")\n";
		pictures[i] = (folder.path / fmt::format("{}.exr", i)).string();
		const CommandResult result = lucent_command("render '" + folder.file("scaled.tscn", text) + "' -o '" + pictures[i] + "' --size 48x27 --frames 2 --quiet" + device_option());
		INFO(result.err);
		REQUIRE(result.code == EXIT_OK);
	}
	const CommandResult compared = lucent_command("compare '" + pictures[0] + "' '" + pictures[1] + "' --threshold nrmse=0.01");
	INFO(compared.err);
	CHECK(compared.code == EXIT_OK);
}

TEST_CASE("cli: outputs that can't be written") {
	const Folder folder;
	const std::string scene = triangle_gltf(folder, 2, 0.0f, "3");
	const size_t files = folder.count();
	const CommandResult missing = lucent_command("render '" + scene + "' -o '" + (folder.path / "no/such/folder.png").string() + "' --size 32x18 --frames 1");
	INFO(missing.err);
	CHECK(missing.code == EXIT_OUTPUT);
	CHECK(missing.count("error: ") == 1);
	fs::create_directory(folder.path / "folder.png");
	const CommandResult directory = lucent_command("render '" + scene + "' -o '" + (folder.path / "folder.png").string() + "' --size 32x18 --frames 1");
	CHECK(directory.code == EXIT_OUTPUT);
	CHECK(lucent_command("render '" + scene + "' -o /proc/picture.png --size 32x18 --frames 1").code == EXIT_OUTPUT);
	check_refused(render(folder, scene, "--stats '" + (folder.path / "no/such/stats.json").string() + "'"), folder, EXIT_OUTPUT, "stats.json");
	CHECK(folder.count() == files + 1);
}

TEST_SUITE_END();
